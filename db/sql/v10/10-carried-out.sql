-- What rules that react have carried out, and would carry out again only if they were met anew or read other values.
--
-- because: the objects with what the rule read of them.
CREATE TABLE carried_out (
  rule    TEXT NOT NULL,
  version TEXT NOT NULL,
  because TEXT NOT NULL
) STRICT;

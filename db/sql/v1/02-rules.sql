-- Who concluded what. Values of rooms, doors and areas stand in their own tables, with the number of the rule and of
-- the witness beside them; other classes' conclusions stand in `derivations`. The view `conclusions` shows them all.

CREATE TABLE rules (
  rule    INTEGER PRIMARY KEY,
  name    TEXT NOT NULL CONSTRAINT "name must not be empty" CHECK (length(name) > 0),
  version TEXT NOT NULL,
  file    TEXT,
  line    INTEGER
) STRICT;

-- The facts that a rule chose, as JSON text: few differ, so each is kept once.
CREATE TABLE witnesses (
  witness INTEGER PRIMARY KEY,
  facts   TEXT NOT NULL
) STRICT;

CREATE TABLE derivations (
  class    TEXT NOT NULL,
  key      ANY NOT NULL,
  property TEXT NOT NULL,
  value    ANY,
  rule     INTEGER NOT NULL,
  witness  INTEGER,
  PRIMARY KEY (class, key, property)
) STRICT, WITHOUT ROWID;

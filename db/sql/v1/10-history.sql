-- Edits made through the store. column_name is NULL where a whole row came (new) or went (old), as JSON.
-- undone: the entry that took this one back.
CREATE TABLE history (
  id          INTEGER PRIMARY KEY AUTOINCREMENT,
  at          TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ', 'now')),
  who         TEXT NOT NULL,
  why         TEXT NOT NULL,
  table_name  TEXT NOT NULL,
  key         TEXT NOT NULL,
  column_name TEXT,
  old         ANY,
  new         ANY,
  undone      INTEGER REFERENCES history (id)
) STRICT;

CREATE TABLE rooms (
  room     INTEGER PRIMARY KEY CONSTRAINT "room must be numbered from 1" CHECK (room > 0),
  name     TEXT NOT NULL UNIQUE CONSTRAINT "name must not be empty" CHECK (length(name) > 0),
  robot    TEXT,
  state    TEXT,
  x0 REAL NOT NULL CONSTRAINT "x0 must be finite" CHECK (x0 BETWEEN -1e300 AND 1e300),
  y0 REAL NOT NULL CONSTRAINT "y0 must be finite" CHECK (y0 BETWEEN -1e300 AND 1e300),
  x1 REAL NOT NULL CONSTRAINT "x1 must be finite and above x0" CHECK (x1 > x0 AND x1 <= 1e300),
  y1 REAL NOT NULL CONSTRAINT "y1 must be finite and above y0" CHECK (y1 > y0 AND y1 <= 1e300),
  height   REAL CONSTRAINT "height must be finite and not negative" CHECK (height BETWEEN 0 AND 1e300),
  width    REAL NOT NULL CONSTRAINT "width must be finite and not negative" CHECK (width BETWEEN 0 AND 1e300),
  hardness REAL CONSTRAINT "hardness must be finite and not negative" CHECK (hardness BETWEEN 0 AND 1e300),
  action   TEXT CONSTRAINT "action must not be empty" CHECK (length(action) > 0),
  hardness_rule    INTEGER,
  hardness_witness INTEGER,
  action_rule      INTEGER,
  action_witness   INTEGER,
  CONSTRAINT "a room has a robot and a state, or neither" CHECK ((robot IS NULL) = (state IS NULL))
) STRICT;

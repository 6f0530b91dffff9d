-- x, y is the crossing point; x0, y0, x1, y1 the segment that the two rooms share.
CREATE TABLE doors (
  door      INTEGER PRIMARY KEY CONSTRAINT "door must be numbered from 1" CHECK (door > 0),
  kind      TEXT NOT NULL DEFAULT 'door' CONSTRAINT "kind must be door or change" CHECK (kind IN ('door', 'change')),
  room1     INTEGER NOT NULL REFERENCES rooms (room) ON DELETE CASCADE,
  room2     INTEGER NOT NULL REFERENCES rooms (room) ON DELETE CASCADE,
  x         REAL NOT NULL CONSTRAINT "x must be finite" CHECK (x BETWEEN -1e300 AND 1e300),
  y         REAL NOT NULL CONSTRAINT "y must be finite" CHECK (y BETWEEN -1e300 AND 1e300),
  width     REAL NOT NULL CONSTRAINT "width must be finite and not negative" CHECK (width BETWEEN 0 AND 1e300),
  height1   REAL CONSTRAINT "height1 must be finite and not negative" CHECK (height1 BETWEEN 0 AND 1e300),
  width1    REAL CONSTRAINT "width1 must be finite and not negative" CHECK (width1 BETWEEN 0 AND 1e300),
  distance1 REAL CONSTRAINT "distance1 must be finite and not negative" CHECK (distance1 BETWEEN 0 AND 1e300),
  height2   REAL CONSTRAINT "height2 must be finite and not negative" CHECK (height2 BETWEEN 0 AND 1e300),
  width2    REAL CONSTRAINT "width2 must be finite and not negative" CHECK (width2 BETWEEN 0 AND 1e300),
  distance2 REAL CONSTRAINT "distance2 must be finite and not negative" CHECK (distance2 BETWEEN 0 AND 1e300),
  hardness  REAL CONSTRAINT "hardness must be finite and not negative" CHECK (hardness BETWEEN 0 AND 1e300),
  action    TEXT CONSTRAINT "action must not be empty" CHECK (length(action) > 0),
  passable  INTEGER CONSTRAINT "passable must be 0 or 1" CHECK (passable IN (0, 1)),
  one_way   INTEGER NOT NULL DEFAULT 0 CONSTRAINT "one_way must be 0 or 1" CHECK (one_way IN (0, 1)),
  x0 REAL NOT NULL, y0 REAL NOT NULL, x1 REAL NOT NULL, y1 REAL NOT NULL,
  hardness_rule    INTEGER,
  hardness_witness INTEGER,
  action_rule      INTEGER,
  action_witness   INTEGER,
  passable_rule    INTEGER,
  passable_witness INTEGER,
  CONSTRAINT "a door joins two rooms" CHECK (room1 <> room2)
) STRICT;

CREATE INDEX doors_by_room1 ON doors (room1);
CREATE INDEX doors_by_room2 ON doors (room2);

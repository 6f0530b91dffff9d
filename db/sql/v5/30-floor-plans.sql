-- Floor plans of worlds (`adit plan`), each under the name of its world: convex regions, doorways between them, adits on
-- either side, ways between adits and what rules said that they weigh, and the last path. Metres; numbers from 0, as
-- rules see them.
CREATE TABLE IF NOT EXISTS floor_plans (
  world   TEXT PRIMARY KEY,
  rules   TEXT NOT NULL,
  radius  REAL NOT NULL,
  margin  REAL NOT NULL,
  area    REAL NOT NULL,
  status  TEXT NOT NULL CHECK (status IN ('ok', 'no_path')),
  reason  TEXT,
  length  REAL,
  weight  REAL,
  at      TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now'))
) STRICT;

CREATE TABLE IF NOT EXISTS floor_regions (
  world  TEXT NOT NULL REFERENCES floor_plans ON DELETE CASCADE,
  region INTEGER NOT NULL,
  area   REAL NOT NULL,
  PRIMARY KEY (world, region)
) STRICT;

-- The outlines of regions, counterclockwise.
CREATE TABLE IF NOT EXISTS floor_corners (
  world  TEXT NOT NULL REFERENCES floor_plans ON DELETE CASCADE,
  region INTEGER NOT NULL,
  corner INTEGER NOT NULL,
  x REAL NOT NULL,
  y REAL NOT NULL,
  PRIMARY KEY (world, region, corner)
) STRICT;

-- What two regions share.
CREATE TABLE IF NOT EXISTS floor_doorways (
  world   TEXT NOT NULL REFERENCES floor_plans ON DELETE CASCADE,
  doorway INTEGER NOT NULL,
  region1 INTEGER NOT NULL,
  region2 INTEGER NOT NULL,
  x0 REAL NOT NULL, y0 REAL NOT NULL, x1 REAL NOT NULL, y1 REAL NOT NULL,
  width   REAL NOT NULL,
  PRIMARY KEY (world, doorway)
) STRICT;

CREATE TABLE IF NOT EXISTS floor_adits (
  world   TEXT NOT NULL REFERENCES floor_plans ON DELETE CASCADE,
  adit    INTEGER NOT NULL,
  doorway INTEGER NOT NULL,
  region  INTEGER NOT NULL,
  twin    INTEGER NOT NULL,
  x REAL NOT NULL,
  y REAL NOT NULL,
  PRIMARY KEY (world, adit)
) STRICT;

-- Named places, and the region that each lies in: NULL where the robot cannot stand there.
CREATE TABLE IF NOT EXISTS floor_places (
  world  TEXT NOT NULL REFERENCES floor_plans ON DELETE CASCADE,
  place  TEXT NOT NULL,
  x REAL NOT NULL,
  y REAL NOT NULL,
  region INTEGER,
  PRIMARY KEY (world, place)
) STRICT;

-- Ways from an adit or a place to an adit, through a doorway or within a region. No weight: rules close the way.
CREATE TABLE IF NOT EXISTS floor_ways (
  world      TEXT NOT NULL REFERENCES floor_plans ON DELETE CASCADE,
  way        INTEGER NOT NULL,
  from_adit  INTEGER,
  from_place TEXT,
  to_adit    INTEGER NOT NULL,
  doorway    INTEGER,
  region     INTEGER,
  length     REAL NOT NULL,
  clearance  REAL NOT NULL,
  weight     REAL,
  PRIMARY KEY (world, way)
) STRICT;

-- The last path, point by point.
CREATE TABLE IF NOT EXISTS floor_waypoints (
  world TEXT NOT NULL REFERENCES floor_plans ON DELETE CASCADE,
  point INTEGER NOT NULL,
  x REAL NOT NULL,
  y REAL NOT NULL,
  PRIMARY KEY (world, point)
) STRICT;

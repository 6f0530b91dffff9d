-- What the planners of worlds of their own (`adit plan`) found, each under the name of its world. Programs before version
-- 5 made these tables, and those of the scripts beside this one, where they first kept something in them: hence what is
-- there stays.
CREATE TABLE IF NOT EXISTS plans (
  plan          TEXT PRIMARY KEY,
  kind          TEXT NOT NULL CHECK (kind IN ('assembly', 'corridor')),
  rules         TEXT NOT NULL,
  status        TEXT NOT NULL CHECK (status IN ('ok', 'no_path')),
  reason        TEXT,
  length        REAL,
  min_clearance REAL,
  at            TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now'))
) STRICT;

-- Channels as boxes, numbered from 1; z is NULL in the plane of a robot, y in that of a part.
CREATE TABLE IF NOT EXISTS channels (
  plan    TEXT NOT NULL REFERENCES plans ON DELETE CASCADE,
  channel INTEGER NOT NULL,
  axis    TEXT NOT NULL CHECK (axis IN ('x', 'y', 'z')),
  x0 REAL NOT NULL, y0 REAL, z0 REAL, x1 REAL NOT NULL, y1 REAL, z1 REAL,
  PRIMARY KEY (plan, channel)
) STRICT;

-- Where two channels overlap.
CREATE TABLE IF NOT EXISTS junctions (
  plan     TEXT NOT NULL REFERENCES plans ON DELETE CASCADE,
  junction INTEGER NOT NULL,
  channel1 INTEGER NOT NULL,
  channel2 INTEGER NOT NULL,
  x0 REAL NOT NULL, y0 REAL, z0 REAL, x1 REAL NOT NULL, y1 REAL, z1 REAL,
  PRIMARY KEY (plan, junction)
) STRICT;

-- The corners of junctions in the plane of a robot; `turned` is 1 at the one that the robot turns round.
CREATE TABLE IF NOT EXISTS corners (
  plan     TEXT NOT NULL REFERENCES plans ON DELETE CASCADE,
  junction INTEGER NOT NULL,
  corner   TEXT NOT NULL,
  x REAL NOT NULL,
  y REAL NOT NULL,
  turned   INTEGER NOT NULL CHECK (turned IN (0, 1)),
  PRIMARY KEY (plan, junction, corner)
) STRICT;

-- The steps of a path, from 1: `start`, then lines and arcs. Lengths in metres, headings in degrees from the x axis,
-- counter-clockwise. x, y, z are where a step ends, and `state` what a part is in there (Lee, definitions 3.1, 3.2): of a part the corner with the smallest coordinates, of a robot the
-- middle.
CREATE TABLE IF NOT EXISTS path_steps (
  plan      TEXT NOT NULL REFERENCES plans ON DELETE CASCADE,
  step      INTEGER NOT NULL,
  kind      TEXT NOT NULL CHECK (kind IN ('start', 'line', 'arc')),
  state     TEXT CHECK (state IN ('assembled', 'disassembled')),
  junction  INTEGER,
  rule      REAL,
  x REAL NOT NULL, y REAL, z REAL,
  centre_x  REAL,
  centre_y  REAL,
  radius    REAL,
  turn      TEXT CHECK (turn IN ('left', 'right')),
  heading   REAL,
  length    REAL NOT NULL,
  clearance REAL NOT NULL,
  PRIMARY KEY (plan, step)
) STRICT;

-- What rules were told at each junction, and what they concluded there: then `rule` names the one that did.
CREATE TABLE IF NOT EXISTS step_facts (
  plan     TEXT NOT NULL REFERENCES plans ON DELETE CASCADE,
  junction INTEGER NOT NULL,
  property TEXT NOT NULL,
  value    ANY,
  rule     TEXT,
  version  TEXT,
  PRIMARY KEY (plan, junction, property)
) STRICT;

-- The rules of a table that were looked at, row by row: which spoke, and why the others did not.
CREATE TABLE IF NOT EXISTS step_rules (
  plan      TEXT NOT NULL REFERENCES plans ON DELETE CASCADE,
  junction  INTEGER NOT NULL,
  number    INTEGER NOT NULL,
  rule      TEXT NOT NULL,
  table_row INTEGER,
  file      TEXT NOT NULL,
  line      INTEGER NOT NULL,
  spoke     INTEGER NOT NULL CHECK (spoke IN (0, 1)),
  because   TEXT,
  PRIMARY KEY (plan, junction, number)
) STRICT;

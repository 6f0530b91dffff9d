-- Buildings that robots have learned (`adit simulate --learn`), each under the name of its world, in the frame of the pose
-- where the robot began. Metres. The network of places over them stands in the tables of floor plans, under `learned`.
CREATE TABLE IF NOT EXISTS learned_buildings (
  world   TEXT PRIMARY KEY,
  learned TEXT NOT NULL UNIQUE,
  rules   TEXT NOT NULL,
  seed    TEXT NOT NULL,
  radius  REAL NOT NULL,
  start_x REAL NOT NULL,
  start_y REAL NOT NULL,
  length  REAL NOT NULL,
  seconds REAL NOT NULL,
  at      TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now'))
) STRICT;

-- The surfaces of the global model; they meet at their ends.
CREATE TABLE IF NOT EXISTS learned_walls (
  world TEXT NOT NULL REFERENCES learned_buildings ON DELETE CASCADE,
  wall  INTEGER NOT NULL,
  x0 REAL NOT NULL, y0 REAL NOT NULL, x1 REAL NOT NULL, y1 REAL NOT NULL,
  PRIMARY KEY (world, wall)
) STRICT;

-- What was never seen where no wall lies before it, as boxes: it is not free.
CREATE TABLE IF NOT EXISTS learned_unseen (
  world TEXT NOT NULL REFERENCES learned_buildings ON DELETE CASCADE,
  box   INTEGER NOT NULL,
  x0 REAL NOT NULL, y0 REAL NOT NULL, x1 REAL NOT NULL, y1 REAL NOT NULL,
  PRIMARY KEY (world, box)
) STRICT;

-- Places that the user named where the robot stood.
CREATE TABLE IF NOT EXISTS learned_places (
  world TEXT NOT NULL REFERENCES learned_buildings ON DELETE CASCADE,
  place TEXT NOT NULL,
  x REAL NOT NULL,
  y REAL NOT NULL,
  PRIMARY KEY (world, place)
) STRICT;

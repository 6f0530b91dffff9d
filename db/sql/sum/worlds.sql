-- What a database that keeps worlds has besides. Made of the steps by a test (src/migrate/sum_tests.rs).

CREATE TABLE floor_plans (
  world   TEXT PRIMARY KEY,
  rules   TEXT NOT NULL,
  radius  REAL NOT NULL,
  margin  REAL NOT NULL,
  area    REAL NOT NULL,
  at      TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now'))
) STRICT;

CREATE TABLE floor_regions (
  world  TEXT NOT NULL REFERENCES floor_plans ON DELETE CASCADE,
  region INTEGER NOT NULL,
  area   REAL NOT NULL,
  PRIMARY KEY (world, region)
) STRICT;

CREATE TABLE floor_corners (
  world  TEXT NOT NULL REFERENCES floor_plans ON DELETE CASCADE,
  region INTEGER NOT NULL,
  corner INTEGER NOT NULL,
  x REAL NOT NULL,
  y REAL NOT NULL,
  PRIMARY KEY (world, region, corner)
) STRICT;

CREATE TABLE floor_doorways (
  world   TEXT NOT NULL REFERENCES floor_plans ON DELETE CASCADE,
  doorway INTEGER NOT NULL,
  region1 INTEGER NOT NULL,
  region2 INTEGER NOT NULL,
  x0 REAL NOT NULL, y0 REAL NOT NULL, x1 REAL NOT NULL, y1 REAL NOT NULL,
  width   REAL NOT NULL,
  PRIMARY KEY (world, doorway)
) STRICT;

CREATE TABLE floor_adits (
  world   TEXT NOT NULL REFERENCES floor_plans ON DELETE CASCADE,
  adit    INTEGER NOT NULL,
  doorway INTEGER NOT NULL,
  region  INTEGER NOT NULL,
  twin    INTEGER NOT NULL,
  x REAL NOT NULL,
  y REAL NOT NULL,
  PRIMARY KEY (world, adit)
) STRICT;

CREATE TABLE floor_places (
  world  TEXT NOT NULL REFERENCES floor_plans ON DELETE CASCADE,
  place  TEXT NOT NULL,
  x REAL NOT NULL,
  y REAL NOT NULL,
  region INTEGER,
  PRIMARY KEY (world, place)
) STRICT;

CREATE TABLE floor_ways (
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

CREATE TABLE learned_buildings (
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

CREATE TABLE learned_walls (
  world TEXT NOT NULL REFERENCES learned_buildings ON DELETE CASCADE,
  wall  INTEGER NOT NULL,
  x0 REAL NOT NULL, y0 REAL NOT NULL, x1 REAL NOT NULL, y1 REAL NOT NULL,
  PRIMARY KEY (world, wall)
) STRICT;

CREATE TABLE learned_unseen (
  world TEXT NOT NULL REFERENCES learned_buildings ON DELETE CASCADE,
  box   INTEGER NOT NULL,
  x0 REAL NOT NULL, y0 REAL NOT NULL, x1 REAL NOT NULL, y1 REAL NOT NULL,
  PRIMARY KEY (world, box)
) STRICT;

CREATE TABLE learned_places (
  world TEXT NOT NULL REFERENCES learned_buildings ON DELETE CASCADE,
  place TEXT NOT NULL,
  x REAL NOT NULL,
  y REAL NOT NULL,
  PRIMARY KEY (world, place)
) STRICT;

CREATE TABLE cells (
  cell         TEXT PRIMARY KEY,
  robot        TEXT NOT NULL,
  seed         TEXT NOT NULL,
  tasks        INTEGER NOT NULL,
  revision     INTEGER NOT NULL,
  next_subgoal INTEGER NOT NULL,
  next_edge    INTEGER NOT NULL,
  configuration TEXT NOT NULL,
  stands       INTEGER,
  figures      TEXT NOT NULL,
  copied_from  TEXT,
  at           TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now'))
) STRICT;

CREATE TABLE cell_objects (
  cell        TEXT NOT NULL REFERENCES cells ON DELETE CASCADE,
  object      TEXT NOT NULL,
  number      INTEGER NOT NULL,
  revision    INTEGER NOT NULL,
  times_moved INTEGER NOT NULL,
  movable     INTEGER NOT NULL CHECK (movable IN (0, 1)),
  x           REAL NOT NULL,
  y           REAL NOT NULL,
  heading_rad REAL NOT NULL,
  polygon     TEXT NOT NULL,
  PRIMARY KEY (cell, object)
) STRICT;

CREATE TABLE object_changes (
  cell     TEXT NOT NULL REFERENCES cells ON DELETE CASCADE,
  revision INTEGER NOT NULL,
  object   TEXT NOT NULL,
  task     INTEGER NOT NULL,
  how      TEXT NOT NULL CHECK (how IN ('appeared', 'gone', 'moved', 'reshaped')),
  PRIMARY KEY (cell, revision, object)
) STRICT;

CREATE TABLE subgoals (
  cell             TEXT NOT NULL REFERENCES cells ON DELETE CASCADE,
  subgoal          INTEGER NOT NULL,
  configuration    TEXT NOT NULL,
  object           TEXT,
  tool_x           REAL,
  tool_y           REAL,
  tool_heading_rad REAL,
  branch           INTEGER,
  made_task        INTEGER NOT NULL,
  removed_task     INTEGER,
  because          TEXT,
  PRIMARY KEY (cell, subgoal)
) STRICT;

CREATE TABLE edges (
  cell              TEXT NOT NULL REFERENCES cells ON DELETE CASCADE,
  edge              INTEGER NOT NULL,
  subgoal1          INTEGER NOT NULL,
  subgoal2          INTEGER NOT NULL,
  via               TEXT NOT NULL,
  loose             INTEGER NOT NULL CHECK (loose IN (0, 1)),
  length            REAL NOT NULL,
  made_task         INTEGER NOT NULL,
  verified_task     INTEGER NOT NULL,
  verified_revision INTEGER NOT NULL,
  times_verified    INTEGER NOT NULL,
  removed_task      INTEGER,
  removed_revision  INTEGER,
  broken_by         TEXT,
  because           TEXT,
  PRIMARY KEY (cell, edge),
  FOREIGN KEY (cell, subgoal1) REFERENCES subgoals,
  FOREIGN KEY (cell, subgoal2) REFERENCES subgoals
) STRICT;
CREATE UNIQUE INDEX edges_between ON edges (cell, subgoal1, subgoal2) WHERE removed_task IS NULL;
CREATE TRIGGER edges_replaced BEFORE INSERT ON edges BEGIN
  UPDATE edges SET removed_task = new.made_task, because = 'replaced'
  WHERE cell = new.cell AND subgoal1 = new.subgoal1 AND subgoal2 = new.subgoal2 AND removed_task IS NULL;
  DELETE FROM subgoal_pairs
  WHERE cell = new.cell AND subgoal1 = new.subgoal1 AND subgoal2 = new.subgoal2 AND kind = 'refused';
END;

CREATE TABLE subgoal_pairs (
  cell     TEXT NOT NULL REFERENCES cells ON DELETE CASCADE,
  subgoal1 INTEGER NOT NULL,
  subgoal2 INTEGER NOT NULL,
  kind     TEXT NOT NULL CHECK (kind IN ('refused', 'tightened')),
  revision INTEGER NOT NULL,
  PRIMARY KEY (cell, subgoal1, subgoal2, kind)
) STRICT, WITHOUT ROWID;

CREATE TABLE clearances (
  cell   TEXT NOT NULL REFERENCES cells ON DELETE CASCADE,
  object TEXT NOT NULL,
  kind   TEXT NOT NULL CHECK (kind IN ('free', 'taken')),
  ax     REAL NOT NULL,
  ay     REAL NOT NULL,
  bx     REAL,
  by     REAL,
  within REAL NOT NULL
) STRICT;
CREATE INDEX clearances_of ON clearances (cell, object);

CREATE TABLE tasks (
  cell          TEXT NOT NULL REFERENCES cells ON DELETE CASCADE,
  task          INTEGER NOT NULL,
  goal          TEXT NOT NULL,
  configuration TEXT,
  found         INTEGER NOT NULL CHECK (found IN (0, 1)),
  reason        TEXT,
  evaluations   INTEGER NOT NULL,
  solve_calls   INTEGER NOT NULL,
  reach_calls   INTEGER NOT NULL,
  length        REAL,
  path          TEXT,
  at            TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now')),
  PRIMARY KEY (cell, task)
) STRICT;

CREATE TABLE strategies (
  cell      TEXT NOT NULL REFERENCES cells ON DELETE CASCADE,
  revision  INTEGER NOT NULL,
  task      INTEGER NOT NULL,
  strategy  TEXT NOT NULL CHECK (strategy IN ('a0', 'a1', 'a2', 'a3')),
  facts     TEXT NOT NULL,
  rule      TEXT,
  table_row INTEGER,
  file      TEXT,
  line      INTEGER,
  PRIMARY KEY (cell, revision)
) STRICT;

CREATE TABLE endings (
  ending  TEXT NOT NULL PRIMARY KEY,
  meaning TEXT NOT NULL
) STRICT;
INSERT INTO endings VALUES
  ('arrived', 'the robot says that it stands at its goal'),
  ('no_way', 'it says that there is no way there'),
  ('lost', 'it says that it does not know where it is'),
  ('silent', 'it was not heard any more, or what it said made no sense'),
  ('gave_up', 'it took longer than the navigator has patience');

CREATE TABLE "missions" (
  world     TEXT NOT NULL,
  mission   INTEGER NOT NULL,
  seed      TEXT NOT NULL,
  rules     TEXT NOT NULL,
  start_x   REAL NOT NULL,
  start_y   REAL NOT NULL,
  goal_x    REAL NOT NULL,
  goal_y    REAL NOT NULL,
  obstacles INTEGER NOT NULL,
  ending    TEXT NOT NULL REFERENCES endings,
  length    REAL NOT NULL,
  optimum   REAL,
  seconds   REAL NOT NULL,
  at        TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now')), robot TEXT,
  PRIMARY KEY (world, mission)
) STRICT;

CREATE TABLE "journal" (
  world     TEXT NOT NULL,
  mission   INTEGER NOT NULL,
  entry     INTEGER NOT NULL,
  time      REAL NOT NULL,
  event     TEXT NOT NULL,
  state     TEXT,
  next      TEXT,
  action    TEXT,
  rule      TEXT,
  table_row INTEGER,
  file      TEXT,
  line      INTEGER,
  x         REAL NOT NULL,
  y         REAL NOT NULL,
  heading   REAL NOT NULL,
  true_x    REAL,
  true_y    REAL,
  true_heading REAL,
  detail    TEXT,
  PRIMARY KEY (world, mission, entry),
  FOREIGN KEY (world, mission) REFERENCES "missions" ON DELETE CASCADE
) STRICT;

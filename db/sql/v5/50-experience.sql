-- What a robot has learned in a cell (`adit plan CELL --db`), each cell under its name. Lengths in metres, angles in
-- radians, as exact as the planner has them; configurations and paths are JSON. What broke or was taken out stays, with
-- the task in which it did.
CREATE TABLE IF NOT EXISTS cells (
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

-- The objects as the planner last saw them; `revision` is the state of the cell since which one is as it is.
CREATE TABLE IF NOT EXISTS cell_objects (
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

-- How objects changed, and before which task.
CREATE TABLE IF NOT EXISTS object_changes (
  cell     TEXT NOT NULL REFERENCES cells ON DELETE CASCADE,
  revision INTEGER NOT NULL,
  object   TEXT NOT NULL,
  task     INTEGER NOT NULL,
  how      TEXT NOT NULL CHECK (how IN ('appeared', 'gone', 'moved', 'reshaped')),
  PRIMARY KEY (cell, revision, object)
) STRICT;

-- Subgoals: where the robot was, and as a tag-point where its tool was in the frame of the object that serves as landmark
-- (object NULL: it hangs on none). removed_task NULL: it is there.
CREATE TABLE IF NOT EXISTS subgoals (
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

-- What Reach connects, or did: `via` are the configurations between the two subgoals where it does not go straight;
-- `loose`: nothing is known of it since a subgoal at its end moved along with an object.
CREATE TABLE IF NOT EXISTS edges (
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
CREATE UNIQUE INDEX IF NOT EXISTS edges_between ON edges (cell, subgoal1, subgoal2) WHERE removed_task IS NULL;
CREATE TRIGGER IF NOT EXISTS edges_replaced BEFORE INSERT ON edges BEGIN
  UPDATE edges SET removed_task = new.made_task, because = 'replaced'
  WHERE cell = new.cell AND subgoal1 = new.subgoal1 AND subgoal2 = new.subgoal2 AND removed_task IS NULL;
  DELETE FROM subgoal_pairs
  WHERE cell = new.cell AND subgoal1 = new.subgoal1 AND subgoal2 = new.subgoal2 AND kind = 'refused';
END;

-- Pairs of subgoals that were looked at in that state of the cell: a shortcut between them is not free, or the path
-- between them was tightened.
CREATE TABLE IF NOT EXISTS subgoal_pairs (
  cell     TEXT NOT NULL REFERENCES cells ON DELETE CASCADE,
  subgoal1 INTEGER NOT NULL,
  subgoal2 INTEGER NOT NULL,
  kind     TEXT NOT NULL CHECK (kind IN ('refused', 'tightened')),
  revision INTEGER NOT NULL,
  PRIMARY KEY (cell, subgoal1, subgoal2, kind)
) STRICT, WITHOUT ROWID;

-- What evaluations taught about objects, in the frame of each: within so many metres of a segment all is free of it, or of
-- a point all is taken by it (bx, by NULL).
CREATE TABLE IF NOT EXISTS clearances (
  cell   TEXT NOT NULL REFERENCES cells ON DELETE CASCADE,
  object TEXT NOT NULL,
  kind   TEXT NOT NULL CHECK (kind IN ('free', 'taken')),
  ax     REAL NOT NULL,
  ay     REAL NOT NULL,
  bx     REAL,
  by     REAL,
  within REAL NOT NULL
) STRICT;
CREATE INDEX IF NOT EXISTS clearances_of ON clearances (cell, object);

-- Tasks in their order, numbered from 1: where to, what came of it, and what it cost. An evaluation is one configuration
-- of the robot against one object; length is by the distance of configurations.
CREATE TABLE IF NOT EXISTS tasks (
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

-- What rules decided before a task about the experience after a change, what they were told (JSON), and which of them did.
CREATE TABLE IF NOT EXISTS strategies (
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

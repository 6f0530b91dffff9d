-- Missions of robots on floor plans (`adit simulate`), each under the name of its world and its number.
CREATE TABLE IF NOT EXISTS missions (
  world     TEXT NOT NULL,
  mission   INTEGER NOT NULL,
  seed      TEXT NOT NULL,
  rules     TEXT NOT NULL,
  start_x   REAL NOT NULL,
  start_y   REAL NOT NULL,
  goal_x    REAL NOT NULL,
  goal_y    REAL NOT NULL,
  obstacles INTEGER NOT NULL,
  ending    TEXT NOT NULL CHECK (ending IN ('arrived', 'no_way', 'gave_up')),
  length    REAL NOT NULL,
  optimum   REAL,
  seconds   REAL NOT NULL,
  at        TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now')),
  PRIMARY KEY (world, mission)
) STRICT;

-- What happened, entry by entry: seconds by the robot's clock, where it thought it was, and where it was, in metres and
-- degrees. Of a change of state `state`, `next` and `action` say which, `rule`, `table_row`, `file` and `line` by what,
-- and `detail` what the rules were told; of other events `detail` has what there is, as JSON.
CREATE TABLE IF NOT EXISTS journal (
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
  true_x    REAL NOT NULL,
  true_y    REAL NOT NULL,
  true_heading REAL NOT NULL,
  detail    TEXT,
  PRIMARY KEY (world, mission, entry),
  FOREIGN KEY (world, mission) REFERENCES missions ON DELETE CASCADE
) STRICT;

-- How a mission may end is a row, so that another ending needs no other table. Of a robot that is no simulation nobody knows where it
-- really was.
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

CREATE TABLE new_missions (
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
  at        TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now')),
  PRIMARY KEY (world, mission)
) STRICT;
INSERT INTO new_missions
SELECT world, mission, seed, rules, start_x, start_y, goal_x, goal_y, obstacles, ending, length, optimum, seconds, at FROM missions;

CREATE TABLE new_journal (
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
  FOREIGN KEY (world, mission) REFERENCES new_missions ON DELETE CASCADE
) STRICT;
INSERT INTO new_journal
SELECT world, mission, entry, time, event, state, next, action, rule, table_row, file, line, x, y, heading, true_x, true_y,
  true_heading, detail FROM journal;

DROP TABLE journal;
DROP TABLE missions;
ALTER TABLE new_missions RENAME TO missions;
ALTER TABLE new_journal RENAME TO journal;

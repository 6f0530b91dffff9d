-- What robots measured on their way: so many metres in a state took so many seconds, joules, ... The rows of one mission
-- share one measured total, which stands in each of them.
CREATE TABLE traversals (
  id       INTEGER PRIMARY KEY AUTOINCREMENT,
  mission  TEXT CONSTRAINT "mission must not be empty" CHECK (length(trim(mission)) > 0),
  robot    TEXT NOT NULL,
  state    TEXT NOT NULL,
  distance REAL NOT NULL CONSTRAINT "distance must be more than 0 and at most 1e9" CHECK (distance > 0 AND distance <= 1e9),
  measured REAL NOT NULL CONSTRAINT "measured must be at least 0 and at most 1e12" CHECK (measured >= 0 AND measured <= 1e12),
  measure  TEXT NOT NULL CONSTRAINT "measure must not be empty" CHECK (length(trim(measure)) > 0),
  who      TEXT NOT NULL,
  at       TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now'))
) STRICT;
CREATE INDEX traversals_by_mission ON traversals (robot, measure, mission);

-- What every database has. Made of the steps by a test (src/migrate/sum_tests.rs).

CREATE TABLE site (
  key   TEXT PRIMARY KEY CONSTRAINT "key must not be empty" CHECK (length(key) > 0),
  value TEXT NOT NULL
) STRICT, WITHOUT ROWID;

CREATE TABLE robots (
  robot    TEXT NOT NULL CONSTRAINT "robot must not be empty" CHECK (length(robot) > 0),
  state    TEXT NOT NULL CONSTRAINT "state must not be empty" CHECK (length(state) > 0),
  action   TEXT NOT NULL CONSTRAINT "action must not be empty" CHECK (length(action) > 0),
  height   REAL NOT NULL CONSTRAINT "height must be finite and not negative" CHECK (height BETWEEN 0 AND 1e300),
  width    REAL NOT NULL CONSTRAINT "width must be finite and not negative" CHECK (width BETWEEN 0 AND 1e300),
  hardness REAL NOT NULL CONSTRAINT "hardness must be finite and not negative" CHECK (hardness BETWEEN 0 AND 1e300),
  position INTEGER NOT NULL DEFAULT 0 CONSTRAINT "position must not be negative" CHECK (position >= 0), length REAL CONSTRAINT "length must be finite and more than 0" CHECK (length > 0 AND length <= 1e300), speed REAL CONSTRAINT "speed must be finite and more than 0" CHECK (speed > 0 AND speed <= 1e300), power REAL CONSTRAINT "power must be finite and not negative" CHECK (power BETWEEN 0 AND 1e300),
  PRIMARY KEY (robot, state)
) STRICT, WITHOUT ROWID;
CREATE TRIGGER stale_robots_insert AFTER INSERT ON robots WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('robots', NEW.robot || '/' || NEW.state);
END;
CREATE TRIGGER stale_robots_update AFTER UPDATE ON robots WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('robots', NEW.robot || '/' || NEW.state);
END;
CREATE TRIGGER stale_robots_delete AFTER DELETE ON robots WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('robots', OLD.robot || '/' || OLD.state);
END;

CREATE TABLE changes (
  robot      TEXT NOT NULL,
  from_state TEXT NOT NULL,
  to_state   TEXT NOT NULL,
  hardness   REAL NOT NULL CONSTRAINT "hardness must be finite and not negative" CHECK (hardness BETWEEN 0 AND 1e300), seconds REAL CONSTRAINT "seconds must be finite and not negative" CHECK (seconds BETWEEN 0 AND 1e300), joules REAL CONSTRAINT "joules must be finite and not negative" CHECK (joules BETWEEN 0 AND 1e300),
  PRIMARY KEY (robot, from_state, to_state),
  FOREIGN KEY (robot, from_state) REFERENCES robots (robot, state) ON UPDATE CASCADE ON DELETE CASCADE,
  FOREIGN KEY (robot, to_state) REFERENCES robots (robot, state) ON UPDATE CASCADE ON DELETE CASCADE
) STRICT, WITHOUT ROWID;
CREATE TRIGGER stale_changes_insert AFTER INSERT ON changes WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('changes', NEW.robot || '/' || NEW.from_state || '/' || NEW.to_state);
END;
CREATE TRIGGER stale_changes_update AFTER UPDATE ON changes WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('changes', NEW.robot || '/' || NEW.from_state || '/' || NEW.to_state);
END;
CREATE TRIGGER stale_changes_delete AFTER DELETE ON changes WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('changes', OLD.robot || '/' || OLD.from_state || '/' || OLD.to_state);
END;

CREATE TABLE places (
  place TEXT PRIMARY KEY CONSTRAINT "place must not be empty" CHECK (length(place) > 0),
  x REAL NOT NULL CONSTRAINT "x must be finite" CHECK (x BETWEEN -1e300 AND 1e300),
  y REAL NOT NULL CONSTRAINT "y must be finite" CHECK (y BETWEEN -1e300 AND 1e300)
) STRICT, WITHOUT ROWID;
CREATE TRIGGER stale_places_insert AFTER INSERT ON places WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('places', NEW.place);
END;
CREATE TRIGGER stale_places_update AFTER UPDATE ON places WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('places', NEW.place);
END;
CREATE TRIGGER stale_places_delete AFTER DELETE ON places WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('places', OLD.place);
END;

CREATE TABLE frames (
  frame TEXT PRIMARY KEY CONSTRAINT "frame must not be empty" CHECK (length(frame) > 0),
  x   REAL NOT NULL CONSTRAINT "x must be finite" CHECK (x BETWEEN -1e300 AND 1e300),
  y   REAL NOT NULL CONSTRAINT "y must be finite" CHECK (y BETWEEN -1e300 AND 1e300),
  yaw REAL NOT NULL CONSTRAINT "yaw must be finite" CHECK (yaw BETWEEN -1e300 AND 1e300)
) STRICT, WITHOUT ROWID;

CREATE TABLE rules (
  rule    INTEGER PRIMARY KEY,
  name    TEXT NOT NULL CONSTRAINT "name must not be empty" CHECK (length(name) > 0),
  version TEXT NOT NULL,
  file    TEXT,
  line    INTEGER
) STRICT;

CREATE TABLE witnesses (
  witness INTEGER PRIMARY KEY,
  facts   TEXT NOT NULL
) STRICT;

CREATE TABLE derivations (
  class    TEXT NOT NULL,
  key      ANY NOT NULL,
  property TEXT NOT NULL,
  value    ANY,
  rule     INTEGER NOT NULL,
  witness  INTEGER,
  PRIMARY KEY (class, key, property)
) STRICT, WITHOUT ROWID;

CREATE TABLE strips (
  axis  TEXT NOT NULL CHECK (axis IN ('x', 'y')),
  strip INTEGER NOT NULL CHECK (strip >= 0),
  low   REAL NOT NULL,
  high  REAL NOT NULL CHECK (high > low),
  PRIMARY KEY (axis, strip)
) STRICT, WITHOUT ROWID;

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
  action_witness   INTEGER, passable INTEGER CONSTRAINT "passable must be 0 or 1" CHECK (passable IN (0, 1)), passable_rule INTEGER, passable_witness INTEGER, facing REAL CONSTRAINT "facing must be from 0 to less than 180" CHECK (facing >= 0 AND facing < 180), outline TEXT CONSTRAINT "outline must be a JSON list of at least three corners [x,y]"
  CHECK (outline IS NULL OR json_valid(outline) AND json_array_length(outline) >= 3), radius REAL, space INTEGER, berth REAL, berth_cost REAL, measures TEXT CONSTRAINT "measures must be a JSON object" CHECK (json_type(measures) = 'object'),
  CONSTRAINT "a room has a robot and a state, or neither" CHECK ((robot IS NULL) = (state IS NULL))
) STRICT;
CREATE TRIGGER stale_rooms_insert AFTER INSERT ON rooms WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('rooms', NEW.room);
  DELETE FROM blocks WHERE class = 'rooms';
END;
CREATE TRIGGER stale_rooms_update AFTER UPDATE ON rooms WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('rooms', NEW.room);
  DELETE FROM blocks WHERE class = 'rooms';
END;
CREATE TRIGGER stale_rooms_delete AFTER DELETE ON rooms WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('rooms', OLD.room);
  DELETE FROM blocks WHERE class = 'rooms';
END;

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
  passable_witness INTEGER, measures TEXT CONSTRAINT "measures must be a JSON object" CHECK (json_type(measures) = 'object'),
  CONSTRAINT "a door joins two rooms" CHECK (room1 <> room2)
) STRICT;
CREATE INDEX doors_by_room1 ON doors (room1);
CREATE INDEX doors_by_room2 ON doors (room2);
CREATE TRIGGER stale_doors_insert AFTER INSERT ON doors WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('doors', NEW.door);
  DELETE FROM blocks WHERE class = 'doors';
END;
CREATE TRIGGER stale_doors_update AFTER UPDATE ON doors WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('doors', NEW.door);
  DELETE FROM blocks WHERE class = 'doors';
END;
CREATE TRIGGER stale_doors_delete AFTER DELETE ON doors WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('doors', OLD.door);
  DELETE FROM blocks WHERE class = 'doors';
END;

CREATE TABLE stale_marks (
  table_name TEXT NOT NULL,
  key        TEXT NOT NULL,
  PRIMARY KEY (table_name, key)
) STRICT, WITHOUT ROWID;

CREATE TABLE writer (
  only  INTEGER PRIMARY KEY CHECK (only = 1),
  quiet INTEGER NOT NULL CHECK (quiet IN (0, 1))
) STRICT;
INSERT INTO writer VALUES
  (1, 0);

CREATE TABLE starts (
  name  TEXT NOT NULL CHECK (length(name) > 0),
  robot TEXT NOT NULL CHECK (length(robot) > 0),
  tree  INTEGER NOT NULL,
  PRIMARY KEY (name, robot)
) STRICT, WITHOUT ROWID;

CREATE TABLE ends (
  name TEXT PRIMARY KEY CHECK (length(name) > 0),
  node INTEGER NOT NULL,
  kind TEXT NOT NULL CHECK (kind IN ('place', 'room'))
, kept INTEGER NOT NULL DEFAULT 1 CHECK (kept IN (0, 1))) STRICT, WITHOUT ROWID;

CREATE TABLE tree_rows (
  tree      INTEGER NOT NULL,
  node      INTEGER NOT NULL,
  prev      INTEGER,
  from_room INTEGER,
  door      INTEGER,
  hops      INTEGER NOT NULL,
  reach     REAL NOT NULL,
  leg       REAL NOT NULL,
  x         REAL,
  y         REAL,
  heading   INTEGER, distance REAL, clearance REAL, bend INTEGER NOT NULL DEFAULT 1 CHECK (bend IN (0, 1)), walked REAL,
  PRIMARY KEY (tree, node)
) STRICT, WITHOUT ROWID;

CREATE TABLE step_parts (part INTEGER PRIMARY KEY CHECK (part BETWEEN 0 AND 2)) STRICT;
INSERT INTO step_parts VALUES
  (0), (1), (2);

CREATE TABLE history (
  id          INTEGER PRIMARY KEY AUTOINCREMENT,
  at          TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ', 'now')),
  who         TEXT NOT NULL,
  why         TEXT NOT NULL,
  table_name  TEXT NOT NULL,
  key         TEXT NOT NULL,
  column_name TEXT,
  old         ANY,
  new         ANY,
  undone      INTEGER REFERENCES history (id)
, change_set INTEGER REFERENCES history (id)) STRICT;
CREATE INDEX history_open ON history (id) WHERE change_set IS NULL;
CREATE INDEX history_by_change_set ON history (change_set);

CREATE TABLE prime_area_strips (
  area    INTEGER PRIMARY KEY CHECK (area > 0),
  x_first INTEGER NOT NULL CHECK (x_first >= 0),
  x_last  INTEGER NOT NULL CHECK (x_last >= x_first),
  y_first INTEGER NOT NULL CHECK (y_first >= 0),
  y_last  INTEGER NOT NULL CHECK (y_last >= y_first),
  open    INTEGER CHECK (open IN (0, 1)),
  open_rule    INTEGER,
  open_witness INTEGER
) STRICT;

CREATE TABLE told (
  id       INTEGER PRIMARY KEY AUTOINCREMENT,
  class    TEXT NOT NULL CONSTRAINT "class must not be empty" CHECK (length(class) > 0),
  key      TEXT CONSTRAINT "key must not be empty" CHECK (length(key) > 0),
  x REAL CONSTRAINT "x must be finite" CHECK (x BETWEEN -1e300 AND 1e300),
  y REAL CONSTRAINT "y must be finite" CHECK (y BETWEEN -1e300 AND 1e300),
  x0 REAL, y0 REAL, x1 REAL, y1 REAL,
  property TEXT NOT NULL CONSTRAINT "property must not be empty" CHECK (length(property) > 0),
  kind     TEXT NOT NULL CONSTRAINT "kind must be number, text or truth" CHECK (kind IN ('number', 'text', 'truth')),
  value    ANY NOT NULL,
  until    TEXT CONSTRAINT "until must be a time in UTC, like 2026-11-21T18:00:00Z"
           CHECK (strftime('%Y-%m-%dT%H:%M:%SZ', until) IS until),
  who      TEXT NOT NULL DEFAULT '',
  why      TEXT NOT NULL DEFAULT '',
  at       TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now')),
  CONSTRAINT "a fact has a key or a point, not both" CHECK ((key IS NULL) = (x IS NOT NULL) AND (x IS NULL) = (y IS NULL)),
  CONSTRAINT "a segment has two ends" CHECK ((x0 IS NULL) = (y0 IS NULL) AND (x0 IS NULL) = (x1 IS NULL) AND (x0 IS NULL) = (y1 IS NULL)),
  CONSTRAINT "the value must be of the kind" CHECK (CASE kind WHEN 'text' THEN typeof(value) = 'text'
    WHEN 'truth' THEN typeof(value) = 'integer' AND value IN (0, 1) ELSE typeof(value) IN ('real', 'integer') END)
) STRICT;
CREATE TRIGGER stale_told_insert AFTER INSERT ON told WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('told', NEW.id);
END;
CREATE TRIGGER stale_told_update AFTER UPDATE ON told WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('told', NEW.id);
END;
CREATE TRIGGER stale_told_delete AFTER DELETE ON told WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('told', OLD.id);
END;

CREATE TABLE attachments (
  told INTEGER NOT NULL,
  key  TEXT NOT NULL,
  PRIMARY KEY (told, key)
) STRICT, WITHOUT ROWID;

CREATE TABLE told_states (
  told  INTEGER PRIMARY KEY,
  state TEXT NOT NULL CHECK (state IN ('attached', 'lost', 'expired'))
) STRICT;

CREATE TABLE hours (
  name   TEXT NOT NULL CONSTRAINT "name must not be empty" CHECK (length(name) > 0),
  days   TEXT NOT NULL DEFAULT 'mon-sun' CONSTRAINT "days must not be empty" CHECK (length(days) > 0),
  opens  TEXT NOT NULL CONSTRAINT "opens must be a time from 00:00 to 23:59"
         CHECK (opens GLOB '[0-2][0-9]:[0-5][0-9]' AND opens < '24:00'),
  closes TEXT NOT NULL CONSTRAINT "closes must be a time up to 24:00"
         CHECK (closes GLOB '[0-2][0-9]:[0-5][0-9]' AND closes <= '24:00'),
  PRIMARY KEY (name, days, opens),
  CONSTRAINT "hours end before they begin: hours past midnight are two rows, one up to 24:00 and one from 00:00"
    CHECK (closes > opens)
) STRICT, WITHOUT ROWID;
CREATE TRIGGER stale_hours_insert AFTER INSERT ON hours WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('hours', NEW.name);
END;
CREATE TRIGGER stale_hours_update AFTER UPDATE ON hours WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('hours', NEW.name);
END;
CREATE TRIGGER stale_hours_delete AFTER DELETE ON hours WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('hours', OLD.name);
END;

CREATE TABLE site_hours (
  name TEXT NOT NULL, days TEXT NOT NULL, opens TEXT NOT NULL, closes TEXT NOT NULL,
  PRIMARY KEY (name, days, opens)
) STRICT, WITHOUT ROWID;

CREATE TABLE tuning_cells (
  tuning      TEXT NOT NULL CONSTRAINT "tuning must not be empty" CHECK (length(tuning) > 0),
  table_name  TEXT NOT NULL,
  key         TEXT NOT NULL,
  column_name TEXT NOT NULL,
  value       ANY,
  PRIMARY KEY (tuning, table_name, key, column_name)
) STRICT, WITHOUT ROWID;
CREATE TRIGGER stale_tuning_cells_insert AFTER INSERT ON tuning_cells WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('tuning_cells', NEW.tuning);
END;
CREATE TRIGGER stale_tuning_cells_update AFTER UPDATE ON tuning_cells WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('tuning_cells', NEW.tuning);
END;
CREATE TRIGGER stale_tuning_cells_delete AFTER DELETE ON tuning_cells WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('tuning_cells', OLD.tuning);
END;

CREATE TABLE active_tunings (
  tuning TEXT PRIMARY KEY CONSTRAINT "tuning must not be empty" CHECK (length(tuning) > 0)
) STRICT, WITHOUT ROWID;
CREATE TRIGGER stale_active_tunings_insert AFTER INSERT ON active_tunings WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('active_tunings', NEW.tuning);
END;
CREATE TRIGGER stale_active_tunings_update AFTER UPDATE ON active_tunings WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('active_tunings', NEW.tuning);
END;
CREATE TRIGGER stale_active_tunings_delete AFTER DELETE ON active_tunings WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('active_tunings', OLD.tuning);
END;

CREATE TABLE loads (
  robot   TEXT NOT NULL CONSTRAINT "robot must not be empty" CHECK (length(robot) > 0),
  load    TEXT NOT NULL CONSTRAINT "load must not be empty" CHECK (length(load) > 0),
  height  REAL NOT NULL CONSTRAINT "height must be finite and not negative" CHECK (height BETWEEN 0 AND 1e300),
  width   REAL NOT NULL CONSTRAINT "width must be finite and not negative" CHECK (width BETWEEN 0 AND 1e300),
  carried INTEGER NOT NULL CONSTRAINT "carried must be 0 or 1" CHECK (carried IN (0, 1)),
  PRIMARY KEY (robot, load)
) STRICT, WITHOUT ROWID;
CREATE TRIGGER stale_loads_insert AFTER INSERT ON loads WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('loads', NEW.robot || '/' || NEW.load);
END;
CREATE TRIGGER stale_loads_update AFTER UPDATE ON loads WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('loads', NEW.robot || '/' || NEW.load);
END;
CREATE TRIGGER stale_loads_delete AFTER DELETE ON loads WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('loads', OLD.robot || '/' || OLD.load);
END;

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

CREATE TABLE saved_queries (
  name  TEXT PRIMARY KEY CONSTRAINT "name must not be empty" CHECK (length(trim(name)) > 0),
  query TEXT NOT NULL,
  who   TEXT NOT NULL,
  at    TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now'))
) STRICT;

CREATE TABLE blocks (
  class TEXT NOT NULL CHECK (class IN ('rooms', 'doors')),
  part  TEXT NOT NULL CHECK (part IN ('cut', 'weights')),
  at    INTEGER NOT NULL,
  first INTEGER NOT NULL,
  bytes BLOB NOT NULL,
  PRIMARY KEY (class, part, first)
) STRICT;

CREATE TABLE spaces (
  space   INTEGER PRIMARY KEY,
  called  TEXT,
  name    TEXT,
  kind    TEXT,
  area    REAL NOT NULL,
  breadth REAL NOT NULL,
  x       REAL NOT NULL,
  y       REAL NOT NULL,
  outline TEXT NOT NULL CONSTRAINT "outline must be a JSON list of rings" CHECK (json_valid(outline)),
  closed  INTEGER CHECK (closed IN (0, 1))
) STRICT;
CREATE TRIGGER spaces_follow_insert BEFORE INSERT ON spaces WHEN (SELECT NOT quiet FROM writer) BEGIN
    SELECT RAISE(ABORT, 'spaces follow from the map, rules and what is told: nothing comes of a row of your own; close one by adit close, or by a row of told');
END;
CREATE TRIGGER spaces_follow_update BEFORE UPDATE ON spaces WHEN (SELECT NOT quiet FROM writer) BEGIN
    SELECT RAISE(ABORT, 'spaces follow from the map, rules and what is told: nothing comes of what is set here; close one by adit close, or by a row of told');
END;
CREATE TRIGGER spaces_follow_delete BEFORE DELETE ON spaces WHEN (SELECT NOT quiet FROM writer) BEGIN
    SELECT RAISE(ABORT, 'spaces follow from the map, rules and what is told: none is taken away here');
END;

CREATE TABLE doorways (
  doorway INTEGER PRIMARY KEY,
  called  TEXT,
  name    TEXT,
  space1  INTEGER NOT NULL,
  space2  INTEGER NOT NULL,
  x       REAL NOT NULL,
  y       REAL NOT NULL,
  x0      REAL NOT NULL,
  y0      REAL NOT NULL,
  x1      REAL NOT NULL,
  y1      REAL NOT NULL,
  width   REAL NOT NULL,
  height  REAL,
  closed  INTEGER CHECK (closed IN (0, 1))
, closed_from TEXT) STRICT;
CREATE INDEX doorways_by_spaces ON doorways (space1, space2);
CREATE TRIGGER doorways_follow_insert BEFORE INSERT ON doorways WHEN (SELECT NOT quiet FROM writer) BEGIN
    SELECT RAISE(ABORT, 'doorways follow from the map, rules and what is told: nothing comes of a row of your own; declare one by adit open, or by a row of told');
END;
CREATE TRIGGER doorways_follow_update BEFORE UPDATE ON doorways WHEN (SELECT NOT quiet FROM writer) BEGIN
    SELECT RAISE(ABORT, 'doorways follow from the map, rules and what is told: nothing comes of what is set here; close one by adit close, or by a row of told');
END;
CREATE TRIGGER doorways_follow_delete BEFORE DELETE ON doorways WHEN (SELECT NOT quiet FROM writer) BEGIN
    SELECT RAISE(ABORT, 'doorways follow from the map, rules and what is told: none is taken away here; close one by adit close, or by a row of told');
END;

CREATE TABLE carried_out (
  rule    TEXT NOT NULL,
  version TEXT NOT NULL,
  because TEXT NOT NULL
) STRICT;

CREATE TABLE courses (
  robot     TEXT NOT NULL,
  start     TEXT NOT NULL,
  goal      TEXT NOT NULL,
  status    TEXT NOT NULL CHECK (status IN ('ok', 'no_route')),
  reason    TEXT,
  remarks   TEXT NOT NULL,
  cost      REAL,
  distance  REAL,
  clearance REAL,
  steps     INTEGER, measures TEXT,
  PRIMARY KEY (start, goal, robot)
) STRICT, WITHOUT ROWID;

CREATE TABLE course_steps (
  robot    TEXT NOT NULL,
  start    TEXT NOT NULL,
  goal     TEXT NOT NULL,
  step     INTEGER NOT NULL,
  kind     TEXT NOT NULL,
  place    TEXT NOT NULL,
  state    TEXT,
  action   TEXT,
  hardness REAL,
  cost     REAL NOT NULL,
  x        REAL,
  y        REAL,
  z        REAL,
  heading  REAL,
  rule     TEXT, measures TEXT,
  PRIMARY KEY (start, goal, robot, step)
) STRICT, WITHOUT ROWID;

CREATE TABLE course_waypoints (
  robot     TEXT NOT NULL,
  start     TEXT NOT NULL,
  goal      TEXT NOT NULL,
  waypoint  INTEGER NOT NULL,
  x         REAL NOT NULL,
  y         REAL NOT NULL,
  z         REAL,
  heading   REAL,
  state     TEXT,
  action    TEXT,
  clearance REAL,
  distance  REAL,
  cost      REAL NOT NULL,
  centre_x  REAL,
  centre_y  REAL,
  turn      TEXT CHECK (turn IN ('left', 'right')), measures TEXT,
  PRIMARY KEY (start, goal, robot, waypoint)
) STRICT, WITHOUT ROWID;

CREATE TABLE octets (
  octet INTEGER PRIMARY KEY,
  data  BLOB NOT NULL UNIQUE,
  power REAL NOT NULL UNIQUE
) STRICT;
INSERT INTO octets VALUES
  (0, X'00', 2.93873587705571877e-39),
  (1, X'01', 5.87747175411143754e-39),
  (2, X'02', 1.175494350822287508e-38),
  (3, X'03', 2.350988701644575016e-38),
  (4, X'04', 4.70197740328915e-38),
  (5, X'05', 9.4039548065783e-38),
  (6, X'06', 1.88079096131566e-37),
  (7, X'07', 3.76158192263132e-37),
  (8, X'08', 7.52316384526264e-37),
  (9, X'09', 1.504632769052528011e-36),
  (10, X'0A', 3.009265538105056021e-36),
  (11, X'0B', 6.018531076210112041e-36),
  (12, X'0C', 1.203706215242022408e-35),
  (13, X'0D', 2.407412430484044816e-35),
  (14, X'0E', 4.81482486096809e-35),
  (15, X'0F', 9.62964972193618e-35),
  (16, X'10', 1.925929944387235853e-34),
  (17, X'11', 3.851859888774471706e-34),
  (18, X'12', 7.703719777548943412e-34),
  (19, X'13', 1.540743955509788682e-33),
  (20, X'14', 3.081487911019577364e-33),
  (21, X'15', 6.162975822039154729e-33),
  (22, X'16', 1.232595164407830946e-32),
  (23, X'17', 2.465190328815661892e-32),
  (24, X'18', 4.930380657631323784e-32),
  (25, X'19', 9.86076131526264756e-32),
  (26, X'1A', 1.972152263052529513e-31),
  (27, X'1B', 3.944304526105059027e-31),
  (28, X'1C', 7.888609052210118054e-31),
  (29, X'1D', 1.577721810442023611e-30),
  (30, X'1E', 3.155443620884047222e-30),
  (31, X'1F', 6.310887241768094444e-30),
  (32, X'20', 1.262177448353618889e-29),
  (33, X'21', 2.524354896707237778e-29),
  (34, X'22', 5.048709793414475555e-29),
  (35, X'23', 1.00974195868289511e-28),
  (36, X'24', 2.019483917365790221e-28),
  (37, X'25', 4.038967834731580443e-28),
  (38, X'26', 8.077935669463160887e-28),
  (39, X'27', 1.615587133892632177e-27),
  (40, X'28', 3.231174267785264354e-27),
  (41, X'29', 6.462348535570528709e-27),
  (42, X'2A', 1.292469707114105742e-26),
  (43, X'2B', 2.584939414228211484e-26),
  (44, X'2C', 5.169878828456422968e-26),
  (45, X'2D', 1.033975765691284594e-25),
  (46, X'2E', 2.067951531382569188e-25),
  (47, X'2F', 4.135903062765138375e-25),
  (48, X'30', 8.271806125530276749e-25),
  (49, X'31', 1.65436122510605535e-24),
  (50, X'32', 3.3087224502121107e-24),
  (51, X'33', 6.617444900424221399e-24),
  (52, X'34', 1.32348898008484428e-23),
  (53, X'35', 2.64697796016968856e-23),
  (54, X'36', 5.29395592033937712e-23),
  (55, X'37', 1.058791184067875424e-22),
  (56, X'38', 2.117582368135750848e-22),
  (57, X'39', 4.235164736271501696e-22),
  (58, X'3A', 8.470329472543003391e-22),
  (59, X'3B', 1.694065894508600678e-21),
  (60, X'3C', 3.388131789017201356e-21),
  (61, X'3D', 6.776263578034402712e-21),
  (62, X'3E', 1.355252715606880542e-20),
  (63, X'3F', 2.710505431213761085e-20),
  (64, X'40', 5.42101086242752217e-20),
  (65, X'41', 1.084202172485504434e-19),
  (66, X'42', 2.168404344971008868e-19),
  (67, X'43', 4.336808689942017736e-19),
  (68, X'44', 8.673617379884035472e-19),
  (69, X'45', 1.734723475976807095e-18),
  (70, X'46', 3.469446951953614189e-18),
  (71, X'47', 6.938893903907228378e-18),
  (72, X'48', 1.387778780781445675e-17),
  (73, X'49', 2.775557561562891351e-17),
  (74, X'4A', 5.551115123125782702e-17),
  (75, X'4B', 1.11022302462515654e-16),
  (76, X'4C', 2.22044604925031308e-16),
  (77, X'4D', 4.440892098500626161e-16),
  (78, X'4E', 8.881784197001252323e-16),
  (79, X'4F', 1.776356839400250464e-15),
  (80, X'50', 3.552713678800500929e-15),
  (81, X'51', 7.105427357601001858e-15),
  (82, X'52', 1.421085471520200372e-14),
  (83, X'53', 2.842170943040400744e-14),
  (84, X'54', 5.684341886080801487e-14),
  (85, X'55', 1.136868377216160297e-13),
  (86, X'56', 2.273736754432320594e-13),
  (87, X'57', 4.547473508864641189e-13),
  (88, X'58', 9.094947017729282379e-13),
  (89, X'59', 1.818989403545856476e-12),
  (90, X'5A', 3.637978807091712952e-12),
  (91, X'5B', 7.275957614183425904e-12),
  (92, X'5C', 1.45519152283668518e-11),
  (93, X'5D', 2.910383045673370361e-11),
  (94, X'5E', 5.820766091346740722e-11),
  (95, X'5F', 1.164153218269348144e-10),
  (96, X'60', 2.328306436538696289e-10),
  (97, X'61', 4.656612873077392578e-10),
  (98, X'62', 9.31322574615478516e-10),
  (99, X'63', 1.862645149230957032e-09),
  (100, X'64', 3.725290298461914063e-09),
  (101, X'65', 7.450580596923828125e-09),
  (102, X'66', 1.490116119384765625e-08),
  (103, X'67', 2.98023223876953125e-08),
  (104, X'68', 5.9604644775390625e-08),
  (105, X'69', 1.1920928955078125e-07),
  (106, X'6A', 2.384185791015625e-07),
  (107, X'6B', 4.76837158203125e-07),
  (108, X'6C', 9.5367431640625e-07),
  (109, X'6D', 1.9073486328125e-06),
  (110, X'6E', 3.814697265625e-06),
  (111, X'6F', 7.62939453125e-06),
  (112, X'70', 1.52587890625e-05),
  (113, X'71', 3.0517578125e-05),
  (114, X'72', 6.103515625e-05),
  (115, X'73', 0.0001220703125),
  (116, X'74', 0.000244140625),
  (117, X'75', 0.00048828125),
  (118, X'76', 0.0009765625),
  (119, X'77', 0.001953125),
  (120, X'78', 0.00390625),
  (121, X'79', 0.0078125),
  (122, X'7A', 0.015625),
  (123, X'7B', 0.03125),
  (124, X'7C', 0.0625),
  (125, X'7D', 0.125),
  (126, X'7E', 0.25),
  (127, X'7F', 0.5),
  (128, X'80', 1.0),
  (129, X'81', 2.0),
  (130, X'82', 4.0),
  (131, X'83', 8.0),
  (132, X'84', 16.0),
  (133, X'85', 32.0),
  (134, X'86', 64.0),
  (135, X'87', 128.0),
  (136, X'88', 256.0),
  (137, X'89', 512.0),
  (138, X'8A', 1024.0),
  (139, X'8B', 2048.0),
  (140, X'8C', 4096.0),
  (141, X'8D', 8192.0),
  (142, X'8E', 16384.0),
  (143, X'8F', 32768.0),
  (144, X'90', 65536.0),
  (145, X'91', 131072.0),
  (146, X'92', 262144.0),
  (147, X'93', 524288.0),
  (148, X'94', 1048576.0),
  (149, X'95', 2097152.0),
  (150, X'96', 4194304.0),
  (151, X'97', 8388608.0),
  (152, X'98', 16777216.0),
  (153, X'99', 33554432.0),
  (154, X'9A', 67108864.0),
  (155, X'9B', 134217728.0),
  (156, X'9C', 268435456.0),
  (157, X'9D', 536870912.0),
  (158, X'9E', 1073741824.0),
  (159, X'9F', 2147483648.0),
  (160, X'A0', 4294967296.0),
  (161, X'A1', 8589934592.0),
  (162, X'A2', 17179869184.0),
  (163, X'A3', 34359738368.0),
  (164, X'A4', 68719476736.0),
  (165, X'A5', 137438953472.0),
  (166, X'A6', 274877906944.0),
  (167, X'A7', 549755813888.0),
  (168, X'A8', 1099511627776.0),
  (169, X'A9', 2199023255552.0),
  (170, X'AA', 4398046511104.0),
  (171, X'AB', 8796093022208.0),
  (172, X'AC', 17592186044416.0),
  (173, X'AD', 35184372088832.0),
  (174, X'AE', 70368744177664.0),
  (175, X'AF', 140737488355328.0),
  (176, X'B0', 281474976710656.0),
  (177, X'B1', 562949953421312.0),
  (178, X'B2', 1.125899906842624e+15),
  (179, X'B3', 2.251799813685248e+15),
  (180, X'B4', 4.503599627370496e+15),
  (181, X'B5', 9.007199254740992e+15),
  (182, X'B6', 1.8014398509481984e+16),
  (183, X'B7', 3.6028797018963968e+16),
  (184, X'B8', 7.2057594037927936e+16),
  (185, X'B9', 1.44115188075855872e+17),
  (186, X'BA', 2.88230376151711744e+17),
  (187, X'BB', 5.76460752303423488e+17),
  (188, X'BC', 1.152921504606846976e+18),
  (189, X'BD', 2.305843009213693952e+18),
  (190, X'BE', 4.611686018427387904e+18),
  (191, X'BF', 9.22337203685477581e+18),
  (192, X'C0', 1.844674407370955162e+19),
  (193, X'C1', 3.689348814741910324e+19),
  (194, X'C2', 7.378697629483820647e+19),
  (195, X'C3', 1.47573952589676413e+20),
  (196, X'C4', 2.951479051793528259e+20),
  (197, X'C5', 5.902958103587056518e+20),
  (198, X'C6', 1.180591620717411304e+21),
  (199, X'C7', 2.361183241434822607e+21),
  (200, X'C8', 4.722366482869645214e+21),
  (201, X'C9', 9.44473296573929e+21),
  (202, X'CA', 1.888946593147858086e+22),
  (203, X'CB', 3.777893186295716171e+22),
  (204, X'CC', 7.555786372591432342e+22),
  (205, X'CD', 1.511157274518286469e+23),
  (206, X'CE', 3.022314549036572937e+23),
  (207, X'CF', 6.044629098073145874e+23),
  (208, X'D0', 1.208925819614629174e+24),
  (209, X'D1', 2.417851639229258349e+24),
  (210, X'D2', 4.835703278458516698e+24),
  (211, X'D3', 9.67140655691703339e+24),
  (212, X'D4', 1.934281311383406679e+25),
  (213, X'D5', 3.868562622766813359e+25),
  (214, X'D6', 7.737125245533626718e+25),
  (215, X'D7', 1.547425049106725344e+26),
  (216, X'D8', 3.094850098213450688e+26),
  (217, X'D9', 6.189700196426901375e+26),
  (218, X'DA', 1.237940039285380275e+27),
  (219, X'DB', 2.47588007857076055e+27),
  (220, X'DC', 4.9517601571415211e+27),
  (221, X'DD', 9.9035203142830422e+27),
  (222, X'DE', 1.98070406285660844e+28),
  (223, X'DF', 3.96140812571321688e+28),
  (224, X'E0', 7.92281625142643376e+28),
  (225, X'E1', 1.584563250285286751e+29),
  (226, X'E2', 3.169126500570573503e+29),
  (227, X'E3', 6.338253001141147007e+29),
  (228, X'E4', 1.267650600228229401e+30),
  (229, X'E5', 2.535301200456458802e+30),
  (230, X'E6', 5.070602400912917605e+30),
  (231, X'E7', 1.014120480182583522e+31),
  (232, X'E8', 2.028240960365167043e+31),
  (233, X'E9', 4.056481920730334085e+31),
  (234, X'EA', 8.11296384146066817e+31),
  (235, X'EB', 1.622592768292133633e+32),
  (236, X'EC', 3.245185536584267267e+32),
  (237, X'ED', 6.490371073168534535e+32),
  (238, X'EE', 1.298074214633706908e+33),
  (239, X'EF', 2.596148429267413815e+33),
  (240, X'F0', 5.192296858534827629e+33),
  (241, X'F1', 1.038459371706965525e+34),
  (242, X'F2', 2.076918743413931051e+34),
  (243, X'F3', 4.153837486827862102e+34),
  (244, X'F4', 8.307674973655724205e+34),
  (245, X'F5', 1.661534994731144842e+35),
  (246, X'F6', 3.32306998946229e+35),
  (247, X'F7', 6.64613997892458e+35),
  (248, X'F8', 1.329227995784915873e+36),
  (249, X'F9', 2.658455991569831746e+36),
  (250, X'FA', 5.316911983139663492e+36),
  (251, X'FB', 1.063382396627932698e+37),
  (252, X'FC', 2.126764793255865396e+37),
  (253, X'FD', 4.253529586511730793e+37),
  (254, X'FE', 8.507059173023461586e+37),
  (255, X'FF', 1.701411834604692317e+38);

CREATE TABLE area_outlines (
  area    TEXT PRIMARY KEY,
  kind    TEXT,
  outline TEXT NOT NULL CHECK (json_valid(outline))
, heading REAL) STRICT, WITHOUT ROWID;

CREATE TABLE drawn (
  fid        INTEGER PRIMARY KEY,
  geom       BLOB NOT NULL,
  name       TEXT UNIQUE,
  what       TEXT DEFAULT 'area',
  kind       TEXT,
  properties TEXT DEFAULT '{}',
  until      TEXT,
  why        TEXT DEFAULT ''
) STRICT;
CREATE TRIGGER drawn_insert AFTER INSERT ON drawn
WHEN NEW.name IS NULL OR NOT EXISTS (SELECT 1 FROM laid WHERE name = NEW.name) BEGIN
  SELECT RAISE(ABORT, 'an area is one polygon without holes, of three corners or more, each two finite numbers')
  WHERE (SELECT outline FROM drawn_outlines WHERE fid = NEW.fid) IS NULL;
  INSERT INTO laid (name, what, kind, outline, properties, until, why)
  SELECT coalesce(NEW.name, coalesce(NEW.what, 'area') || ' ' || NEW.fid), coalesce(NEW.what, 'area'), NEW.kind, outline,
    coalesce(NEW.properties, '{}'), NEW.until, coalesce(NEW.why, '')
  FROM drawn_outlines WHERE fid = NEW.fid;
  UPDATE drawn SET name = coalesce(NEW.name, coalesce(NEW.what, 'area') || ' ' || NEW.fid),
    what = coalesce(NEW.what, 'area'), properties = coalesce(NEW.properties, '{}'), why = coalesce(NEW.why, '')
  WHERE fid = NEW.fid;
END;
CREATE TRIGGER drawn_update AFTER UPDATE ON drawn
WHEN OLD.name IS NOT NULL AND NOT EXISTS (
  SELECT 1 FROM laid AS l JOIN laid_shapes AS s ON s.name = l.name
  WHERE l.name = NEW.name AND l.what = NEW.what AND l.kind IS NEW.kind AND l.properties = NEW.properties
    AND l.until IS NEW.until AND l.why = NEW.why AND s.geom = NEW.geom) BEGIN
  SELECT RAISE(ABORT, 'what lies over the map needs a name') WHERE NEW.name IS NULL;
  SELECT RAISE(ABORT, 'an area is one polygon without holes, of three corners or more, each two finite numbers')
  WHERE (SELECT outline FROM drawn_outlines WHERE fid = NEW.fid) IS NULL;
  UPDATE laid SET name = NEW.name, what = coalesce(NEW.what, 'area'), kind = NEW.kind,
    outline = (SELECT outline FROM drawn_outlines WHERE fid = NEW.fid), properties = coalesce(NEW.properties, '{}'),
    until = NEW.until, why = coalesce(NEW.why, '')
  WHERE name = OLD.name;
END;
CREATE TRIGGER drawn_delete AFTER DELETE ON drawn BEGIN
  DELETE FROM laid WHERE name = OLD.name;
END;
CREATE TRIGGER drawn_is_no_place BEFORE INSERT ON drawn
WHEN EXISTS (SELECT 1 FROM laid WHERE name = NEW.name AND what IN ('place', 'door')) BEGIN
  SELECT RAISE(ABORT, 'a place or a door of this name lies over the map already');
END;
CREATE TRIGGER drawn_becomes_no_place BEFORE UPDATE OF name ON drawn
WHEN EXISTS (SELECT 1 FROM laid WHERE name = NEW.name AND what IN ('place', 'door')) BEGIN
  SELECT RAISE(ABORT, 'a place or a door of this name lies over the map already');
END;

CREATE TABLE gpkg_spatial_ref_sys (
  srs_name                 TEXT NOT NULL,
  srs_id                   INTEGER NOT NULL PRIMARY KEY,
  organization             TEXT NOT NULL,
  organization_coordsys_id INTEGER NOT NULL,
  definition               TEXT NOT NULL,
  description              TEXT
);
INSERT INTO gpkg_spatial_ref_sys VALUES
  ('Undefined Cartesian SRS', -1, 'NONE', -1, 'undefined', 'metres of the map'),
  ('Undefined geographic SRS', 0, 'NONE', 0, 'undefined', 'undefined geographic coordinate reference system'),
  ('WGS 84 geodetic', 4326, 'EPSG', 4326, 'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563,AUTHORITY["EPSG","7030"]],AUTHORITY["EPSG","6326"]],PRIMEM["Greenwich",0,AUTHORITY["EPSG","8901"]],UNIT["degree",0.0174532925199433,AUTHORITY["EPSG","9122"]],AUTHORITY["EPSG","4326"]]', 'longitude and latitude');

CREATE TABLE gpkg_contents (
  table_name  TEXT NOT NULL PRIMARY KEY,
  data_type   TEXT NOT NULL,
  identifier  TEXT UNIQUE,
  description TEXT DEFAULT '',
  last_change DATETIME NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ', 'now')),
  min_x       DOUBLE,
  min_y       DOUBLE,
  max_x       DOUBLE,
  max_y       DOUBLE,
  srs_id      INTEGER,
  CONSTRAINT fk_gc_r_srs_id FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys (srs_id)
);
INSERT INTO gpkg_contents VALUES
  ('map_rooms', 'features', 'rooms', 'rooms of all layers, with what rules say', '2026-11-24T00:00:00.000Z', NULL, NULL, NULL, NULL, -1),
  ('map_spaces', 'features', 'spaces', 'spaces as people see them', '2026-11-24T00:00:00.000Z', NULL, NULL, NULL, NULL, -1),
  ('map_doorways', 'features', 'doorways', 'openings between spaces', '2026-11-24T00:00:00.000Z', NULL, NULL, NULL, NULL, -1),
  ('map_areas', 'features', 'areas', 'areas of the map, and those laid over it', '2026-11-24T00:00:00.000Z', NULL, NULL, NULL, NULL, -1),
  ('map_routes', 'features', 'routes', 'the routes that are kept', '2026-11-24T00:00:00.000Z', NULL, NULL, NULL, NULL, -1),
  ('drawn', 'features', 'drawn', 'areas and obstacles laid over the map: draw here', '2026-11-24T00:00:00.000Z', NULL, NULL, NULL, NULL, -1);

CREATE TABLE gpkg_geometry_columns (
  table_name         TEXT NOT NULL,
  column_name        TEXT NOT NULL,
  geometry_type_name TEXT NOT NULL,
  srs_id             INTEGER NOT NULL,
  z                  TINYINT NOT NULL,
  m                  TINYINT NOT NULL,
  CONSTRAINT pk_geom_cols PRIMARY KEY (table_name, column_name),
  CONSTRAINT uk_gc_table_name UNIQUE (table_name),
  CONSTRAINT fk_gc_tn FOREIGN KEY (table_name) REFERENCES gpkg_contents (table_name),
  CONSTRAINT fk_gc_srs FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys (srs_id)
);
INSERT INTO gpkg_geometry_columns VALUES
  ('drawn', 'geom', 'POLYGON', -1, 0, 0),
  ('map_areas', 'geom', 'POLYGON', -1, 0, 0),
  ('map_doorways', 'geom', 'LINESTRING', -1, 0, 0),
  ('map_rooms', 'geom', 'POLYGON', -1, 0, 0),
  ('map_routes', 'geom', 'LINESTRING', -1, 0, 0),
  ('map_spaces', 'geom', 'POLYGON', -1, 0, 0);

CREATE TABLE measures (
  measure TEXT PRIMARY KEY
    CONSTRAINT "a measure is a name of small letters, digits and _" CHECK (measure GLOB '[a-z]*' AND NOT measure GLOB '*[^a-z0-9_]*')
    CONSTRAINT "a measure must not be called as another property of rooms or doors"
      CHECK (measure NOT IN ('hardness', 'action', 'passable', 'measures')),
  unit    TEXT NOT NULL DEFAULT ''
) STRICT, WITHOUT ROWID;
INSERT INTO measures VALUES
  ('joules', 'J'),
  ('seconds', 's');
CREATE TRIGGER stale_measures_insert AFTER INSERT ON measures WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('measures', NEW.measure);
END;
CREATE TRIGGER stale_measures_update AFTER UPDATE ON measures WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('measures', NEW.measure);
END;
CREATE TRIGGER stale_measures_delete AFTER DELETE ON measures WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('measures', OLD.measure);
END;

CREATE TABLE laid (
  name       TEXT PRIMARY KEY CONSTRAINT "name must not be empty" CHECK (length(name) > 0),
  what       TEXT NOT NULL CONSTRAINT "what must be area, obstacle, place, bridge or door"
             CHECK (what IN ('area', 'obstacle', 'place', 'bridge', 'door')),
  kind       TEXT CONSTRAINT "only an area or a door has a kind" CHECK (kind IS NULL OR what IN ('area', 'door')),
  outline    TEXT NOT NULL CONSTRAINT "outline must be a JSON list of corners" CHECK (json_valid(outline)),
  properties TEXT NOT NULL DEFAULT '{}'
             CONSTRAINT "properties must be a JSON object" CHECK (json_valid(properties) AND json_type(properties) = 'object'),
  until      TEXT CONSTRAINT "until must be a time in UTC, like 2026-11-21T18:00:00Z"
             CHECK (strftime('%Y-%m-%dT%H:%M:%SZ', until) IS until),
  who        TEXT NOT NULL DEFAULT '',
  why        TEXT NOT NULL DEFAULT '',
  at         TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now')),
  CONSTRAINT "a place has one corner" CHECK (what <> 'place' OR json_array_length(outline) = 1),
  CONSTRAINT "a door has two posts" CHECK (what <> 'door' OR json_array_length(outline) = 2)
) STRICT;
CREATE TRIGGER stale_laid_insert AFTER INSERT ON laid WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('laid', NEW.name);
END;
CREATE TRIGGER stale_laid_update AFTER UPDATE ON laid WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('laid', NEW.name);
END;
CREATE TRIGGER stale_laid_delete AFTER DELETE ON laid WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('laid', OLD.name);
END;
CREATE TRIGGER drawn_follows_insert AFTER INSERT ON laid
WHEN NEW.what NOT IN ('place', 'door') AND NOT EXISTS (SELECT 1 FROM drawn WHERE name = NEW.name)
  AND NOT EXISTS (SELECT 1 FROM drawn AS d WHERE d.name IS NULL AND NEW.name = NEW.what || ' ' || d.fid) BEGIN
  INSERT INTO drawn (geom, name, what, kind, properties, until, why)
  SELECT geom, NEW.name, NEW.what, NEW.kind, NEW.properties, NEW.until, NEW.why FROM laid_shapes WHERE name = NEW.name;
END;
CREATE TRIGGER drawn_follows_update AFTER UPDATE ON laid
WHEN (NEW.name, NEW.what, NEW.kind, NEW.outline, NEW.properties, NEW.until, NEW.why)
  IS NOT (OLD.name, OLD.what, OLD.kind, OLD.outline, OLD.properties, OLD.until, OLD.why) BEGIN
  UPDATE drawn SET geom = (SELECT geom FROM laid_shapes WHERE name = NEW.name), name = NEW.name, what = NEW.what,
    kind = NEW.kind, properties = NEW.properties, until = NEW.until, why = NEW.why
  WHERE name IN (OLD.name, NEW.name);
END;
CREATE TRIGGER drawn_follows_delete AFTER DELETE ON laid BEGIN
  DELETE FROM drawn WHERE name = OLD.name;
END;

CREATE VIEW staleness AS
SELECT EXISTS (SELECT 1 FROM stale_marks)
    OR EXISTS (SELECT 1 FROM site WHERE key = 'valid_until' AND value <= strftime('%Y-%m-%dT%H:%M:%SZ', 'now'))
    OR EXISTS (SELECT 1 FROM site WHERE key = 'valid_from' AND value > strftime('%Y-%m-%dT%H:%M:%SZ', 'now'))
  AS stale;

CREATE VIEW conclusions AS
SELECT c.class || '.' || c.key AS object, c.property AS property, c.value AS value, u.name AS rule,
       u.version AS version, w.facts AS witness, c.class AS class, c.key AS key, u.file AS file, u.line AS line
FROM (
  SELECT 'prime_areas' AS class, area AS key, 'open' AS property, open AS value, open_rule AS rule, open_witness AS witness
    FROM prime_area_strips WHERE open_rule IS NOT NULL
  UNION ALL SELECT 'rooms', room, 'hardness', hardness, hardness_rule, hardness_witness
    FROM rooms WHERE hardness_rule IS NOT NULL
  UNION ALL SELECT 'rooms', room, 'action', action, action_rule, action_witness
    FROM rooms WHERE action_rule IS NOT NULL
  UNION ALL SELECT 'rooms', room, 'passable', passable, passable_rule, passable_witness
    FROM rooms WHERE passable_rule IS NOT NULL
  UNION ALL SELECT 'doors', door, 'hardness', hardness, hardness_rule, hardness_witness
    FROM doors WHERE hardness_rule IS NOT NULL
  UNION ALL SELECT 'doors', door, 'action', action, action_rule, action_witness
    FROM doors WHERE action_rule IS NOT NULL
  UNION ALL SELECT 'doors', door, 'passable', passable, passable_rule, passable_witness
    FROM doors WHERE passable_rule IS NOT NULL
  UNION ALL SELECT class, key, property, value, rule, witness FROM derivations
) AS c
LEFT JOIN rules AS u ON u.rule = c.rule
LEFT JOIN witnesses AS w ON w.witness = c.witness;

CREATE VIEW facts_told AS
SELECT t.id AS id, t.class AS class, coalesce(t.key, t.x || ',' || t.y) AS object, t.property AS property,
       CASE t.kind WHEN 'truth' THEN iif(t.value, 'true', 'false') ELSE t.value END AS value,
       t.until AS until, s.state AS state,
       (SELECT json_group_array(a.key) FROM attachments AS a WHERE a.told = t.id) AS objects,
       t.who AS who, t.why AS why, t.at AS at
FROM told AS t LEFT JOIN told_states AS s ON s.told = t.id;

CREATE VIEW opening_hours AS
SELECT name, days, opens, closes, 'site.toml' AS source FROM site_hours
UNION ALL SELECT name, days, opens, closes, 'hours' FROM hours;

CREATE VIEW cells_in_force AS
SELECT c.table_name AS table_name, c.key AS key, c.column_name AS column_name, c.value AS value, c.tuning AS tuning
FROM active_tunings AS a JOIN tuning_cells AS c ON c.tuning = a.tuning;

CREATE VIEW loads_in_force AS
SELECT l.robot AS robot, l.load AS load,
  coalesce((SELECT value FROM cells_in_force WHERE table_name = 'loads' AND key = l.robot || '/' || l.load
            AND column_name = 'height'), l.height) AS height,
  coalesce((SELECT value FROM cells_in_force WHERE table_name = 'loads' AND key = l.robot || '/' || l.load
            AND column_name = 'width'), l.width) AS width,
  coalesce((SELECT value FROM cells_in_force WHERE table_name = 'loads' AND key = l.robot || '/' || l.load
            AND column_name = 'carried'), l.carried) AS carried
FROM loads AS l;

CREATE VIEW prime_areas AS
SELECT a.area AS area,
  substr(hex(zeroblob(a.x_first)), 1, a.x_first)
    || substr(replace(hex(zeroblob(a.x_last - a.x_first + 1)), '0', '1'), 1, a.x_last - a.x_first + 1)
    || substr(hex(zeroblob(x.strips)), 1, x.strips - a.x_last - 1) AS left_string,
  substr(hex(zeroblob(a.y_first)), 1, a.y_first)
    || substr(replace(hex(zeroblob(a.y_last - a.y_first + 1)), '0', '1'), 1, a.y_last - a.y_first + 1)
    || substr(hex(zeroblob(y.strips)), 1, y.strips - a.y_last - 1) AS right_string,
  x0.low AS x0, y0.low AS y0, x1.high AS x1, y1.high AS y1,
  a.open AS open
FROM (SELECT count(strip) AS strips FROM strips WHERE axis = 'x') AS x
CROSS JOIN (SELECT count(strip) AS strips FROM strips WHERE axis = 'y') AS y
CROSS JOIN prime_area_strips AS a
LEFT JOIN strips AS x0 ON x0.axis = 'x' AND x0.strip = a.x_first
LEFT JOIN strips AS y0 ON y0.axis = 'y' AND y0.strip = a.y_first
LEFT JOIN strips AS x1 ON x1.axis = 'x' AND x1.strip = a.x_last
LEFT JOIN strips AS y1 ON y1.axis = 'y' AND y1.strip = a.y_last;

CREATE VIEW routes AS
SELECT s.robot AS robot, s.name AS start, r.room AS room, t.reach + coalesce(d.hardness, 0.0) AS cost,
       t.door AS from_door, coalesce(t.from_room, t.prev) AS from_room, r.name AS room_name, t.hops AS hops
FROM starts AS s
CROSS JOIN rooms AS r
CROSS JOIN ends AS e
LEFT JOIN tree_rows AS t ON t.tree = s.tree AND t.node = r.room
LEFT JOIN doors AS d ON d.door = t.door
WHERE e.name = r.name AND e.kept = 1 AND (r.robot IS NULL OR r.robot = s.robot);

CREATE VIEW map_rooms AS
SELECT r.room AS fid, r.name, r.robot, r.state, r.facing, r.height, r.width, r.space, r.hardness, r.action, r.passable,
  CAST(x'47500001FFFFFFFF0103000000' || (SELECT data FROM octets WHERE octet = json_array_length(r.rings) & 255)
      || (SELECT data FROM octets WHERE octet = json_array_length(r.rings) >> 8 & 255) || x'0000' || (
    SELECT group_concat(
      (SELECT data FROM octets WHERE octet = (json_array_length(ring.value) + 1) & 255)
      || (SELECT data FROM octets WHERE octet = (json_array_length(ring.value) + 1) >> 8 & 255) || x'0000'
      || (
        SELECT group_concat(o.data, '')
        FROM (SELECT coalesce(
            ((v.atom < 0) << 63)
            | (((SELECT octet FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1) + 895) << 52)
            | CAST(abs(v.atom) / (SELECT power FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1)
                * 4503599627370496.0 AS INTEGER) - 4503599627370496, 0) AS bits
              FROM json_tree(json_insert(ring.value, '$[#]', json_extract(ring.value, '$[0]'))) AS v WHERE v.atom IS NOT NULL LIMIT -1) AS n
        CROSS JOIN octets AS i
        CROSS JOIN octets AS o
        WHERE i.octet < 8 AND o.octet = n.bits >> 8 * i.octet & 255), '')
    FROM json_each(r.rings) AS ring) AS BLOB) AS geom
FROM (SELECT *, coalesce('[' || outline || ']', printf('[[[%!.17g,%!.17g],[%!.17g,%!.17g],[%!.17g,%!.17g],[%!.17g,%!.17g]]]',
    x0, y0, x1, y0, x1, y1, x0, y1)) AS rings FROM rooms) AS r;

CREATE VIEW map_spaces AS
SELECT s.space AS fid, coalesce(s.name, 'space ' || s.space) AS name, s.kind, s.area, s.breadth, s.closed,
  CAST(x'47500001FFFFFFFF0103000000' || (SELECT data FROM octets WHERE octet = json_array_length(s.outline) & 255)
      || (SELECT data FROM octets WHERE octet = json_array_length(s.outline) >> 8 & 255) || x'0000' || (
    SELECT group_concat(
      (SELECT data FROM octets WHERE octet = (json_array_length(ring.value) + 1) & 255)
      || (SELECT data FROM octets WHERE octet = (json_array_length(ring.value) + 1) >> 8 & 255) || x'0000'
      || (
        SELECT group_concat(o.data, '')
        FROM (SELECT coalesce(
            ((v.atom < 0) << 63)
            | (((SELECT octet FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1) + 895) << 52)
            | CAST(abs(v.atom) / (SELECT power FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1)
                * 4503599627370496.0 AS INTEGER) - 4503599627370496, 0) AS bits
              FROM json_tree(json_insert(ring.value, '$[#]', json_extract(ring.value, '$[0]'))) AS v WHERE v.atom IS NOT NULL LIMIT -1) AS n
        CROSS JOIN octets AS i
        CROSS JOIN octets AS o
        WHERE i.octet < 8 AND o.octet = n.bits >> 8 * i.octet & 255), '')
    FROM json_each(s.outline) AS ring) AS BLOB) AS geom
FROM spaces AS s;

CREATE VIEW map_areas AS
SELECT a.area AS name, a.kind,
  CAST(x'47500001FFFFFFFF0103000000' || (SELECT data FROM octets WHERE octet = json_array_length(a.rings) & 255)
      || (SELECT data FROM octets WHERE octet = json_array_length(a.rings) >> 8 & 255) || x'0000' || (
    SELECT group_concat(
      (SELECT data FROM octets WHERE octet = (json_array_length(ring.value) + 1) & 255)
      || (SELECT data FROM octets WHERE octet = (json_array_length(ring.value) + 1) >> 8 & 255) || x'0000'
      || (
        SELECT group_concat(o.data, '')
        FROM (SELECT coalesce(
            ((v.atom < 0) << 63)
            | (((SELECT octet FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1) + 895) << 52)
            | CAST(abs(v.atom) / (SELECT power FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1)
                * 4503599627370496.0 AS INTEGER) - 4503599627370496, 0) AS bits
              FROM json_tree(json_insert(ring.value, '$[#]', json_extract(ring.value, '$[0]'))) AS v WHERE v.atom IS NOT NULL LIMIT -1) AS n
        CROSS JOIN octets AS i
        CROSS JOIN octets AS o
        WHERE i.octet < 8 AND o.octet = n.bits >> 8 * i.octet & 255), '')
    FROM json_each(a.rings) AS ring) AS BLOB) AS geom
FROM (SELECT area, kind, '[' || outline || ']' AS rings FROM area_outlines) AS a;

CREATE VIEW laid_shapes AS
SELECT l.name,
  CAST(x'47500001FFFFFFFF0103000000' || (SELECT data FROM octets WHERE octet = json_array_length(l.rings) & 255)
      || (SELECT data FROM octets WHERE octet = json_array_length(l.rings) >> 8 & 255) || x'0000' || (
    SELECT group_concat(
      (SELECT data FROM octets WHERE octet = (json_array_length(ring.value) + 1) & 255)
      || (SELECT data FROM octets WHERE octet = (json_array_length(ring.value) + 1) >> 8 & 255) || x'0000'
      || (
        SELECT group_concat(o.data, '')
        FROM (SELECT coalesce(
            ((v.atom < 0) << 63)
            | (((SELECT octet FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1) + 895) << 52)
            | CAST(abs(v.atom) / (SELECT power FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1)
                * 4503599627370496.0 AS INTEGER) - 4503599627370496, 0) AS bits
              FROM json_tree(json_insert(ring.value, '$[#]', json_extract(ring.value, '$[0]'))) AS v WHERE v.atom IS NOT NULL LIMIT -1) AS n
        CROSS JOIN octets AS i
        CROSS JOIN octets AS o
        WHERE i.octet < 8 AND o.octet = n.bits >> 8 * i.octet & 255), '')
    FROM json_each(l.rings) AS ring) AS BLOB) AS geom
FROM (SELECT name, '[' || outline || ']' AS rings FROM laid) AS l;

CREATE VIEW drawn_outlines AS
SELECT w.fid, CASE WHEN substr(w.geom, 1, 2) = x'4750' AND substr(w.geom, w.at, 9) = x'010300000001000000'
    AND w.corners > 3 AND length(w.geom) = w.at + 12 + 16 * w.corners THEN (
  SELECT CASE WHEN count(c.number) = 2 * w.corners - 2 THEN '[' || group_concat(
    CASE WHEN c.place % 2 = 0 THEN '[' ELSE '' END || c.number || CASE WHEN c.place % 2 = 0 THEN '' ELSE ']' END) || ']' END
  FROM (
    SELECT b.place, CASE WHEN CAST(printf('%!.15g', b.value) AS REAL) = b.value
      THEN printf('%!.15g', b.value) ELSE printf('%!.17g', b.value) END AS number
    FROM (
      SELECT n.place, CASE WHEN n.bits & 9223372036854775807 = 0 THEN 0.0 ELSE
        CASE WHEN n.bits < 0 THEN -1.0 ELSE 1.0 END * (1.0 + (n.bits & 4503599627370495) / 4503599627370496.0)
        * (SELECT power FROM octets WHERE octet = (n.bits >> 52 & 2047) - 895) END AS value
      FROM (
        SELECT 256 * p.octet + q.octet AS place, (
          SELECT sum(o.octet << 8 * i.octet) FROM octets AS i CROSS JOIN octets AS o
          WHERE i.octet < 8 AND o.data = substr(w.geom, w.at + 13 + 8 * (256 * p.octet + q.octet) + i.octet, 1)) AS bits
        FROM octets AS p CROSS JOIN octets AS q
        WHERE p.octet <= (2 * w.corners - 3) / 256 AND 256 * p.octet + q.octet < 2 * w.corners - 2 LIMIT -1) AS n
      LIMIT -1) AS b
    LIMIT -1) AS c) END AS outline
FROM (
  SELECT g.fid, g.geom, g.at, (
    SELECT sum(o.octet << 8 * i.octet) FROM octets AS i CROSS JOIN octets AS o
    WHERE i.octet < 4 AND o.data = substr(g.geom, g.at + 9 + i.octet, 1)) AS corners
  FROM (
    SELECT fid, geom, 9 + CASE (SELECT octet FROM octets WHERE data = substr(geom, 4, 1)) >> 1 & 7
      WHEN 0 THEN 0 WHEN 1 THEN 32 WHEN 2 THEN 48 WHEN 3 THEN 48 WHEN 4 THEN 64 END AS at
    FROM drawn) AS g) AS w;

CREATE VIEW robots_in_force AS
SELECT r.robot AS robot, r.state AS state,
  coalesce((SELECT value FROM cells_in_force WHERE table_name = 'robots' AND key = r.robot || '/' || r.state
            AND column_name = 'action'), r.action) AS action,
  coalesce((SELECT value FROM cells_in_force WHERE table_name = 'robots' AND key = r.robot || '/' || r.state
            AND column_name = 'height'), r.height) AS height,
  coalesce((SELECT value FROM cells_in_force WHERE table_name = 'robots' AND key = r.robot || '/' || r.state
            AND column_name = 'width'), r.width) AS width,
  coalesce((SELECT value FROM cells_in_force WHERE table_name = 'robots' AND key = r.robot || '/' || r.state
            AND column_name = 'length'), r.length) AS length,
  coalesce((SELECT value FROM cells_in_force WHERE table_name = 'robots' AND key = r.robot || '/' || r.state
            AND column_name = 'hardness'), r.hardness) AS hardness,
  coalesce((SELECT value FROM cells_in_force WHERE table_name = 'robots' AND key = r.robot || '/' || r.state
            AND column_name = 'position'), r.position) AS position,
  coalesce((SELECT value FROM cells_in_force WHERE table_name = 'robots' AND key = r.robot || '/' || r.state
            AND column_name = 'speed'), r.speed) AS speed,
  coalesce((SELECT value FROM cells_in_force WHERE table_name = 'robots' AND key = r.robot || '/' || r.state
            AND column_name = 'power'), r.power) AS power
FROM robots AS r;

CREATE VIEW changes_in_force AS
SELECT c.robot AS robot, c.from_state AS from_state, c.to_state AS to_state,
  coalesce((SELECT value FROM cells_in_force WHERE table_name = 'changes'
            AND key = c.robot || '/' || c.from_state || '/' || c.to_state AND column_name = 'hardness'),
           c.hardness) AS hardness,
  coalesce((SELECT value FROM cells_in_force WHERE table_name = 'changes'
            AND key = c.robot || '/' || c.from_state || '/' || c.to_state AND column_name = 'seconds'),
           c.seconds) AS seconds,
  coalesce((SELECT value FROM cells_in_force WHERE table_name = 'changes'
            AND key = c.robot || '/' || c.from_state || '/' || c.to_state AND column_name = 'joules'),
           c.joules) AS joules
FROM changes AS c;

CREATE VIEW tree_measures AS
SELECT g.tree AS tree, g.node AS node, (
  WITH RECURSIVE walk (node, prev, door, room, walked) AS (
    SELECT g.node, g.prev, g.door, coalesce(g.from_room, g.prev, g.node), CASE WHEN g.prev IS NULL THEN 0.0 ELSE g.walked END
    UNION ALL
    SELECT b.node, b.prev, b.door, coalesce(b.from_room, b.prev, b.node), CASE WHEN b.prev IS NULL THEN 0.0 ELSE b.walked END
    FROM walk CROSS JOIN tree_rows AS b
    WHERE b.tree = g.tree AND b.node = walk.prev),
  parts (measures, metres) AS (
    SELECT r.measures, walk.walked
    FROM walk CROSS JOIN rooms AS r
    WHERE r.room = walk.room AND (walk.node = g.node OR walk.door IS NOT NULL OR walk.prev IS NULL)
    UNION ALL
    SELECT d.measures, 1.0 FROM walk CROSS JOIN doors AS d WHERE d.door = walk.door)
  SELECT CASE WHEN count(key) > 0 THEN json_group_object(key, total) END
  FROM (SELECT key, sum(amount) AS total
        FROM (SELECT e.key AS key, CASE WHEN CAST(e.value AS DOUBLE) = 0.0 THEN 0.0 ELSE CAST(e.value AS DOUBLE) * parts.metres END AS amount
              FROM parts CROSS JOIN json_each(parts.measures) AS e)
        GROUP BY key
        -- of each door one room and the door, of the start its room, and the last room where no door ends the way
        HAVING count(amount) = 1 + 2 * g.hops + CASE WHEN g.door IS NULL AND g.prev IS NOT NULL THEN 1 ELSE 0 END)) AS measures
FROM tree_rows AS g;

CREATE VIEW kept_routes AS
SELECT b.robot AS robot, a.name AS start, e.name AS goal,
  CASE WHEN s.tree IS NULL OR e.kept = 0 THEN 'not_kept'
       WHEN (SELECT stale FROM staleness) THEN 'stale'
       WHEN t.hops IS NULL THEN 'no_route'
       WHEN t.hops = 0 THEN 'same_room'
       ELSE 'ok' END AS status,
  t.reach + coalesce(d.hardness, 0.0) AS cost,
  2 * t.hops + 1 AS steps,
  t.distance AS distance,
  NULL AS reason,
  coalesce((SELECT m.measures FROM tree_measures AS m WHERE m.tree = s.tree AND m.node = t.node), NULL) AS measures
FROM (SELECT DISTINCT robot FROM robots) AS b
CROSS JOIN ends AS a
CROSS JOIN ends AS e
LEFT JOIN starts AS s ON s.name = a.name AND s.robot = b.robot
LEFT JOIN tree_rows AS t ON t.tree = s.tree AND t.node = e.node
LEFT JOIN doors AS d ON d.door = t.door
UNION ALL
SELECT robot, start, goal, CASE WHEN (SELECT stale FROM staleness) THEN 'stale' ELSE status END, +cost, +steps,
  distance, coalesce(reason, NULL), coalesce(measures, NULL)
FROM courses;

CREATE VIEW kept_steps AS
SELECT s.robot AS robot, s.name AS start, e.name AS goal,
  2 * t.hops - 1 + p.part AS step,
  CASE WHEN p.part = 1 THEN d.kind ELSE 'room' END AS kind,
  CASE WHEN p.part = 1 THEN CAST(t.door AS TEXT) ELSE r.name END AS place,
  CASE WHEN p.part = 1 AND d.kind = 'change'
    THEN (SELECT n.state FROM rooms AS n
          WHERE n.room = CASE d.room1 WHEN coalesce(t.from_room, t.prev) THEN d.room2 ELSE d.room1 END)
    ELSE r.state END AS state,
  CASE WHEN p.part = 1 THEN d.action ELSE r.action END AS action,
  CASE WHEN p.part = 1 THEN d.hardness WHEN p.part = 2 AND t.door IS NOT NULL THEN 0.0 ELSE t.leg END AS hardness,
  CASE WHEN p.part > 0 THEN t.reach + coalesce(d.hardness, 0.0) ELSE t.reach END AS cost,
  coalesce(t.x, d.x) AS x,
  coalesce(t.y, d.y) AS y,
  CASE WHEN p.part = 2 AND t.door IS NOT NULL THEN NULL ELSE t.heading / 100.0 END AS heading,
  u.name AS rule,
  CASE WHEN p.part <> 1
    THEN (SELECT coalesce(s.name, 'space ' || s.space) FROM spaces AS s WHERE s.space = r.space) END AS space,
  CASE WHEN p.part = 1 AND d.kind = 'door'
    THEN (SELECT name
          FROM (SELECT coalesce(w.name, 'doorway ' || w.doorway) AS name, w.doorway AS doorway,
                  (w.x - d.x) * (w.x - d.x) + (w.y - d.y) * (w.y - d.y) AS off
                FROM rooms AS a JOIN rooms AS b ON b.room = d.room2
                JOIN doorways AS w ON w.space1 = CASE WHEN a.space < b.space THEN a.space ELSE b.space END
                  AND w.space2 = CASE WHEN a.space < b.space THEN b.space ELSE a.space END
                WHERE a.room = d.room1 AND a.space <> b.space)
          ORDER BY off, doorway LIMIT 1) END AS doorway,
  NULL AS z,
  CASE WHEN p.part = 1 THEN CAST(json_extract(d.measures, '$.seconds') AS DOUBLE)
    WHEN CAST(json_extract(r.measures, '$.seconds') AS DOUBLE) = 0.0 OR p.part = 2 AND t.door IS NOT NULL
    THEN 0.0 * CAST(json_extract(r.measures, '$.seconds') AS DOUBLE)
    ELSE t.walked * CAST(json_extract(r.measures, '$.seconds') AS DOUBLE) END AS seconds,
  CASE WHEN p.part = 1 THEN CAST(json_extract(d.measures, '$.joules') AS DOUBLE)
    WHEN CAST(json_extract(r.measures, '$.joules') AS DOUBLE) = 0.0 OR p.part = 2 AND t.door IS NOT NULL
    THEN 0.0 * CAST(json_extract(r.measures, '$.joules') AS DOUBLE)
    ELSE t.walked * CAST(json_extract(r.measures, '$.joules') AS DOUBLE) END AS joules,
  (SELECT CASE WHEN count(key) > 0 THEN json_group_object(key, amount) END
   FROM (SELECT e.key AS key,
           CASE WHEN p.part = 1 THEN CAST(e.value AS DOUBLE) WHEN CAST(e.value AS DOUBLE) = 0.0 OR p.part = 2 AND t.door IS NOT NULL THEN 0.0
             ELSE t.walked * CAST(e.value AS DOUBLE) END AS amount
         FROM json_each(CASE p.part WHEN 1 THEN d.measures ELSE r.measures END) AS e)
   WHERE amount IS NOT NULL) AS measures
FROM starts AS s
CROSS JOIN ends AS e
CROSS JOIN tree_rows AS g
CROSS JOIN json_each((
  WITH RECURSIVE walk (node, prev) AS (
    SELECT g.node, g.prev
    UNION ALL
    SELECT b.node, b.prev FROM walk JOIN tree_rows AS b ON b.tree = g.tree AND b.node = walk.prev)
  SELECT json_group_array(node) FROM walk)) AS j
CROSS JOIN tree_rows AS t
LEFT JOIN doors AS d ON d.door = t.door
CROSS JOIN step_parts AS p
LEFT JOIN rooms AS r ON r.room =
  CASE WHEN p.part = 2 AND e.node > 0 THEN e.node ELSE coalesce(t.from_room, t.prev) END
LEFT JOIN rules AS u ON u.rule = CASE WHEN p.part = 1 THEN d.hardness_rule ELSE r.action_rule END
WHERE g.tree = s.tree AND g.node = e.node AND t.tree = s.tree AND t.node = j.value
  AND p.part BETWEEN CASE WHEN t.door IS NULL THEN 2 ELSE 0 END AND CASE WHEN t.node = e.node THEN 2 ELSE 1 END
UNION ALL
SELECT robot, start, goal, +step, coalesce(kind, NULL), coalesce(place, NULL), coalesce(state, NULL), coalesce(action, NULL), +hardness, +cost, +x, +y, +heading, rule, NULL, NULL, +z,
  +CAST(json_extract(measures, '$.seconds') AS DOUBLE), +CAST(json_extract(measures, '$.joules') AS DOUBLE), coalesce(measures, NULL)
FROM course_steps;

CREATE VIEW kept_waypoints AS
SELECT s.robot AS robot, s.name AS start, e.name AS goal,
  CAST(j.key AS INTEGER) + 1 AS waypoint,
  coalesce(t.x, d.x) AS x,
  coalesce(t.y, d.y) AS y,
  t.heading / 100.0 AS heading,
  r.state AS state,
  r.action AS action,
  r.facing AS facing,
  t.clearance AS clearance,
  t.distance AS distance,
  t.reach + coalesce(d.hardness, 0.0) AS cost,
  NULL AS z, NULL AS centre_x, NULL AS centre_y, NULL AS turn,
  coalesce((SELECT m.measures FROM tree_measures AS m WHERE m.tree = s.tree AND m.node = t.node), NULL) AS measures
FROM starts AS s
CROSS JOIN ends AS e
CROSS JOIN tree_rows AS g
CROSS JOIN json_each((
  WITH RECURSIVE walk (node, prev, bend, stops, depth) AS (
    SELECT g.node, g.prev, g.bend, 1, 0
    UNION ALL
    SELECT b.node, b.prev, b.bend, CASE WHEN walk.bend = 1 OR b.prev IS NULL THEN 1 ELSE 0 END, walk.depth + 1
    FROM walk JOIN tree_rows AS b ON b.tree = g.tree AND b.node = walk.prev)
  SELECT json_group_array(node) FROM (SELECT node FROM walk WHERE stops = 1 ORDER BY depth DESC))) AS j
CROSS JOIN tree_rows AS t
LEFT JOIN doors AS d ON d.door = t.door
LEFT JOIN rooms AS r ON r.room = coalesce(t.from_room, t.prev, t.node)
WHERE g.tree = s.tree AND g.node = e.node AND t.tree = s.tree AND t.node = j.value
UNION ALL
SELECT robot, start, goal, +waypoint, +x, +y, +heading, state, action, CAST(NULL AS REAL), clearance, distance, +cost, +z,
  +centre_x, +centre_y, coalesce(turn, NULL), coalesce(measures, NULL)
FROM course_waypoints;

CREATE VIEW measured_routes AS
SELECT *, CAST(json_extract(measures, '$.seconds') AS DOUBLE) AS seconds, CAST(json_extract(measures, '$.joules') AS DOUBLE) AS joules
FROM kept_routes;

CREATE VIEW measured_waypoints AS
SELECT *, CAST(json_extract(measures, '$.seconds') AS DOUBLE) AS seconds, CAST(json_extract(measures, '$.joules') AS DOUBLE) AS joules
FROM kept_waypoints;

CREATE VIEW route AS
SELECT robot, start, goal, status, cost, steps, distance, reason, seconds, joules, measures
FROM measured_routes;

CREATE VIEW action_sequence AS
SELECT robot, start, goal, step, kind, place, state, action, hardness, cost, x, y, heading, rule, space, doorway, z, seconds, joules, measures
FROM kept_steps;

CREATE VIEW waypoints AS
SELECT robot, start, goal, waypoint, x, y, heading, state, action, facing, clearance, distance, cost, z, centre_x, centre_y, turn, seconds, joules, measures
FROM measured_waypoints;

CREATE VIEW map_doorways AS
SELECT d.doorway AS fid, coalesce(d.name, 'doorway ' || d.doorway) AS name, d.space1, d.space2, d.width, d.height, d.closed, d.closed_from,
  CAST(x'47500001FFFFFFFF0102000000'
      || x'02000000'
      || (
      SELECT group_concat(o.data, '')
      FROM (SELECT coalesce(
          ((v.atom < 0) << 63)
          | (((SELECT octet FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1) + 895) << 52)
          | CAST(abs(v.atom) / (SELECT power FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1)
              * 4503599627370496.0 AS INTEGER) - 4503599627370496, 0) AS bits
            FROM json_tree(printf('[%!.17g,%!.17g,%!.17g,%!.17g]', d.x0, d.y0, d.x1, d.y1)) AS v WHERE v.atom IS NOT NULL LIMIT -1) AS n
      CROSS JOIN octets AS i
      CROSS JOIN octets AS o
      WHERE i.octet < 8 AND o.octet = n.bits >> 8 * i.octet & 255) AS BLOB) AS geom
FROM doorways AS d;

CREATE VIEW map_routes AS
SELECT r.robot, r.start, r.goal, r.status, r.cost, r.distance,
  CAST(x'47500001FFFFFFFF0102000000'
      || (SELECT data FROM octets WHERE octet = (json_array_length(r.points) / 2) & 255)
      || (SELECT data FROM octets WHERE octet = (json_array_length(r.points) / 2) >> 8 & 255) || x'0000'
      || (
      SELECT group_concat(o.data, '')
      FROM (SELECT coalesce(
          ((v.atom < 0) << 63)
          | (((SELECT octet FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1) + 895) << 52)
          | CAST(abs(v.atom) / (SELECT power FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1)
              * 4503599627370496.0 AS INTEGER) - 4503599627370496, 0) AS bits
            FROM json_tree(r.points) AS v WHERE v.atom IS NOT NULL LIMIT -1) AS n
      CROSS JOIN octets AS i
      CROSS JOIN octets AS o
      WHERE i.octet < 8 AND o.octet = n.bits >> 8 * i.octet & 255) AS BLOB) AS geom
FROM (SELECT robot, start, goal, status, cost, distance, '[' || coalesce((
    SELECT group_concat(printf('%!.17g,%!.17g', x, y))
    FROM (SELECT coalesce(t.x, d.x) AS x, coalesce(t.y, d.y) AS y
          FROM starts AS s
          CROSS JOIN ends AS e
          CROSS JOIN tree_rows AS g
          CROSS JOIN json_each((
            WITH RECURSIVE walk (node, prev, bend, stops, depth) AS (
              SELECT g.node, g.prev, g.bend, 1, 0
              UNION ALL
              SELECT b.node, b.prev, b.bend, CASE WHEN walk.bend = 1 OR b.prev IS NULL THEN 1 ELSE 0 END, walk.depth + 1
              FROM walk JOIN tree_rows AS b ON b.tree = g.tree AND b.node = walk.prev)
            SELECT json_group_array(node) FROM (SELECT node FROM walk WHERE stops = 1 ORDER BY depth DESC))) AS j
          CROSS JOIN tree_rows AS t
          LEFT JOIN doors AS d ON d.door = t.door
          WHERE s.robot = route.robot AND s.name = route.start AND e.name = route.goal
            AND g.tree = s.tree AND g.node = e.node AND t.tree = s.tree AND t.node = j.value
          ORDER BY CAST(j.key AS INTEGER))), (
    SELECT group_concat(printf('%!.17g,%!.17g', x, y))
    FROM (SELECT w.x AS x, w.y AS y FROM course_waypoints AS w
          WHERE w.robot = route.robot AND w.start = route.start AND w.goal = route.goal ORDER BY w.waypoint))) || ']' AS points
  FROM route WHERE status IN ('ok', 'same_room', 'stale') AND start IN (SELECT name FROM starts UNION SELECT start FROM courses) LIMIT -1) AS r
WHERE json_array_length(r.points) > 2;

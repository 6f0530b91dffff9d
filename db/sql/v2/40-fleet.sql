-- A body that is longer than wide and cannot turn everywhere; what robots carry.

-- Along the facing; NULL: the state is a disc of its width, and faces nowhere.
ALTER TABLE robots ADD COLUMN length REAL CONSTRAINT "length must be finite and more than 0" CHECK (length > 0 AND length <= 1e300);

-- Degrees counterclockwise from x, for a room of a body that is longer than wide; half a turn shows it the same.
ALTER TABLE rooms ADD COLUMN facing REAL CONSTRAINT "facing must be from 0 to less than 180" CHECK (facing >= 0 AND facing < 180);

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

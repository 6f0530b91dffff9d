-- An edit that the store itself did not follow up leaves a mark here, and `route.status` says stale until a build takes
-- the marks away. The store's own bulk writes are quiet: `writer` is 1 inside their transaction only, so that nobody
-- else ever sees it so.
CREATE TABLE stale_marks (
  table_name TEXT NOT NULL,
  key        TEXT NOT NULL,
  PRIMARY KEY (table_name, key)
) STRICT, WITHOUT ROWID;

CREATE TABLE writer (
  only  INTEGER PRIMARY KEY CHECK (only = 1),
  quiet INTEGER NOT NULL CHECK (quiet IN (0, 1))
) STRICT;
INSERT INTO writer VALUES (1, 0);

CREATE TRIGGER stale_robots_insert AFTER INSERT ON robots WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('robots', NEW.robot || '/' || NEW.state);
END;
CREATE TRIGGER stale_robots_update AFTER UPDATE ON robots WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('robots', NEW.robot || '/' || NEW.state);
END;
CREATE TRIGGER stale_robots_delete AFTER DELETE ON robots WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('robots', OLD.robot || '/' || OLD.state);
END;
CREATE TRIGGER stale_changes_insert AFTER INSERT ON changes WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('changes', NEW.robot || '/' || NEW.from_state || '/' || NEW.to_state);
END;
CREATE TRIGGER stale_changes_update AFTER UPDATE ON changes WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('changes', NEW.robot || '/' || NEW.from_state || '/' || NEW.to_state);
END;
CREATE TRIGGER stale_changes_delete AFTER DELETE ON changes WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('changes', OLD.robot || '/' || OLD.from_state || '/' || OLD.to_state);
END;
CREATE TRIGGER stale_places_insert AFTER INSERT ON places WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('places', NEW.place);
END;
CREATE TRIGGER stale_places_update AFTER UPDATE ON places WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('places', NEW.place);
END;
CREATE TRIGGER stale_places_delete AFTER DELETE ON places WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('places', OLD.place);
END;
CREATE TRIGGER stale_rooms_insert AFTER INSERT ON rooms WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('rooms', NEW.room);
END;
CREATE TRIGGER stale_rooms_update AFTER UPDATE ON rooms WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('rooms', NEW.room);
END;
CREATE TRIGGER stale_rooms_delete AFTER DELETE ON rooms WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('rooms', OLD.room);
END;
CREATE TRIGGER stale_doors_insert AFTER INSERT ON doors WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('doors', NEW.door);
END;
CREATE TRIGGER stale_doors_update AFTER UPDATE ON doors WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('doors', NEW.door);
END;
CREATE TRIGGER stale_doors_delete AFTER DELETE ON doors WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('doors', OLD.door);
END;

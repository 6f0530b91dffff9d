-- Rows of rooms and doors once more, some thousand of them in one value, so that all of a site is read in milliseconds.
-- The rows are the truth: what is written to them goes into the blocks in the same transaction, and an edit of anybody
-- else takes the blocks of the table away.
--
-- part: cut (what planners gave) or weights (what rules say). at: how many rows stand before. first: the key of the
-- first row. bytes: the rows, column by column, behind a checksum.
CREATE TABLE blocks (
  class TEXT NOT NULL CHECK (class IN ('rooms', 'doors')),
  part  TEXT NOT NULL CHECK (part IN ('cut', 'weights')),
  at    INTEGER NOT NULL,
  first INTEGER NOT NULL,
  bytes BLOB NOT NULL,
  PRIMARY KEY (class, part, first)
) STRICT;

-- What was built before has no blocks: the next edit derives all of it, and writes them.
DELETE FROM site WHERE key = 'basis';

DROP TRIGGER stale_rooms_insert;
DROP TRIGGER stale_rooms_update;
DROP TRIGGER stale_rooms_delete;
DROP TRIGGER stale_doors_insert;
DROP TRIGGER stale_doors_update;
DROP TRIGGER stale_doors_delete;

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

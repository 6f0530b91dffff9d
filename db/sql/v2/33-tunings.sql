-- Sets of edits with a name, laid over the tables while they are switched on. The tables themselves stay.
CREATE TABLE tuning_cells (
  tuning      TEXT NOT NULL CONSTRAINT "tuning must not be empty" CHECK (length(tuning) > 0),
  table_name  TEXT NOT NULL,
  key         TEXT NOT NULL,
  column_name TEXT NOT NULL,
  value       ANY,
  PRIMARY KEY (tuning, table_name, key, column_name)
) STRICT, WITHOUT ROWID;

CREATE TABLE active_tunings (
  tuning TEXT PRIMARY KEY CONSTRAINT "tuning must not be empty" CHECK (length(tuning) > 0)
) STRICT, WITHOUT ROWID;

-- The cells that count instead of the tables' own.
CREATE VIEW cells_in_force AS
SELECT c.table_name AS table_name, c.key AS key, c.column_name AS column_name, c.value AS value, c.tuning AS tuning
FROM active_tunings AS a JOIN tuning_cells AS c ON c.tuning = a.tuning;

CREATE TRIGGER stale_tuning_cells_insert AFTER INSERT ON tuning_cells WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('tuning_cells', NEW.tuning);
END;
CREATE TRIGGER stale_tuning_cells_update AFTER UPDATE ON tuning_cells WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('tuning_cells', NEW.tuning);
END;
CREATE TRIGGER stale_tuning_cells_delete AFTER DELETE ON tuning_cells WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('tuning_cells', OLD.tuning);
END;
CREATE TRIGGER stale_active_tunings_insert AFTER INSERT ON active_tunings WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('active_tunings', NEW.tuning);
END;
CREATE TRIGGER stale_active_tunings_update AFTER UPDATE ON active_tunings WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('active_tunings', NEW.tuning);
END;
CREATE TRIGGER stale_active_tunings_delete AFTER DELETE ON active_tunings WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('active_tunings', OLD.tuning);
END;

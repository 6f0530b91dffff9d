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
            AND column_name = 'position'), r.position) AS position
FROM robots AS r;

CREATE VIEW changes_in_force AS
SELECT c.robot AS robot, c.from_state AS from_state, c.to_state AS to_state,
  coalesce((SELECT value FROM cells_in_force WHERE table_name = 'changes'
            AND key = c.robot || '/' || c.from_state || '/' || c.to_state AND column_name = 'hardness'),
           c.hardness) AS hardness
FROM changes AS c;

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

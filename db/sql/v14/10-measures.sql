-- What adds up along a route besides hardness: a measure is a property that rules conclude of rooms, by the metre, and of
-- doors, of passing. unit: in which it is said; s and J are said as people say times and energies.
CREATE TABLE measures (
  measure TEXT PRIMARY KEY
    CONSTRAINT "a measure is a name of small letters, digits and _" CHECK (measure GLOB '[a-z]*' AND NOT measure GLOB '*[^a-z0-9_]*')
    CONSTRAINT "a measure must not be called as another property of rooms or doors"
      CHECK (measure NOT IN ('hardness', 'action', 'passable', 'measures')),
  unit    TEXT NOT NULL DEFAULT ''
) STRICT, WITHOUT ROWID;
INSERT INTO measures VALUES ('seconds', 's'), ('joules', 'J');

CREATE TRIGGER stale_measures_insert AFTER INSERT ON measures WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('measures', NEW.measure);
END;
CREATE TRIGGER stale_measures_update AFTER UPDATE ON measures WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('measures', NEW.measure);
END;
CREATE TRIGGER stale_measures_delete AFTER DELETE ON measures WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('measures', OLD.measure);
END;

-- What rules say of measures, as JSON: {"joules":75.0,"seconds":1.25}. What they do not say is not in it; NULL: nothing.
ALTER TABLE rooms ADD COLUMN measures TEXT CONSTRAINT "measures must be a JSON object" CHECK (json_type(measures) = 'object');
ALTER TABLE doors ADD COLUMN measures TEXT CONSTRAINT "measures must be a JSON object" CHECK (json_type(measures) = 'object');

-- Metres a second, and watts while it moves so; NULL: not known.
ALTER TABLE robots ADD COLUMN speed REAL CONSTRAINT "speed must be finite and more than 0" CHECK (speed > 0 AND speed <= 1e300);
ALTER TABLE robots ADD COLUMN power REAL CONSTRAINT "power must be finite and not negative" CHECK (power BETWEEN 0 AND 1e300);
ALTER TABLE changes ADD COLUMN seconds REAL CONSTRAINT "seconds must be finite and not negative" CHECK (seconds BETWEEN 0 AND 1e300);
ALTER TABLE changes ADD COLUMN joules REAL CONSTRAINT "joules must be finite and not negative" CHECK (joules BETWEEN 0 AND 1e300);

DROP VIEW robots_in_force;
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

DROP VIEW changes_in_force;
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

-- What was weighed before says nothing of measures, nor do its blocks: all of it is made anew.
DELETE FROM site WHERE key = 'basis' OR key LIKE 'planner.%';
DELETE FROM blocks WHERE class IN ('rooms', 'doors');

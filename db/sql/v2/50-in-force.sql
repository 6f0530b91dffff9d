-- The tables of the robots as they count, with the named tunings that are on.
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

CREATE VIEW loads_in_force AS
SELECT l.robot AS robot, l.load AS load,
  coalesce((SELECT value FROM cells_in_force WHERE table_name = 'loads' AND key = l.robot || '/' || l.load
            AND column_name = 'height'), l.height) AS height,
  coalesce((SELECT value FROM cells_in_force WHERE table_name = 'loads' AND key = l.robot || '/' || l.load
            AND column_name = 'width'), l.width) AS width,
  coalesce((SELECT value FROM cells_in_force WHERE table_name = 'loads' AND key = l.robot || '/' || l.load
            AND column_name = 'carried'), l.carried) AS carried
FROM loads AS l;

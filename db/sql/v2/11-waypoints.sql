-- The points at which a route bends, changes shape, starts and ends. state and action are those in which the robot
-- comes there (at the start, in which it leaves), facing how a body longer than wide lies then, clearance is that of the straight way there.
CREATE VIEW waypoints AS
SELECT s.robot AS robot, s.name AS start, e.name AS goal,
  j.key + 1 AS waypoint,
  coalesce(t.x, d.x) AS x,
  coalesce(t.y, d.y) AS y,
  t.heading / 100.0 AS heading,
  r.state AS state,
  r.action AS action,
  r.facing AS facing,
  t.clearance AS clearance,
  t.distance AS distance,
  t.reach + coalesce(d.hardness, 0.0) AS cost
FROM starts AS s
CROSS JOIN ends AS e
CROSS JOIN tree_rows AS g ON g.tree = s.tree AND g.node = e.node
CROSS JOIN json_each((
  WITH RECURSIVE walk (node, prev, bend, stops, depth) AS (
    SELECT g.node, g.prev, g.bend, 1, 0
    UNION ALL
    SELECT b.node, b.prev, b.bend, walk.bend OR b.prev IS NULL, walk.depth + 1
    FROM walk JOIN tree_rows AS b ON b.tree = g.tree AND b.node = walk.prev)
  SELECT json_group_array(node) FROM (SELECT node FROM walk WHERE stops ORDER BY depth DESC))) AS j
CROSS JOIN tree_rows AS t ON t.tree = s.tree AND t.node = j.value
LEFT JOIN doors AS d ON d.door = t.door
LEFT JOIN rooms AS r ON r.room = coalesce(t.from_room, t.prev, t.node);

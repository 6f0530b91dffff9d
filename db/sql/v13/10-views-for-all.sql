-- The views of routes, and of prime areas, as DuckDB reads them, too, by the same plans as before: it takes no ON after CROSS
-- JOIN, no sign before a text (`coalesce(…, NULL)` keeps a column's affinity away as `+` did), and adds no truth values. What
-- it has no function for it hands to SQLite in words of its own, in which `count(*)` is not SQLite's.
DROP VIEW prime_areas;
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

DROP VIEW routes;
CREATE VIEW routes AS
SELECT s.robot AS robot, s.name AS start, r.room AS room, t.reach + coalesce(d.hardness, 0.0) AS cost,
       t.door AS from_door, coalesce(t.from_room, t.prev) AS from_room, r.name AS room_name, t.hops AS hops
FROM starts AS s
CROSS JOIN rooms AS r
CROSS JOIN ends AS e
LEFT JOIN tree_rows AS t ON t.tree = s.tree AND t.node = r.room
LEFT JOIN doors AS d ON d.door = t.door
WHERE e.name = r.name AND e.kept = 1 AND (r.robot IS NULL OR r.robot = s.robot);

DROP VIEW route;
CREATE VIEW route AS
SELECT b.robot AS robot, a.name AS start, e.name AS goal,
  CASE WHEN s.tree IS NULL OR e.kept = 0 THEN 'not_kept'
       WHEN (SELECT stale FROM staleness) THEN 'stale'
       WHEN t.hops IS NULL THEN 'no_route'
       WHEN t.hops = 0 THEN 'same_room'
       ELSE 'ok' END AS status,
  t.reach + coalesce(d.hardness, 0.0) AS cost,
  2 * t.hops + 1 AS steps,
  t.distance AS distance,
  NULL AS reason
FROM (SELECT DISTINCT robot FROM robots) AS b
CROSS JOIN ends AS a
CROSS JOIN ends AS e
LEFT JOIN starts AS s ON s.name = a.name AND s.robot = b.robot
LEFT JOIN tree_rows AS t ON t.tree = s.tree AND t.node = e.node
LEFT JOIN doors AS d ON d.door = t.door
UNION ALL
SELECT robot, start, goal, CASE WHEN (SELECT stale FROM staleness) THEN 'stale' ELSE status END, +cost, +steps,
  distance, coalesce(reason, NULL)
FROM courses;

DROP VIEW action_sequence;
CREATE VIEW action_sequence AS
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
  NULL AS z
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
SELECT robot, start, goal, +step, coalesce(kind, NULL), coalesce(place, NULL), coalesce(state, NULL), coalesce(action, NULL), +hardness, +cost, +x, +y, +heading, rule, NULL, NULL, +z
FROM course_steps;

DROP VIEW waypoints;
CREATE VIEW waypoints AS
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
  NULL AS z, NULL AS centre_x, NULL AS centre_y, NULL AS turn
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
  +centre_x, +centre_y, coalesce(turn, NULL)
FROM course_waypoints;

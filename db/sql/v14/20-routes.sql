-- What a route adds up besides hardness, in SQL.

-- walked: metres in the room since its door, of which leg is the hardness; NULL where ways are not measured.
ALTER TABLE tree_rows ADD COLUMN walked REAL;

-- measures: as of rooms; of a route what all of it takes, of a waypoint what the way there takes.
ALTER TABLE courses ADD COLUMN measures TEXT;
ALTER TABLE course_steps ADD COLUMN measures TEXT;
ALTER TABLE course_waypoints ADD COLUMN measures TEXT;

-- What the way from a tree's start to a node takes, by measure; none of which a room or a door on the way says nothing. The room
-- of the start counts without a metre, so that what is known there is 0 at the start.
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

-- SQLite asks each half of a view for just what a query wants only where both give a column the same affinity; `+`, or of a
-- text `coalesce(…, NULL)`, takes it from a column where the other half computes.
DROP VIEW route;
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

DROP VIEW action_sequence;
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

DROP VIEW waypoints;
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

-- The way there is walked once for all measures, and only where a query wants one of them.
CREATE VIEW measured_routes AS
SELECT *, CAST(json_extract(measures, '$.seconds') AS DOUBLE) AS seconds, CAST(json_extract(measures, '$.joules') AS DOUBLE) AS joules
FROM kept_routes;
CREATE VIEW measured_waypoints AS
SELECT *, CAST(json_extract(measures, '$.seconds') AS DOUBLE) AS seconds, CAST(json_extract(measures, '$.joules') AS DOUBLE) AS joules
FROM kept_waypoints;

-- DuckDB hands the text of a view that it cannot compute to SQLite in words of its own, of which SQLite takes no compound; it does
-- not look into a view behind it.
CREATE VIEW route AS
SELECT robot, start, goal, status, cost, steps, distance, reason, seconds, joules, measures
FROM measured_routes;
CREATE VIEW action_sequence AS
SELECT robot, start, goal, step, kind, place, state, action, hardness, cost, x, y, heading, rule, space, doorway, z, seconds, joules, measures
FROM kept_steps;
CREATE VIEW waypoints AS
SELECT robot, start, goal, waypoint, x, y, heading, state, action, facing, clearance, distance, cost, z, centre_x, centre_y, turn, seconds, joules, measures
FROM measured_waypoints;

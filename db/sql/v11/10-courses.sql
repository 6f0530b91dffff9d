-- Routes on maps that are not cut into rooms, as the planner of such a map finds them: through corridors, of a part out of
-- another one and into it. The views of routes have them beside those over rooms.

-- remarks: what is worth a look, as a line each. status: ok or no_route. cost: what its steps weigh together. clearance: the least metres from anything solid.
CREATE TABLE courses (
  robot     TEXT NOT NULL,
  start     TEXT NOT NULL,
  goal      TEXT NOT NULL,
  status    TEXT NOT NULL CHECK (status IN ('ok', 'no_route')),
  reason    TEXT,
  remarks   TEXT NOT NULL,
  cost      REAL,
  distance  REAL,
  clearance REAL,
  steps     INTEGER,
  PRIMARY KEY (start, goal, robot)
) STRICT, WITHOUT ROWID;

-- kind: line, arc or move. x, y, z: where the step ends.
CREATE TABLE course_steps (
  robot    TEXT NOT NULL,
  start    TEXT NOT NULL,
  goal     TEXT NOT NULL,
  step     INTEGER NOT NULL,
  kind     TEXT NOT NULL,
  place    TEXT NOT NULL,
  state    TEXT,
  action   TEXT,
  hardness REAL,
  cost     REAL NOT NULL,
  x        REAL,
  y        REAL,
  z        REAL,
  heading  REAL,
  rule     TEXT,
  PRIMARY KEY (start, goal, robot, step)
) STRICT, WITHOUT ROWID;

-- centre_x, centre_y, turn: of the arc on which one comes there, and to which side it turns.
CREATE TABLE course_waypoints (
  robot     TEXT NOT NULL,
  start     TEXT NOT NULL,
  goal      TEXT NOT NULL,
  waypoint  INTEGER NOT NULL,
  x         REAL NOT NULL,
  y         REAL NOT NULL,
  z         REAL,
  heading   REAL,
  state     TEXT,
  action    TEXT,
  clearance REAL,
  distance  REAL,
  cost      REAL NOT NULL,
  centre_x  REAL,
  centre_y  REAL,
  turn      TEXT CHECK (turn IN ('left', 'right')),
  PRIMARY KEY (start, goal, robot, waypoint)
) STRICT, WITHOUT ROWID;

-- SQLite asks each half of a view for just what a query wants only where both give a column the same affinity; `+`
-- takes it from a column where the other half computes.
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
  distance, +reason
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
                JOIN doorways AS w ON w.space1 = min(a.space, b.space) AND w.space2 = max(a.space, b.space)
                WHERE a.room = d.room1 AND a.space <> b.space)
          ORDER BY off, doorway LIMIT 1) END AS doorway,
  NULL AS z
FROM starts AS s
CROSS JOIN ends AS e
CROSS JOIN tree_rows AS g ON g.tree = s.tree AND g.node = e.node
CROSS JOIN json_each((
  WITH RECURSIVE walk (node, prev) AS (
    SELECT g.node, g.prev
    UNION ALL
    SELECT b.node, b.prev FROM walk JOIN tree_rows AS b ON b.tree = g.tree AND b.node = walk.prev)
  SELECT json_group_array(node) FROM walk)) AS j
CROSS JOIN tree_rows AS t ON t.tree = s.tree AND t.node = j.value
LEFT JOIN doors AS d ON d.door = t.door
CROSS JOIN step_parts AS p ON p.part BETWEEN 2 * (t.door IS NULL) AND 1 + (t.node = e.node)
LEFT JOIN rooms AS r ON r.room =
  CASE WHEN p.part = 2 AND e.node > 0 THEN e.node ELSE coalesce(t.from_room, t.prev) END
LEFT JOIN rules AS u ON u.rule = CASE WHEN p.part = 1 THEN d.hardness_rule ELSE r.action_rule END
UNION ALL
SELECT robot, start, goal, +step, +kind, +place, +state, +action, +hardness, +cost, +x, +y, +heading, rule, NULL, NULL, +z
FROM course_steps;

DROP VIEW waypoints;
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
  t.reach + coalesce(d.hardness, 0.0) AS cost,
  NULL AS z, NULL AS centre_x, NULL AS centre_y, NULL AS turn
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
LEFT JOIN rooms AS r ON r.room = coalesce(t.from_room, t.prev, t.node)
UNION ALL
SELECT robot, start, goal, +waypoint, +x, +y, +heading, state, action, CAST(NULL AS REAL), clearance, distance, +cost, +z,
  +centre_x, +centre_y, +turn
FROM course_waypoints;

-- The views that people ask, by the names that they have in SQLite, each with `site` before its columns. Ask with the site and
-- the key: `WHERE site = … AND robot = … AND start = … AND goal = …`. JSON is a text here as there, and booleans are 0 and 1.

CREATE VIEW adit.staleness AS
SELECT s.site,
  CASE WHEN EXISTS (SELECT 1 FROM adit.stale_marks m WHERE m.site = s.site)
    OR EXISTS (SELECT 1 FROM adit.site v WHERE v.site = s.site AND v.key = 'valid_until'
               AND v.value <= to_char(now() AT TIME ZONE 'UTC', 'YYYY-MM-DD"T"HH24:MI:SS"Z"'))
    OR EXISTS (SELECT 1 FROM adit.site v WHERE v.site = s.site AND v.key = 'valid_from'
               AND v.value > to_char(now() AT TIME ZONE 'UTC', 'YYYY-MM-DD"T"HH24:MI:SS"Z"'))
  THEN 1 ELSE 0 END AS stale
FROM adit.sites s;

CREATE VIEW adit.conclusions AS
SELECT c.site, c.class || '.' || c.key AS object, c.property, c.value, u.name AS rule, u.version, w.facts AS witness,
  c.class, c.key, u.file, u.line
FROM (
  SELECT site, 'prime_areas' AS class, area::text AS key, 'open' AS property, open::text AS value, open_rule AS rule, open_witness AS witness
    FROM adit.prime_area_strips WHERE open_rule IS NOT NULL
  UNION ALL SELECT site, 'rooms', room::text, 'hardness', hardness::text, hardness_rule, hardness_witness
    FROM adit.rooms WHERE hardness_rule IS NOT NULL
  UNION ALL SELECT site, 'rooms', room::text, 'action', action, action_rule, action_witness
    FROM adit.rooms WHERE action_rule IS NOT NULL
  UNION ALL SELECT site, 'rooms', room::text, 'passable', passable::text, passable_rule, passable_witness
    FROM adit.rooms WHERE passable_rule IS NOT NULL
  UNION ALL SELECT site, 'doors', door::text, 'hardness', hardness::text, hardness_rule, hardness_witness
    FROM adit.doors WHERE hardness_rule IS NOT NULL
  UNION ALL SELECT site, 'doors', door::text, 'action', action, action_rule, action_witness
    FROM adit.doors WHERE action_rule IS NOT NULL
  UNION ALL SELECT site, 'doors', door::text, 'passable', passable::text, passable_rule, passable_witness
    FROM adit.doors WHERE passable_rule IS NOT NULL
  UNION ALL SELECT site, class, key::json #>> '{}', property, value::json #>> '{}', rule, witness FROM adit.derivations) AS c
LEFT JOIN adit.rules u ON u.site = c.site AND u.rule = c.rule
LEFT JOIN adit.witnesses w ON w.site = c.site AND w.witness = c.witness;

CREATE VIEW adit.facts_told AS
SELECT t.site, t.id, t.class, coalesce(t.key, t.x || ',' || t.y) AS object, t.property,
  CASE t.kind WHEN 'truth' THEN CASE t.value WHEN '1' THEN 'true' ELSE 'false' END ELSE t.value::json #>> '{}' END AS value,
  t.until, s.state,
  (SELECT coalesce(json_agg(a.key ORDER BY a.key), '[]'::json)::text FROM adit.attachments a WHERE a.site = t.site AND a.told = t.id) AS objects,
  t.who, t.why, t.at
FROM adit.told t LEFT JOIN adit.told_states s ON s.site = t.site AND s.told = t.id;

CREATE VIEW adit.opening_hours AS
SELECT site, name, days, opens, closes, 'site.toml' AS source FROM adit.site_hours
UNION ALL SELECT site, name, days, opens, closes, 'hours' FROM adit.hours;

CREATE VIEW adit.cells_in_force AS
SELECT c.site, c.table_name, c.key, c.column_name, c.value::json #>> '{}' AS value, c.tuning
FROM adit.active_tunings a JOIN adit.tuning_cells c ON c.site = a.site AND c.tuning = a.tuning;

CREATE VIEW adit.robots_in_force AS
SELECT r.site, r.robot, r.state,
  coalesce((SELECT c.value FROM adit.cells_in_force c WHERE c.site = r.site AND c.table_name = 'robots'
    AND c.key = r.robot || '/' || r.state AND c.column_name = 'action'), r.action) AS action,
  coalesce((SELECT c.value FROM adit.cells_in_force c WHERE c.site = r.site AND c.table_name = 'robots'
    AND c.key = r.robot || '/' || r.state AND c.column_name = 'height')::double precision, r.height) AS height,
  coalesce((SELECT c.value FROM adit.cells_in_force c WHERE c.site = r.site AND c.table_name = 'robots'
    AND c.key = r.robot || '/' || r.state AND c.column_name = 'width')::double precision, r.width) AS width,
  coalesce((SELECT c.value FROM adit.cells_in_force c WHERE c.site = r.site AND c.table_name = 'robots'
    AND c.key = r.robot || '/' || r.state AND c.column_name = 'length')::double precision, r.length) AS length,
  coalesce((SELECT c.value FROM adit.cells_in_force c WHERE c.site = r.site AND c.table_name = 'robots'
    AND c.key = r.robot || '/' || r.state AND c.column_name = 'hardness')::double precision, r.hardness) AS hardness,
  coalesce((SELECT c.value FROM adit.cells_in_force c WHERE c.site = r.site AND c.table_name = 'robots'
    AND c.key = r.robot || '/' || r.state AND c.column_name = 'position')::bigint, r.position) AS position,
  coalesce((SELECT c.value FROM adit.cells_in_force c WHERE c.site = r.site AND c.table_name = 'robots'
    AND c.key = r.robot || '/' || r.state AND c.column_name = 'speed')::double precision, r.speed) AS speed,
  coalesce((SELECT c.value FROM adit.cells_in_force c WHERE c.site = r.site AND c.table_name = 'robots'
    AND c.key = r.robot || '/' || r.state AND c.column_name = 'power')::double precision, r.power) AS power
FROM adit.robots r;

CREATE VIEW adit.changes_in_force AS
SELECT r.site, r.robot, r.from_state, r.to_state,
  coalesce((SELECT c.value FROM adit.cells_in_force c WHERE c.site = r.site AND c.table_name = 'changes'
    AND c.key = r.robot || '/' || r.from_state || '/' || r.to_state AND c.column_name = 'hardness')::double precision, r.hardness) AS hardness,
  coalesce((SELECT c.value FROM adit.cells_in_force c WHERE c.site = r.site AND c.table_name = 'changes'
    AND c.key = r.robot || '/' || r.from_state || '/' || r.to_state AND c.column_name = 'seconds')::double precision, r.seconds) AS seconds,
  coalesce((SELECT c.value FROM adit.cells_in_force c WHERE c.site = r.site AND c.table_name = 'changes'
    AND c.key = r.robot || '/' || r.from_state || '/' || r.to_state AND c.column_name = 'joules')::double precision, r.joules) AS joules
FROM adit.changes r;

CREATE VIEW adit.loads_in_force AS
SELECT r.site, r.robot, r.load,
  coalesce((SELECT c.value FROM adit.cells_in_force c WHERE c.site = r.site AND c.table_name = 'loads'
    AND c.key = r.robot || '/' || r.load AND c.column_name = 'height')::double precision, r.height) AS height,
  coalesce((SELECT c.value FROM adit.cells_in_force c WHERE c.site = r.site AND c.table_name = 'loads'
    AND c.key = r.robot || '/' || r.load AND c.column_name = 'width')::double precision, r.width) AS width,
  coalesce((SELECT c.value FROM adit.cells_in_force c WHERE c.site = r.site AND c.table_name = 'loads'
    AND c.key = r.robot || '/' || r.load AND c.column_name = 'carried')::bigint, r.carried) AS carried
FROM adit.loads r;

CREATE VIEW adit.routes AS
SELECT s.site, s.robot, s.name AS start, r.room, t.reach + coalesce(d.hardness, 0.0) AS cost,
  t.door AS from_door, coalesce(t.from_room, t.prev) AS from_room, r.name AS room_name, t.hops
FROM adit.starts s
JOIN adit.rooms r ON r.site = s.site AND (r.robot IS NULL OR r.robot = s.robot)
JOIN adit.ends e ON e.site = s.site AND e.name = r.name AND e.kept = 1
LEFT JOIN adit.tree_rows t ON t.site = s.site AND t.tree = s.tree AND t.node = r.room
LEFT JOIN adit.doors d ON d.site = s.site AND d.door = t.door;

-- What adds up along the way to a node of a tree.
CREATE VIEW adit.tree_measures AS
SELECT g.site, g.tree, g.node, (
  WITH RECURSIVE walk (node, prev, door, room, walked) AS (
    SELECT g.node, g.prev, g.door, coalesce(g.from_room, g.prev, g.node), CASE WHEN g.prev IS NULL THEN 0.0::double precision ELSE g.walked END
    UNION ALL
    SELECT b.node, b.prev, b.door, coalesce(b.from_room, b.prev, b.node), CASE WHEN b.prev IS NULL THEN 0.0::double precision ELSE b.walked END
    FROM walk JOIN adit.tree_rows b ON b.site = g.site AND b.tree = g.tree AND b.node = walk.prev),
  parts (measures, metres) AS (
    SELECT r.measures, walk.walked
    FROM walk JOIN adit.rooms r ON r.site = g.site AND r.room = walk.room
    WHERE walk.node = g.node OR walk.door IS NOT NULL OR walk.prev IS NULL
    UNION ALL
    SELECT d.measures, 1.0::double precision FROM walk JOIN adit.doors d ON d.site = g.site AND d.door = walk.door),
  totals (key, total) AS (
    SELECT key, sum(amount)
    FROM (SELECT e.key, CASE WHEN e.value::double precision = 0.0 THEN 0.0 ELSE e.value::double precision * parts.metres END AS amount
          FROM parts CROSS JOIN LATERAL json_each_text(parts.measures::json) AS e (key, value)) AS amounts
    GROUP BY key
    HAVING count(amount) = 1 + 2 * g.hops + CASE WHEN g.door IS NULL AND g.prev IS NOT NULL THEN 1 ELSE 0 END)
  SELECT CASE WHEN count(key) > 0 THEN json_object_agg(key, total)::text END FROM totals) AS measures
FROM adit.tree_rows g;

CREATE VIEW adit.kept_routes AS
SELECT b.site, b.robot, a.name AS start, e.name AS goal,
  CASE WHEN s.tree IS NULL OR e.kept = 0 THEN 'not_kept'
       WHEN (SELECT f.stale FROM adit.staleness f WHERE f.site = b.site) = 1 THEN 'stale'
       WHEN t.hops IS NULL THEN 'no_route'
       WHEN t.hops = 0 THEN 'same_room'
       ELSE 'ok' END AS status,
  t.reach + coalesce(d.hardness, 0.0) AS cost,
  2 * t.hops + 1 AS steps,
  t.distance,
  NULL::text AS reason,
  (SELECT m.measures FROM adit.tree_measures m WHERE m.site = b.site AND m.tree = s.tree AND m.node = t.node) AS measures
FROM (SELECT DISTINCT site, robot FROM adit.robots) AS b
JOIN adit.ends a ON a.site = b.site
JOIN adit.ends e ON e.site = b.site
LEFT JOIN adit.starts s ON s.site = b.site AND s.name = a.name AND s.robot = b.robot
LEFT JOIN adit.tree_rows t ON t.site = b.site AND t.tree = s.tree AND t.node = e.node
LEFT JOIN adit.doors d ON d.site = b.site AND d.door = t.door
UNION ALL
SELECT c.site, c.robot, c.start, c.goal,
  CASE WHEN (SELECT f.stale FROM adit.staleness f WHERE f.site = c.site) = 1 THEN 'stale' ELSE c.status END, c.cost, c.steps,
  c.distance, c.reason, c.measures
FROM adit.courses c;

-- A row of a way's door is `part` 1, of the room on this side of it 0, of the last room 2. Doors and rooms are looked up once for each
-- stop, the other room at a door only where both may have a space, measures only where there are some.
CREATE VIEW adit.kept_steps AS
SELECT s.site, s.robot, s.name AS start, e.name AS goal,
  2 * t.hops - 1 + p.part AS step,
  CASE WHEN p.part = 1 THEN t.kind ELSE 'room' END AS kind,
  CASE WHEN p.part = 1 THEN t.door::text ELSE r.name END AS place,
  CASE WHEN p.part = 1 AND t.kind = 'change'
    THEN (SELECT n.state FROM adit.rooms n WHERE n.site = s.site AND n.room = t.beyond)
    ELSE r.state END AS state,
  CASE WHEN p.part = 1 THEN t.action ELSE r.action END AS action,
  CASE WHEN p.part = 1 THEN t.hardness WHEN p.part = 2 AND t.door IS NOT NULL THEN 0.0 ELSE t.leg END AS hardness,
  CASE WHEN p.part > 0 THEN t.reach + coalesce(t.hardness, 0.0) ELSE t.reach END AS cost,
  t.x, t.y,
  CASE WHEN p.part = 2 AND t.door IS NOT NULL THEN NULL ELSE t.heading / 100.0::double precision END AS heading,
  u.name AS rule,
  CASE WHEN p.part <> 1 AND r.space IS NOT NULL
    THEN (SELECT coalesce(o.name, 'space ' || o.space) FROM adit.spaces o WHERE o.site = s.site AND o.space = r.space) END AS space,
  CASE WHEN p.part = 1 AND t.kind = 'door' AND r.space IS NOT NULL
    THEN (SELECT coalesce(w.name, 'doorway ' || w.doorway)
          FROM adit.rooms b
          JOIN adit.doorways w ON w.site = s.site AND w.space1 = least(r.space, b.space) AND w.space2 = greatest(r.space, b.space)
          WHERE b.site = s.site AND b.room = t.beyond AND b.space <> r.space
          ORDER BY (w.x - t.door_x) * (w.x - t.door_x) + (w.y - t.door_y) * (w.y - t.door_y), w.doorway LIMIT 1) END AS doorway,
  NULL::double precision AS z,
  CASE WHEN p.part = 1 THEN (t.measures::json ->> 'seconds')::double precision
    WHEN (r.measures::json ->> 'seconds')::double precision = 0.0 OR p.part = 2 AND t.door IS NOT NULL
    THEN 0.0 * (r.measures::json ->> 'seconds')::double precision
    ELSE t.walked * (r.measures::json ->> 'seconds')::double precision END AS seconds,
  CASE WHEN p.part = 1 THEN (t.measures::json ->> 'joules')::double precision
    WHEN (r.measures::json ->> 'joules')::double precision = 0.0 OR p.part = 2 AND t.door IS NOT NULL
    THEN 0.0 * (r.measures::json ->> 'joules')::double precision
    ELSE t.walked * (r.measures::json ->> 'joules')::double precision END AS joules,
  CASE WHEN CASE p.part WHEN 1 THEN t.measures ELSE r.measures END IS NOT NULL THEN
    (SELECT CASE WHEN count(key) > 0 THEN json_object_agg(key, amount)::text END
     FROM (SELECT v.key,
             CASE WHEN p.part = 1 THEN v.value::double precision
               WHEN v.value::double precision = 0.0 OR p.part = 2 AND t.door IS NOT NULL THEN 0.0
               ELSE t.walked * v.value::double precision END AS amount
           FROM json_each_text((CASE p.part WHEN 1 THEN t.measures ELSE r.measures END)::json) AS v (key, value)) AS amounts
     WHERE amount IS NOT NULL) END AS measures
FROM adit.starts s
JOIN adit.ends e ON e.site = s.site
CROSS JOIN LATERAL (
  WITH RECURSIVE walk AS (
    SELECT g.* FROM adit.tree_rows g WHERE g.site = s.site AND g.tree = s.tree AND g.node = e.node
    UNION ALL
    SELECT b.* FROM walk JOIN adit.tree_rows b ON b.site = walk.site AND b.tree = walk.tree AND b.node = walk.prev)
  SELECT walk.node, walk.hops, walk.door, walk.leg, walk.reach, walk.heading, walk.walked,
    coalesce(walk.x, d.x) AS x, coalesce(walk.y, d.y) AS y, d.x AS door_x, d.y AS door_y,
    coalesce(walk.from_room, walk.prev) AS room,
    CASE d.room1 WHEN coalesce(walk.from_room, walk.prev) THEN d.room2 ELSE d.room1 END AS beyond,
    d.kind, d.action, d.hardness, d.hardness_rule, d.measures
  FROM walk LEFT JOIN adit.doors d ON d.site = s.site AND d.door = walk.door
  OFFSET 0) AS t
CROSS JOIN (VALUES (0), (1), (2)) AS p (part)
LEFT JOIN adit.rooms r ON r.site = s.site AND r.room = CASE WHEN p.part = 2 AND e.node > 0 THEN e.node ELSE t.room END
LEFT JOIN adit.rules u ON u.site = s.site AND u.rule = CASE WHEN p.part = 1 THEN t.hardness_rule ELSE r.action_rule END
WHERE p.part BETWEEN CASE WHEN t.door IS NULL THEN 2 ELSE 0 END AND CASE WHEN t.node = e.node THEN 2 ELSE 1 END
UNION ALL
SELECT site, robot, start, goal, step, kind, place, state, action, hardness, cost, x, y, heading, rule, NULL, NULL, z,
  (measures::json ->> 'seconds')::double precision, (measures::json ->> 'joules')::double precision, measures
FROM adit.course_steps;

CREATE VIEW adit.kept_waypoints AS
SELECT s.site, s.robot, s.name AS start, e.name AS goal, t.waypoint,
  coalesce(t.x, d.x) AS x,
  coalesce(t.y, d.y) AS y,
  t.heading / 100.0::double precision AS heading,
  r.state, r.action, r.facing, t.clearance, t.distance,
  t.reach + coalesce(d.hardness, 0.0) AS cost,
  NULL::double precision AS z, NULL::double precision AS centre_x, NULL::double precision AS centre_y, NULL::text AS turn,
  (SELECT m.measures FROM adit.tree_measures m WHERE m.site = s.site AND m.tree = s.tree AND m.node = t.node) AS measures
FROM adit.starts s
JOIN adit.ends e ON e.site = s.site
CROSS JOIN LATERAL (
  WITH RECURSIVE walk (site, tree, node, prev, from_room, door, reach, x, y, heading, distance, clearance, bend, stops, depth) AS (
    SELECT g.site, g.tree, g.node, g.prev, g.from_room, g.door, g.reach, g.x, g.y, g.heading, g.distance, g.clearance, g.bend, 1, 0
    FROM adit.tree_rows g WHERE g.site = s.site AND g.tree = s.tree AND g.node = e.node
    UNION ALL
    SELECT b.site, b.tree, b.node, b.prev, b.from_room, b.door, b.reach, b.x, b.y, b.heading, b.distance, b.clearance, b.bend,
      CASE WHEN walk.bend = 1 OR b.prev IS NULL THEN 1 ELSE 0 END, walk.depth + 1
    FROM walk JOIN adit.tree_rows b ON b.site = walk.site AND b.tree = walk.tree AND b.node = walk.prev)
  SELECT walk.*, row_number() OVER (ORDER BY depth DESC) AS waypoint FROM walk WHERE stops = 1) AS t
LEFT JOIN adit.doors d ON d.site = s.site AND d.door = t.door
LEFT JOIN adit.rooms r ON r.site = s.site AND r.room = coalesce(t.from_room, t.prev, t.node)
UNION ALL
SELECT site, robot, start, goal, waypoint, x, y, heading, state, action, NULL, clearance, distance, cost, z,
  centre_x, centre_y, turn, measures
FROM adit.course_waypoints;

CREATE VIEW adit.route AS
SELECT site, robot, start, goal, status, cost, steps, distance, reason,
  (measures::json ->> 'seconds')::double precision AS seconds, (measures::json ->> 'joules')::double precision AS joules, measures
FROM adit.kept_routes;

CREATE VIEW adit.action_sequence AS
SELECT site, robot, start, goal, step, kind, place, state, action, hardness, cost, x, y, heading, rule, space, doorway, z, seconds,
  joules, measures
FROM adit.kept_steps;

CREATE VIEW adit.waypoints AS
SELECT site, robot, start, goal, waypoint, x, y, heading, state, action, facing, clearance, distance, cost, z, centre_x, centre_y,
  turn, (measures::json ->> 'seconds')::double precision AS seconds, (measures::json ->> 'joules')::double precision AS joules, measures
FROM adit.kept_waypoints;

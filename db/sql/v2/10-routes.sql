-- Routes as they are driven: for each step how far it is from the start, how near to anything solid, and whether the
-- way bends where it begins.

-- kept: whether trees lead to it.
ALTER TABLE ends ADD COLUMN kept INTEGER NOT NULL DEFAULT 1 CHECK (kept IN (0, 1));

-- distance: metres from the start. clearance: the least metres between the robot's rim and anything solid since the last
-- bend. Both NULL where a way is not measured. bend: whether the robot turns or changes its shape where the step begins.
ALTER TABLE tree_rows ADD COLUMN distance REAL;
ALTER TABLE tree_rows ADD COLUMN clearance REAL;
ALTER TABLE tree_rows ADD COLUMN bend INTEGER NOT NULL DEFAULT 1 CHECK (bend IN (0, 1));

DROP VIEW routes;
CREATE VIEW routes AS
SELECT s.robot AS robot, s.name AS start, r.room AS room, t.reach + coalesce(d.hardness, 0.0) AS cost,
       t.door AS from_door, coalesce(t.from_room, t.prev) AS from_room, r.name AS room_name, t.hops AS hops
FROM starts AS s
CROSS JOIN rooms AS r
CROSS JOIN ends AS e ON e.name = r.name AND e.kept = 1
LEFT JOIN tree_rows AS t ON t.tree = s.tree AND t.node = r.room
LEFT JOIN doors AS d ON d.door = t.door
WHERE r.robot IS NULL OR r.robot = s.robot;

DROP VIEW route;
CREATE VIEW route AS
SELECT b.robot AS robot, a.name AS start, e.name AS goal,
  CASE WHEN s.tree IS NULL OR e.kept = 0 THEN 'not_kept'
       WHEN EXISTS (SELECT 1 FROM stale_marks) THEN 'stale'
       WHEN t.hops IS NULL THEN 'no_route'
       WHEN t.hops = 0 THEN 'same_room'
       ELSE 'ok' END AS status,
  t.reach + coalesce(d.hardness, 0.0) AS cost,
  2 * t.hops + 1 AS steps,
  t.distance AS distance
FROM (SELECT DISTINCT robot FROM robots) AS b
CROSS JOIN ends AS a
CROSS JOIN ends AS e
LEFT JOIN starts AS s ON s.name = a.name AND s.robot = b.robot
LEFT JOIN tree_rows AS t ON t.tree = s.tree AND t.node = e.node
LEFT JOIN doors AS d ON d.door = t.door;

-- Only what is kept has a line. `route` pairs every place with every other to say what is not kept, 1.4 million pairs on the clinic:
-- the first three lines took 0.2 s, and take a millisecond from the starts of what is kept. As in v15, the
-- waypoints of each are reached by its key.
DROP VIEW map_routes;
CREATE VIEW map_routes AS
SELECT r.robot, r.start, r.goal, r.status, r.cost, r.distance,
  CAST(x'47500001FFFFFFFF0102000000'
      || (SELECT data FROM octets WHERE octet = (json_array_length(r.points) / 2) & 255)
      || (SELECT data FROM octets WHERE octet = (json_array_length(r.points) / 2) >> 8 & 255) || x'0000'
      || (
      SELECT group_concat(o.data, '')
      FROM (SELECT coalesce(
          ((v.atom < 0) << 63)
          | (((SELECT octet FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1) + 895) << 52)
          | CAST(abs(v.atom) / (SELECT power FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1)
              * 4503599627370496.0 AS INTEGER) - 4503599627370496, 0) AS bits
            FROM json_tree(r.points) AS v WHERE v.atom IS NOT NULL LIMIT -1) AS n
      CROSS JOIN octets AS i
      CROSS JOIN octets AS o
      WHERE i.octet < 8 AND o.octet = n.bits >> 8 * i.octet & 255) AS BLOB) AS geom
FROM (SELECT robot, start, goal, status, cost, distance, '[' || coalesce((
    SELECT group_concat(printf('%!.17g,%!.17g', x, y))
    FROM (SELECT coalesce(t.x, d.x) AS x, coalesce(t.y, d.y) AS y
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
          WHERE s.robot = route.robot AND s.name = route.start AND e.name = route.goal
            AND g.tree = s.tree AND g.node = e.node AND t.tree = s.tree AND t.node = j.value
          ORDER BY CAST(j.key AS INTEGER))), (
    SELECT group_concat(printf('%!.17g,%!.17g', x, y))
    FROM (SELECT w.x AS x, w.y AS y FROM course_waypoints AS w
          WHERE w.robot = route.robot AND w.start = route.start AND w.goal = route.goal ORDER BY w.waypoint))) || ']' AS points
  FROM route WHERE status IN ('ok', 'same_room', 'stale') AND start IN (SELECT name FROM starts UNION SELECT start FROM courses) LIMIT -1) AS r
WHERE json_array_length(r.points) > 2;

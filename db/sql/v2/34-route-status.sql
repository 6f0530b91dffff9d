-- Routes are stale by an edit that no build has followed up, and by the clock: what was derived holds from the site's
-- value `valid_from` up to `valid_until`, the next moment at which a fact ends or opening hours begin or end.
CREATE VIEW staleness AS
SELECT EXISTS (SELECT 1 FROM stale_marks)
    OR EXISTS (SELECT 1 FROM site WHERE key = 'valid_until' AND value <= strftime('%Y-%m-%dT%H:%M:%SZ', 'now'))
    OR EXISTS (SELECT 1 FROM site WHERE key = 'valid_from' AND value > strftime('%Y-%m-%dT%H:%M:%SZ', 'now'))
  AS stale;

DROP VIEW route;
CREATE VIEW route AS
SELECT b.robot AS robot, a.name AS start, e.name AS goal,
  CASE WHEN s.tree IS NULL THEN 'not_kept'
       WHEN (SELECT stale FROM staleness) THEN 'stale'
       WHEN t.hops IS NULL THEN 'no_route'
       WHEN t.hops = 0 THEN 'same_room'
       ELSE 'ok' END AS status,
  t.reach + coalesce(d.hardness, 0.0) AS cost,
  2 * t.hops + 1 AS steps
FROM (SELECT DISTINCT robot FROM robots) AS b
CROSS JOIN ends AS a
CROSS JOIN ends AS e
LEFT JOIN starts AS s ON s.name = a.name AND s.robot = b.robot
LEFT JOIN tree_rows AS t ON t.tree = s.tree AND t.node = e.node
LEFT JOIN doors AS d ON d.door = t.door;

-- The walk back from the goal stands inside json_each(), where it may depend on the row beside it: so a plain
-- SELECT ... WHERE start = ? AND goal = ? reaches every table by key. A recursive view would make every route first.
--
-- Each node on the way gives two steps: 0, walk to the door, and 1, pass it; the goal one more: 2, arrive.
-- A table, since SQLite would build the three rows anew for each route, which takes a fifth of its time.
CREATE TABLE step_parts (part INTEGER PRIMARY KEY CHECK (part BETWEEN 0 AND 2)) STRICT;
INSERT INTO step_parts VALUES (0), (1), (2);

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
  u.name AS rule
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
LEFT JOIN rules AS u ON u.rule = CASE WHEN p.part = 1 THEN d.hardness_rule ELSE r.action_rule END;

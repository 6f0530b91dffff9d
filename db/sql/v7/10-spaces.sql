-- The rooms of a building as people see them, the same for all robots, and the openings between them. Metres.
--
-- called: what the map calls it, by the only place or area in it. name, kind, closed: what rules say, or what was told.
-- breadth: where it is widest, at x, y. outline: a JSON list of rings [[x,y],…], the outer one first.
CREATE TABLE spaces (
  space   INTEGER PRIMARY KEY,
  called  TEXT,
  name    TEXT,
  kind    TEXT,
  area    REAL NOT NULL,
  breadth REAL NOT NULL,
  x       REAL NOT NULL,
  y       REAL NOT NULL,
  outline TEXT NOT NULL CONSTRAINT "outline must be a JSON list of rings" CHECK (json_valid(outline)),
  closed  INTEGER CHECK (closed IN (0, 1))
) STRICT;

-- From x0, y0 to x1, y1; x, y is the middle. height: of the lowest bridge over it, NULL where there is none. space1 and space2
-- are one where a door is drawn within a space.
CREATE TABLE doorways (
  doorway INTEGER PRIMARY KEY,
  called  TEXT,
  name    TEXT,
  space1  INTEGER NOT NULL,
  space2  INTEGER NOT NULL,
  x       REAL NOT NULL,
  y       REAL NOT NULL,
  x0      REAL NOT NULL,
  y0      REAL NOT NULL,
  x1      REAL NOT NULL,
  y1      REAL NOT NULL,
  width   REAL NOT NULL,
  height  REAL,
  closed  INTEGER CHECK (closed IN (0, 1))
) STRICT;
CREATE INDEX doorways_by_spaces ON doorways (space1, space2);

-- The space that the room's centre lies in.
ALTER TABLE rooms ADD COLUMN space INTEGER;

-- space: of the room that is walked in. doorway: through which a door leads into another space.
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
          ORDER BY off, doorway LIMIT 1) END AS doorway
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

-- What was cut before is cut anew, and its blocks, which know no spaces, are written anew.
DELETE FROM site WHERE key = 'basis' OR key LIKE 'planner.%';
DELETE FROM blocks WHERE class = 'rooms';

-- Trees, never sequences: for each start the last step into each node.

-- Several start names may share a tree.
CREATE TABLE starts (
  name  TEXT NOT NULL CHECK (length(name) > 0),
  robot TEXT NOT NULL CHECK (length(robot) > 0),
  tree  INTEGER NOT NULL,
  PRIMARY KEY (name, robot)
) STRICT, WITHOUT ROWID;

-- Names that a route may start or end at. A room's node is its key; other nodes are negative.
CREATE TABLE ends (
  name TEXT PRIMARY KEY CHECK (length(name) > 0),
  node INTEGER NOT NULL,
  kind TEXT NOT NULL CHECK (kind IN ('place', 'room'))
) STRICT, WITHOUT ROWID;

-- prev: the node before; from_room: the room that the step walks through, where prev is not itself a room's key.
-- door: passed at the end of the step (NULL at the start, and for a place inside the room). hops: doors passed.
-- reach: cost up to the door, or to the place; the cost on arrival is reach + the door's hardness. leg: what the walk in
-- from_room added to it. x, y: where the step ends (NULL: at the door's x, y). heading: of the movement into that
-- point, in hundredths of a degree. An unreachable node has no row.
CREATE TABLE tree_rows (
  tree      INTEGER NOT NULL,
  node      INTEGER NOT NULL,
  prev      INTEGER,
  from_room INTEGER,
  door      INTEGER,
  hops      INTEGER NOT NULL,
  reach     REAL NOT NULL,
  leg       REAL NOT NULL,
  x         REAL,
  y         REAL,
  heading   INTEGER,
  PRIMARY KEY (tree, node)
) STRICT, WITHOUT ROWID;

CREATE VIEW routes AS
SELECT s.robot AS robot, s.name AS start, r.room AS room, t.reach + coalesce(d.hardness, 0.0) AS cost,
       t.door AS from_door, coalesce(t.from_room, t.prev) AS from_room, r.name AS room_name, t.hops AS hops
FROM starts AS s
CROSS JOIN rooms AS r
LEFT JOIN tree_rows AS t ON t.tree = s.tree AND t.node = r.room
LEFT JOIN doors AS d ON d.door = t.door
WHERE r.robot IS NULL OR r.robot = s.robot;

CREATE VIEW route AS
SELECT b.robot AS robot, a.name AS start, e.name AS goal,
  CASE WHEN s.tree IS NULL THEN 'not_kept'
       WHEN EXISTS (SELECT 1 FROM stale_marks) THEN 'stale'
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

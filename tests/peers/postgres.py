#!/usr/bin/env python3
"""postgres.py CLUSTER GRAPH KEEP: one stored route of the site that is called as the number of its rooms, by
action_sequence with all columns and with those that pgRouting has too, prepared, beside pgr_dijkstra over its doors, on the
same pairs in turns: by the clock, the least of PASSES for each pair, and of those the median."""
import array, gc, statistics, sys, time

import psycopg2

from routing import questions

PASSES = 4
CLUSTER, GRAPH, KEEP = sys.argv[1:4]
ROOMS = GRAPH.rsplit("/", 1)[1]
OURS = (
    "PREPARE {} (text, text) AS SELECT {} FROM adit.action_sequence "
    "WHERE site = '" + ROOMS + "' AND robot = 'robot' AND start = $1 AND goal = $2 ORDER BY step"
)
EDGES = "SELECT id, source, target, cost, reverse_cost FROM door"
THEIRS = (
    "PREPARE theirs (bigint, bigint) AS SELECT p.path_seq, p.edge, p.node, p.cost, p.agg_cost "
    f"FROM pgr_dijkstra('{EDGES}', $1, $2, true) p ORDER BY p.path_seq"
)


def doors(cursor):
    """The same doors as pgRouting wants them."""
    words = array.array("I")
    with open(GRAPH + "/doors.u32", "rb") as file:
        words.frombytes(file.read())
    cursor.execute("CREATE EXTENSION IF NOT EXISTS pgrouting CASCADE")
    cursor.execute("DROP TABLE IF EXISTS door")
    cursor.execute("CREATE TABLE door (id int PRIMARY KEY, source int, target int, cost float8, reverse_cost float8)")
    rows = [words[at:at + 5] for at in range(0, len(words), 5)]
    columns = [[row[0] for row in rows], [row[1] for row in rows], [row[2] for row in rows],
               [float(row[3]) for row in rows], [-1.0 if row[4] else float(row[3]) for row in rows]]
    cursor.execute("INSERT INTO door SELECT * FROM unnest(%s::int[], %s::int[], %s::int[], %s::float8[], %s::float8[])", columns)


connection = psycopg2.connect(host=CLUSTER, user="adit", dbname="postgres")
connection.autocommit = True
cursor = connection.cursor()
doors(cursor)
cursor.execute("VACUUM ANALYZE")
cursor.execute(OURS.format("ours", "*"))
cursor.execute(OURS.format("as_theirs", "step, place, action, hardness, cost"))
cursor.execute(THEIRS)
asked = questions(GRAPH, int(KEEP))
# pgRouting reads the whole graph for each route
few = asked[: 100 if int(ROOMS) <= 10_000 else 20]


def ask(name, start, goal):
    mark = "r" if name != "theirs" else ""
    cursor.execute(f"EXECUTE {name} (%s, %s)", (f"{mark}{start}", f"{mark}{goal}"))
    return cursor.fetchall()


for start, goal in few[:5]:
    ours, theirs = ask("as_theirs", start, goal), ask("theirs", start, goal)
    assert abs(ours[-1][4] - (theirs[-1][4] if theirs else 0)) < 1e-9, (start, goal, ours[-1], theirs[-1:])
least = {name: {} for name in ("ours", "as_theirs", "theirs")}
gc.disable()
for number in range(PASSES):
    for name, times in least.items():
        for pair in asked if name != "theirs" else few if number < 2 else []:
            begin = time.perf_counter()
            ask(name, *pair)
            times[pair] = min(times.get(pair, 1e9), (time.perf_counter() - begin) * 1e3)
ours, as_theirs, theirs = (statistics.median(times.values()) for times in least.values())
print(
    f"{ROOMS:>7} rooms: a stored route {ours:.2f} ms with all columns, {as_theirs:.2f} ms with those of pgRouting, "
    f"which takes {theirs:.1f} ms: {theirs / as_theirs:.0f} times as long",
    flush=True,
)

#!/usr/bin/env python3
"""postgres.py PROGRAMS CLUSTER GRAPH KEEP: one stored route of the site that is called as the number of its rooms, by
action_sequence with all columns and with those that pgRouting has too, beside pgr_dijkstra over its doors, on the same pairs
in turns: as PostgreSQL's own pgbench (in the folder PROGRAMS) measures a prepared statement, all rows received."""
import array, re, statistics, subprocess, sys, tempfile

import psycopg2
from psycopg2.extras import execute_values

from routing import questions

PASSES = 5
PROGRAMS, CLUSTER, GRAPH, KEEP = sys.argv[1:5]
ROOMS = GRAPH.rsplit("/", 1)[1]
OURS = (
    "SELECT {} FROM adit.action_sequence WHERE site = '" + ROOMS + "' AND robot = 'robot' AND start = {} AND goal = {} "
    "ORDER BY step"
)
EDGES = "SELECT id, source, target, cost, reverse_cost FROM door"
THEIRS = (
    "SELECT p.path_seq, p.edge, p.node, p.cost, p.agg_cost "
    f"FROM pgr_dijkstra('{EDGES}', {{}}, {{}}, true) p ORDER BY p.path_seq"
)
AS_THEIRS = "step, place, action, hardness, cost"
ASKED = """\\set n random(1, {})
SELECT 'r' || start AS a, 'r' || goal AS b, start AS s, goal AS g FROM pair WHERE n = :n \\gset
{};
"""


def fill(cursor, table, columns, rows):
    cursor.execute(f"DROP TABLE IF EXISTS {table}")
    cursor.execute(f"CREATE TABLE {table} ({columns})")
    execute_values(cursor, f"INSERT INTO {table} VALUES %s", rows, page_size=10_000)


def doors():
    """The same doors as pgRouting wants them."""
    words = array.array("I")
    with open(GRAPH + "/doors.u32", "rb") as file:
        words.frombytes(file.read())
    rows = (words[at:at + 5] for at in range(0, len(words), 5))
    return [(*row[:3], float(row[3]), -1.0 if row[4] else float(row[3])) for row in rows]


connection = psycopg2.connect(host=CLUSTER, user="adit", dbname="postgres")
connection.autocommit = True
cursor = connection.cursor()
cursor.execute("CREATE EXTENSION IF NOT EXISTS pgrouting CASCADE")
fill(cursor, "door", "id int PRIMARY KEY, source int, target int, cost float8, reverse_cost float8", doors())
asked = questions(GRAPH, int(KEEP))
pairs = [(n, start, goal) for n, (start, goal) in enumerate(asked, 1)]
fill(cursor, "pair", "n int PRIMARY KEY, start bigint, goal bigint", pairs)
cursor.execute("VACUUM ANALYZE")

for _, start, goal in pairs[:5]:
    cursor.execute(OURS.format(AS_THEIRS, "%s", "%s"), (f"r{start}", f"r{goal}"))
    ours = cursor.fetchall()
    cursor.execute(THEIRS.format(start, goal))
    theirs = cursor.fetchall()
    assert abs(ours[-1][4] - (theirs[-1][4] if theirs else 0)) < 1e-9, (start, goal, ours[-1], theirs[-1:])


def measured(query, turns):
    """Milliseconds a statement, on random ones of the pairs."""
    with tempfile.NamedTemporaryFile("w", suffix=".sql") as script:
        script.write(ASKED.format(len(pairs), query))
        script.flush()
        told = subprocess.run(
            [PROGRAMS + "/pgbench", "-n", "-r", "-M", "prepared", "-h", CLUSTER, "-U", "adit", "-t", str(turns),
             "-f", script.name, "postgres"],
            check=True, stdout=subprocess.PIPE, text=True,
        ).stdout
    return float(re.findall(r"^ +([\d.]+)", told, re.MULTILINE)[-1])


# pgRouting reads the whole graph for each route
few = {1_000: 200, 10_000: 40}.get(int(ROOMS), 10)
runs = {
    "all": (OURS.format("*", ":a", ":b"), 2_000),
    "few": (OURS.format(AS_THEIRS, ":a", ":b"), 2_000),
    "theirs": (THEIRS.format(":s::bigint", ":g::bigint"), few),
}
times = {name: [] for name in runs}
for _ in range(PASSES):
    for name, run in runs.items():
        times[name].append(measured(*run))
ours, as_theirs, theirs = (statistics.median(times[name]) for name in runs)
print(
    f"{ROOMS:>7} rooms: a stored route {ours:.2f} ms with all columns, {as_theirs:.2f} ms with those of pgRouting, "
    f"which takes {theirs:.1f} ms: {theirs / as_theirs:.0f} times as long",
    flush=True,
)

"""Asks the views of a site by DuckDB and by SQLite so many times; prints of each view how many rows it has, and fails where the two
answer differently. `duck.py DATABASE ROUNDS`

DuckDB gives the columns of a view as text where it hands the view to SQLite, having no such functions itself: those of AS_TEXT."""
import glob
import json
import os
import sqlite3
import sys

import duckdb
import duckdb_extension_sqlite_scanner

QUERIES = {
    "action_sequence": "SELECT * FROM {}action_sequence WHERE start = 'home' ORDER BY robot, goal, step",
    "waypoints": "SELECT * FROM {}waypoints WHERE start = 'home' ORDER BY robot, goal, waypoint",
    "route": "SELECT * FROM {}route WHERE status <> 'not_kept' ORDER BY robot, start, goal",
    "routes": "SELECT * FROM {}routes ORDER BY robot, start, room",
    "prime_areas": "SELECT * FROM {}prime_areas ORDER BY area",
    "spaces": "SELECT * FROM {}spaces ORDER BY space",
    "map_rooms": "SELECT fid, name, state, hardness FROM {}map_rooms ORDER BY fid",
}
AS_TEXT = ["action_sequence", "waypoints", "route", "prime_areas", "map_rooms"]


def plain(value):
    """A text of SQLite has 15 digits of a number, and sums of such are taken in another order."""
    if isinstance(value, str) and value.startswith("{"):
        return str(sorted((name, plain(part)) for name, part in json.loads(value).items()))
    try:
        return f"{float(value):.9g}"
    except (TypeError, ValueError):
        return str(value)


database, rounds = sys.argv[1], int(sys.argv[2])
extension = os.path.join(os.path.dirname(duckdb_extension_sqlite_scanner.__file__), "extensions/*/*.duckdb_extension")
duck = duckdb.connect()
duck.execute(f"LOAD '{glob.glob(extension)[0]}'")
seen = {}
for round in range(rounds):
    duck.execute(f"ATTACH '{database}' AS site{round} (TYPE sqlite, READ_ONLY)")
    for view, query in QUERIES.items():
        rows = duck.execute(query.format(f"site{round}.")).fetchall()
        seen[view] = len(rows)
        if rounds == 1:
            lite = sqlite3.connect(f"file:{database}?mode=ro", uri=True)
            others = lite.execute(query.format("")).fetchall()
            if view in AS_TEXT:
                rows, others = (sorted([plain(value) for value in row] for row in some) for some in (rows, others))
            assert rows == others, view
    duck.execute(f"DETACH site{round}")
print(json.dumps(seen))

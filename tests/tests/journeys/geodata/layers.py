"""Reads the layers of a site so many times, as QGIS does, by GDAL; prints of each how many features it has, their type, and how
many corners differ from those of the table rooms."""
import json
import sqlite3
import struct
import sys
import warnings

import pyogrio

warnings.simplefilter("ignore")
database, rounds = sys.argv[1], int(sys.argv[2])


def ring(wkb):
    """The outer ring of a polygon, without the last corner, which is the first again."""
    count = struct.unpack_from("<I", wkb, 9)[0]
    numbers = struct.unpack_from(f"<{2 * count}d", wkb, 13)
    return [list(numbers[at : at + 2]) for at in range(0, len(numbers), 2)][:-1]


def outlines():
    rows = sqlite3.connect(f"file:{database}?mode=ro", uri=True, timeout=60).execute(
        "SELECT outline, x0, y0, x1, y1 FROM rooms ORDER BY room")
    for outline, x0, y0, x1, y1 in rows:
        yield json.loads(outline) if outline else [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]


seen = {}
for _ in range(rounds):
    for layer, kind in pyogrio.list_layers(f"GPKG:{database}"):
        if kind is None:
            continue
        _, _, shapes, _ = pyogrio.raw.read(f"GPKG:{database}", layer=layer)
        different = 0
        if layer == "map_rooms":
            different = sum(ring(bytes(shape)) != corners for shape, corners in zip(shapes, outlines(), strict=True))
        seen[layer] = {"kind": kind, "features": len(shapes), "different": different}
print(json.dumps(seen))

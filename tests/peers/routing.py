#!/usr/bin/env python3
"""routing.py starts GRAPH KEEP | measure GRAPH KEEP SITE.db

starts: the first KEEP different starts of the peers' pairs. measure: one route with all columns of action_sequence,
and the peers' query of SpatiaLite's VirtualRouting (GRAPH/spatialite.db, made by their bench.py), on the same pairs in
turns: CPU time of the process, the least of PASSES for each pair, and of those the median."""
import array, gc, os, sqlite3, sys, time

PASSES, PAIRS = 4, 400
OURS = "SELECT * FROM action_sequence WHERE start = ? AND goal = ? ORDER BY step"
THEIRS = (
    "SELECT r.RouteRow, d.action, d.id, r.NodeTo, r.Cost FROM net r CROSS JOIN door d ON d.rowid = r.LinkRowid "
    "WHERE r.NodeFrom = ? AND r.NodeTo = ?"
)


def pairs(graph):
    words = array.array("I")
    with open(graph + "/pairs.u32", "rb") as file:
        words.frombytes(file.read())
    return list(zip(words[::2], words[1::2]))


def starts(graph, keep):
    return list(dict.fromkeys(start for start, _ in pairs(graph)))[:keep]


def questions(graph, keep):
    kept = starts(graph, keep)
    return [(kept[i % len(kept)], goal) for i, (_, goal) in enumerate(pairs(graph)[:PAIRS])]


def measure(graph, keep, site):
    asked = questions(graph, keep)
    view = sqlite3.connect(f"file:{site}?mode=ro", uri=True)
    net = sqlite3.connect(graph + "/spatialite.db")
    net.enable_load_extension(True)
    net.load_extension("mod_spatialite")
    tools = [
        (lambda start, goal: view.execute(OURS, (f"r{start}", f"r{goal}")).fetchall()),
        (lambda start, goal: net.execute(THEIRS, (start, goal)).fetchall()),
    ]
    for start, goal in asked[:50]:
        steps, links = (tool(start, goal) for tool in tools)
        assert sum(link[4] for link in links) == steps[-1][9], (start, goal)
    least = [[1e9] * len(asked) for _ in tools]
    gc.disable()
    for _ in range(PASSES):
        for tool, times in zip(tools, least):
            for i, pair in enumerate(asked):
                begin = time.process_time()
                tool(*pair)
                times[i] = min(times[i], (time.process_time() - begin) * 1e6)
    ours, theirs = (sorted(times)[len(times) // 2] for times in least)
    rooms = graph.rsplit("/", 1)[1]
    print(
        f"{rooms:>7} rooms: the view takes {ours:.0f} us, SpatiaLite {theirs:.0f} us: "
        f"{ours / theirs:.2f} of its time, {theirs / ours:.1f} times as fast",
        flush=True,
    )
    sys.stdout.flush()
    os._exit(0)  # the module is known to crash when it is unloaded


if __name__ == "__main__":
    if sys.argv[1] == "starts":
        print(*starts(sys.argv[2], int(sys.argv[3])))
    else:
        measure(sys.argv[2], int(sys.argv[3]), sys.argv[4])

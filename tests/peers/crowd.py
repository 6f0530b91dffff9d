#!/usr/bin/env python3
"""What tests/peers/crowd.sh measures: `crowd.py ADIT CLINIC`."""

import collections
import http.client
import json
import os
import random
import re
import signal
import subprocess
import sys
import threading
import time
from urllib.parse import quote

ADIT, SITE = sys.argv[1:3]
SMALLEST = "SMALLEST" in os.environ
QUESTIONS, CROWD = (20, 4) if SMALLEST else (400, 16)
PLACES = [quote(place) for place in ("dock", "lobby", "pharmacy", "ward 9", "ward 12", "archive", "chapel", "lab", "kitchen")]
ENDLESS = json.dumps({"query": "WITH RECURSIVE c (x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c) SELECT count(*) FROM c"})


def between(chance):
    start, goal = chance.sample(PLACES, 2)
    return f"start={start}&goal={goal}"


KINDS = {
    "routes": lambda chance: (f"/api/route?{between(chance)}", None),
    "maps": lambda chance: ("/api/map", None),
    "floor": lambda chance: ("/api/floor", None),
    "why-not": lambda chance: (f"/api/why-not?{between(chance)}&through={chance.choice(PLACES)}", None),
    "how firm": lambda chance: (f"/api/firm?{between(chance)}", None),
    "slow SQL": lambda chance: ("/api/sql", ENDLESS),
}


def token(name):
    said = subprocess.run([ADIT, "token", SITE, "add", name, "--role", "admin"], check=True, capture_output=True, text=True)
    return said.stdout.split()[-1]


class Caller:
    def __init__(self, address, token):
        self.address, self.token = address, token
        self.connection = None

    def ask(self, path, body=None):
        headers = {"Authorization": f"Bearer {self.token}"}
        if body is not None:
            headers["Content-Type"] = "application/json"
        if self.connection is None:
            self.connection = http.client.HTTPConnection(self.address, timeout=120)
        try:
            self.connection.request("GET" if body is None else "POST", path, body, headers)
            answer = self.connection.getresponse()
            answer.read()
            return answer.status
        except (http.client.HTTPException, OSError):
            self.connection.close()
            self.connection = None
            return 0


def others(address, token, times=QUESTIONS):
    """The 99th percentile of a caller who asks for one route after the other, ms."""
    chance, caller, took = random.Random(5), Caller(address, token), []
    for _ in range(times):
        began = time.perf_counter()
        status = caller.ask(f"/api/route?{between(chance)}")
        took.append((time.perf_counter() - began) * 1e3)
        assert status == 200, status
        time.sleep(0.005)
    took.sort()
    return took[int(len(took) * 0.99)]


def beside(address, tokens, kind):
    over, answers = threading.Event(), collections.Counter()

    def crowd(number):
        chance, caller = random.Random(number), Caller(address, tokens["crowd"])
        while not over.is_set():
            status = caller.ask(*KINDS[kind](chance))
            answers[status] += 1
            if status in (429, 503):
                time.sleep(0.02)

    threads = [threading.Thread(target=crowd, args=(number,), daemon=True) for number in range(CROWD)]
    for thread in threads:
        thread.start()
    time.sleep(0.2 if SMALLEST else 1)
    p99 = others(address, tokens["other"])
    over.set()
    for thread in threads:
        thread.join(20)
    return p99, answers


tokens = {name: token(name) for name in ("crowd", "other")}
service = subprocess.Popen([ADIT, "serve", SITE, "--listen", "127.0.0.1:0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
try:
    address = None
    while address is None:
        line = service.stdout.readline()
        assert line, "the service ended"
        found = re.search(r"127\.0\.0\.1:\d+", line)
        address = found and found.group(0)
    threading.Thread(target=service.stdout.read, daemon=True).start()
    others(address, tokens["other"], QUESTIONS // 4)
    for kind in list(KINDS)[: 2 if SMALLEST else None]:
        before = others(address, tokens["other"])
        p99, answers = beside(address, tokens, kind)
        after = others(address, tokens["other"])
        alone = (before + after) / 2
        said = ", ".join(f"{status or 'hung up on'}: {times}" for status, times in sorted(answers.items()))
        print(f"{kind:>9}: p99 alone {before:.1f} and {after:.1f} ms, beside the crowd {p99:.1f} ms: {p99 / alone:.2f} times ({said})", flush=True)
finally:
    service.send_signal(signal.SIGINT)
    service.wait()

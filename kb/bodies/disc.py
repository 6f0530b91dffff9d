#!/usr/bin/env python3
"""A round robot with a sonar that turns, on its own physics, as Adit hears it: lines of JSON over standard input and output.

python3 disc.py SITE X Y [--heading DEGREES] [--seed N] [--truth FILE]

SITE is the folder of a site, whose map.toml says what stands and hangs low, and whose robots.toml says what shapes there are.
A robot of yours has motors and sensors in the place of `Disc`; `serve` is all that it needs of the protocol.
"""

import argparse
import json
import math
import random
import sys
import tomllib
from pathlib import Path

PROTOCOL = 1
PERIOD_S = 0.1  # from one answer to `sense` to the next
DIRECTIONS = 120
AT_ONCE = 12  # so many of them in one answer
RANGE_M = 8.0
TURN_RAD_S = 1.5
SLIP = 0.01  # of each move, one part in a hundred
TREMBLE_RAD = 0.005  # of the heading, after a metre


class Refused(Exception):
    """What cannot be done, in words for who asked."""


class Disc:
    """The robot as it is: `x`, `y` and `heading` are the truth, `odometry` is what its wheels count."""

    def __init__(self, site, x, y, heading=0.0, seed=1):
        drawn = tomllib.loads((site / "map.toml").read_text())
        table = tomllib.loads((site / "robots.toml").read_text())
        self.shapes = {row["state"]: row for row in table["robots"] if row["width"] > 0}
        self.seconds = {(row["from_state"], row["to_state"]): row.get("seconds", 0) for row in table.get("changes", [])}
        edge = [0, 0, drawn["width"], drawn["depth"]]
        self.walls = [side for thing in [{"rect": edge}, *drawn.get("obstacle", [])] for side in sides(thing)]
        self.low = [(bridge["height"], sides(bridge)) for bridge in drawn.get("bridge", [])]
        self.x, self.y, self.heading = x, y, heading
        self.shape = next(iter(self.shapes))
        self.odometry = [0.0, 0.0, 0.0]
        self.time_s = 0.0
        self.task = None
        self.beam = 0
        self.contact = None
        self.touches = 0
        self.random = random.Random(seed)

    # What it is told to do: the latest command counts.

    def radius_m(self, shape=None):
        return self.shapes[shape or self.shape]["width"] / 2

    def stop(self):
        self.task = None

    def turn(self, by_rad):
        self.task = ("turn", by_rad)

    def move(self, distance_m, speed_m_s):
        slip = 1 + self.random.gauss(0, SLIP)
        self.task = ("move", distance_m, min(speed_m_s, self.shapes[self.shape].get("speed", 0.5)), slip)

    def change(self, shape):
        if shape not in self.shapes:
            raise Refused(f"there is no shape `{shape}`; there are {', '.join(self.shapes)}")
        self.task = ("change", shape, self.seconds.get((self.shape, shape), 0))

    # What it does in one period.

    def step(self):
        self.time_s += PERIOD_S
        if self.task is None:
            return
        kind, left, *more = self.task
        if kind == "change":
            seconds = more[0] - PERIOD_S
            self.task = ("change", left, seconds) if seconds > 1e-9 else None
            if self.task is None:
                self.shape = left
            return
        most = PERIOD_S * (TURN_RAD_S if kind == "turn" else more[0])
        now = max(-most, min(most, left))
        if kind == "turn":
            self.heading = wrapped(self.heading + now)
            self.count(0, now)
        else:
            now = self.go(now, more[1])
        left -= now
        is_done = abs(left) < 1e-9 or (kind == "move" and self.contact is not None and abs(now) < most)
        self.task = None if is_done else (kind, left, *more)

    def go(self, counted_m, slip):
        """Goes straight until something is touched; says how far the wheels turned."""
        heading = self.heading + self.random.gauss(0, TREMBLE_RAD) * math.sqrt(abs(counted_m))
        ahead = lambda share: (
            self.x + share * slip * counted_m * math.cos(heading),
            self.y + share * slip * counted_m * math.sin(heading),
        )
        free = lambda share: self.gap(*ahead(share))[0] >= 0 or self.gap(*ahead(share))[0] > self.gap(self.x, self.y)[0]
        share = 1.0
        if not free(1.0):
            low, high = 0.0, 1.0
            for _ in range(20):
                middle = (low + high) / 2
                low, high = (middle, high) if free(middle) else (low, middle)
            share = low
            self.touches += 1
        self.x, self.y = ahead(share)
        self.heading = wrapped(heading)
        gap, at = self.gap(self.x, self.y)
        self.contact = self.bearing(at) if gap < 0.002 else None
        self.count(share * counted_m, 0)
        return share * counted_m

    def count(self, metres, turn):
        x, y, heading = self.odometry
        self.odometry = [x + metres * math.cos(heading), y + metres * math.sin(heading), wrapped(heading + turn)]

    # What it feels and hears.

    def gap(self, x, y):
        """How far the rim is from what is nearest, and where that is."""
        height = self.shapes[self.shape]["height"]
        low = [side for above, around in self.low if height >= above for side in around]
        feet = [foot(x, y, side) for side in [*self.walls, *low]]
        nearest = min(feet, key=lambda at: math.hypot(at[0] - x, at[1] - y))
        return math.hypot(nearest[0] - x, nearest[1] - y) - self.radius_m(), nearest

    def bearing(self, at):
        return wrapped(math.atan2(at[1] - self.y, at[0] - self.x) - self.heading)

    def measure(self):
        readings = []
        for _ in range(AT_ONCE):
            bearing = wrapped(2 * math.pi * self.beam / DIRECTIONS)
            self.beam = (self.beam + 1) % DIRECTIONS
            echo = self.echo(self.heading + bearing)
            readings.append({"bearing_rad": bearing, "range_m": echo, "odometry": self.place()})
        return readings

    def echo(self, towards):
        cos, sin = math.cos(towards), math.sin(towards)
        hits = [hit(self.x, self.y, cos, sin, wall) for wall in self.walls]
        nearest = min((far for far in hits if far is not None), default=math.inf)
        measured = nearest * (1 + self.random.gauss(0, 0.005))
        return measured if measured <= RANGE_M else None

    def place(self):
        x, y, heading = self.odometry
        return {"x_m": x, "y_m": y, "heading_rad": heading}

    # What it says.

    def hello(self, protocol, shapes):
        if protocol != PROTOCOL:
            raise Refused(f"this body speaks protocol {PROTOCOL}, not {protocol}")
        for shape in shapes:
            if shape not in self.shapes:
                raise Refused(f"there is no shape `{shape}`; there are {', '.join(self.shapes)}")
        return {
            "type": "hello",
            "protocol": PROTOCOL,
            "shapes": [{"name": name, "radius_m": self.radius_m(name)} for name in self.shapes],
            "shape": self.shape,
            "directions": DIRECTIONS,
            "range_m": RANGE_M,
            "has_skirt": True,
        }

    def sense(self):
        self.step()
        return {
            "type": "sensed",
            "time_s": self.time_s,
            "odometry": self.place(),
            "readings": self.measure(),
            "contact": None if self.contact is None else {"bearing_rad": self.contact},
            "is_busy": self.task is not None,
            "shape": self.shape,
        }

    def bye(self):
        self.stop()
        return {"type": "bye"}


def wrapped(angle):
    return math.remainder(angle, 2 * math.pi)


def sides(thing):
    """The sides of a rectangle or a polygon, each as x0, y0, x1, y1."""
    if "rect" in thing:
        x0, y0, x1, y1 = thing["rect"]
        corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    else:
        corners = thing["polygon"]
    return [(*a, *b) for a, b in zip(corners, [*corners[1:], corners[0]])]


def foot(x, y, side):
    """The point of a side that is nearest."""
    x0, y0, x1, y1 = side
    square = (x1 - x0) ** 2 + (y1 - y0) ** 2
    share = ((x - x0) * (x1 - x0) + (y - y0) * (y1 - y0)) / square if square else 0
    share = max(0, min(1, share))
    return x0 + share * (x1 - x0), y0 + share * (y1 - y0)


def hit(x, y, cos, sin, side):
    """How far a beam goes until it meets a side; None where it does not."""
    x0, y0, x1, y1 = side
    across = cos * (y1 - y0) - sin * (x1 - x0)
    if across == 0:
        return None
    far = ((x0 - x) * (y1 - y0) - (y0 - y) * (x1 - x0)) / across
    share = ((x0 - x) * sin - (y0 - y) * cos) / across
    return far if far >= 0 and 0 <= share <= 1 else None


# The protocol: what each message has besides its type.
FIELDS = {
    "hello": {"protocol": int, "shapes": list},
    "stop": {},
    "turn": {"by_rad": float},
    "move": {"distance_m": float, "speed_m_s": float},
    "change": {"shape": str},
    "sense": {},
    "bye": {},
}


def read(line):
    """A message of Adit's: its type, and its fields."""
    try:
        message = json.loads(line)
    except ValueError as error:
        raise Refused(f"that is no JSON: {error}") from error
    kind = message.pop("type", None) if isinstance(message, dict) else None
    if kind not in FIELDS:
        raise Refused(f"unknown type {kind!r}, expected one of {', '.join(FIELDS)}")
    if set(message) != set(FIELDS[kind]):
        raise Refused(f"`{kind}` has {sorted(message)}, expected {sorted(FIELDS[kind])}")
    for name, wanted in FIELDS[kind].items():
        is_right = isinstance(message[name], (int, float) if wanted is float else wanted)
        if not is_right or isinstance(message[name], bool):
            raise Refused(f"`{name}` is {message[name]!r}, expected {wanted.__name__}")
    return kind, message


def serve(body, lines, say):
    """Answers each line with one line, until `bye`; where the lines end, the robot stops, too."""
    is_greeted = False
    for line in lines:
        try:
            kind, fields = read(line)
            if is_greeted == (kind == "hello") and kind != "bye":
                raise Refused("`hello` comes first, and once")
            answer = getattr(body, kind)(**fields) or {"type": "accepted"}
            is_greeted = True
        except Refused as why:
            kind, answer = "refused", {"type": "refused", "why": str(why)}
        say(json.dumps(answer, allow_nan=False))
        if kind == "bye":
            break
    body.stop()


def arguments():
    parser = argparse.ArgumentParser(description="a round robot on its own physics, for Adit to drive")
    parser.add_argument("site", type=Path)
    parser.add_argument("x", type=float)
    parser.add_argument("y", type=float)
    parser.add_argument("--heading", type=float, default=0.0, help="degrees")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--truth", type=Path, help="where the robot really is at the end is written down here")
    return parser


def main(make=Disc, given=None):
    given = given or arguments().parse_args()
    body = make(given.site, given.x, given.y, math.radians(given.heading), given.seed)
    serve(body, sys.stdin, lambda text: print(text, flush=True))
    if given.truth:
        truth = {"x": body.x, "y": body.y, "shape": body.shape, "radius": body.radius_m(), "touches": body.touches}
        given.truth.write_text(json.dumps(truth))


if __name__ == "__main__":
    main()

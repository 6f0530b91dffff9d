#!/usr/bin/env python3
"""The body of kb/bodies/disc.py with a fault: python3 faulty.py FAULT SITE X Y ..."""

import math
import os
import random
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "kb" / "bodies"))
import disc  # noqa: E402

MISSION_S = 5.0  # when what befalls a mission does


def turned(senses, of):
    """What was sensed, with another angle for each."""
    senses["odometry"]["heading_rad"] = of(senses["odometry"]["heading_rad"])
    for reading in senses["readings"]:
        reading["bearing_rad"] = of(reading["bearing_rad"])
    return senses


class degrees(disc.Disc):
    def sense(self):
        return turned(super().sense(), math.degrees)


class clockwise_turns(disc.Disc):
    def turn(self, by_rad):
        super().turn(-by_rad)


class half_turns(disc.Disc):
    def turn(self, by_rad):
        super().turn(by_rad / 2 if by_rad < 0 else by_rad)


class clockwise_bearings(disc.Disc):
    def sense(self):
        senses = super().sense()
        for reading in senses["readings"]:
            reading["bearing_rad"] = -reading["bearing_rad"]
        return senses


class looks_back(disc.Disc):
    def sense(self):
        senses = super().sense()
        for reading in senses["readings"]:
            reading["bearing_rad"] = disc.wrapped(reading["bearing_rad"] + math.pi)
        return senses


class half_blind(disc.Disc):
    def sense(self):
        senses = super().sense()
        senses["readings"] = [one for one in senses["readings"] if one["bearing_rad"] >= 0]
        return senses


class millimetres(disc.Disc):
    def place(self):
        place = super().place()
        return {"x_m": 1000 * place["x_m"], "y_m": 1000 * place["y_m"], "heading_rad": place["heading_rad"]}


class never_back(disc.Disc):
    def move(self, distance_m, speed_m_s):
        super().move(abs(distance_m), speed_m_s)


class too_fast(disc.Disc):
    def move(self, distance_m, speed_m_s):
        super().move(distance_m, 3 * speed_m_s)


class never_idle(disc.Disc):
    def sense(self):
        senses = super().sense()
        senses["is_busy"] = self.is_begun = getattr(self, "is_begun", False) or senses["is_busy"]
        return senses


class ignores_stop(disc.Disc):
    def stop(self):
        pass


class queues(disc.Disc):
    """Does one thing after the other, whatever it is told."""

    def __init__(self, *given):
        self.waiting = []
        super().__init__(*given)

    def __setattr__(self, name, value):
        if name == "task" and value is not None and getattr(self, "task", None) is not None and not self.is_stepping:
            self.waiting.append(value)
        else:
            object.__setattr__(self, name, value)

    is_stepping = False

    def step(self):
        self.is_stepping = True
        super().step()
        if self.task is None and self.waiting:
            self.task = self.waiting.pop(0)
        self.is_stepping = False


class other_shape(disc.Disc):
    def sense(self):
        senses = super().sense()
        if senses["shape"] == "SQUAT":
            senses["shape"] = "STAND"
        return senses


class no_such_shape(disc.Disc):
    def sense(self):
        senses = super().sense()
        if self.shape == "SQUAT":
            senses["shape"] = "LIE"
        return senses


class through_contact(disc.Disc):
    def go(self, counted_m, slip):
        self.contact = None
        self.x += slip * counted_m * math.cos(self.heading)
        self.y += slip * counted_m * math.sin(self.heading)
        gap, at = self.gap(self.x, self.y)
        if gap < 0:
            self.felt = self.bearing(at)
        self.count(counted_m, 0)
        return counted_m

    felt = None

    def sense(self):
        senses = super().sense()
        if self.felt is not None:
            senses["contact"] = {"bearing_rad": self.felt}
            self.felt = None
        return senses


class feels_nothing(disc.Disc):
    def sense(self):
        return {**super().sense(), "contact": None}


class time_goes_back(disc.Disc):
    def sense(self):
        senses = super().sense()
        return {**senses, "time_s": senses["time_s"] - (1 if 4.05 < senses["time_s"] < 4.15 else 0)}


class stale_readings(disc.Disc):
    def sense(self):
        senses = super().sense()
        for reading in senses["readings"]:
            reading["odometry"] = {"x_m": 0.0, "y_m": 0.0, "heading_rad": 0.0}
        return senses


class too_far(disc.Disc):
    def hello(self, protocol, shapes):
        return {**super().hello(protocol, shapes), "range_m": 2.0}


class begins_elsewhere(disc.Disc):
    def __init__(self, *given):
        super().__init__(*given)
        self.odometry = [3.0, -1.0, 0.7]


class other_version(disc.Disc):
    def hello(self, protocol, shapes):
        return {**super().hello(protocol, shapes), "protocol": 2}


class any_version(disc.Disc):
    def hello(self, protocol, shapes):
        return super().hello(disc.PROTOCOL, shapes)


class late(disc.Disc):
    def turn(self, by_rad):
        time.sleep(5)
        super().turn(by_rad)


class mute(disc.Disc):
    def turn(self, by_rad):
        time.sleep(3600)


class talks(disc.Disc):
    def sense(self):
        if 2 < self.time_s < 2.15:
            print('{"type":"accepted"}', flush=True)
        return super().sense()


class stays(disc.Disc):
    def bye(self):
        print('{"type":"bye"}', flush=True)
        time.sleep(3600)


class wide(disc.Disc):
    def radius_m(self, shape=None):
        return 2 * super().radius_m(shape)


# What befalls a mission.


class falls_silent(disc.Disc):
    def sense(self):
        if self.time_s > MISSION_S:
            time.sleep(3600)
        return super().sense()


class exits(disc.Disc):
    def sense(self):
        if self.time_s > MISSION_S:
            os._exit(3)
        return super().sense()


def says(text):
    """A body that at some time says this instead of what it senses."""

    class Says(disc.Disc):
        def sense(self):
            if self.time_s > MISSION_S:
                print(text(super().sense()), end="", flush=True)
                time.sleep(0.3)
                os._exit(0)
            return super().sense()

    return Says


nan = says(lambda senses: disc.json.dumps({**senses, "time_s": math.nan}) + "\n")
text = says(lambda senses: "I am at the door\n")
half_a_line = says(lambda senses: disc.json.dumps(senses)[:40])
endless = says(lambda senses: "x" * 3_000_000)
many_readings = says(lambda senses: disc.json.dumps({**senses, "readings": senses["readings"] * 50}) + "\n")


def serve_badly(body, lines, say):
    """Dies of what it does not know."""

    def known():
        for line in lines:
            if "dance" in line:
                sys.exit(4)
            yield line

    disc.serve(body, known(), say)


class dies_of_the_unknown(disc.Disc):
    pass


if __name__ == "__main__":
    fault = sys.argv.pop(1)
    if fault == "dies_of_the_unknown":
        given = disc.arguments().parse_args()
        body = disc.Disc(given.site, given.x, given.y)
        serve_badly(body, sys.stdin, lambda line: print(line, flush=True))
    else:
        disc.main(globals()[fault])

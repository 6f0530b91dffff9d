"""A ROS 2 client that does what it is told, a JSON object a line, and says what it hears in the same way."""

import importlib
import itertools
import json
import random
import sys
import threading

import rclpy
from rclpy.action import ActionClient
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.serialization import serialize_message

LOCK = threading.Lock()

# All clients of a service hear all its answers and drop those to others, after these came into a queue of ten: too few where many
# ask at once. A node that waits for nothing is not spun, so that its queue is full of them: a long one would take longest to read
# when its answer comes.
SERVICES = QoSProfile(depth=20)


def say(what):
    with LOCK:
        print(json.dumps(what), flush=True)


def kind(name):
    package, folder, last = name.split("/")
    return getattr(importlib.import_module(f"{package}.{folder}"), last)


def written(value):
    """A message as JSON; long rows of numbers as pairs of a number and how often it comes."""
    if hasattr(value, "get_fields_and_field_types"):
        return {field: written(getattr(value, field)) for field in value.get_fields_and_field_types()}
    if isinstance(value, (str, bool, int, float)):
        return value
    if len(value) > 1000:
        return [[int(key), len(list(same))] for key, same in itertools.groupby(value)]
    return [written(one) for one in value]


def fill(message, fields):
    types = message.get_fields_and_field_types()
    for field, value in fields.items():
        if isinstance(value, dict):
            fill(getattr(message, field), value)
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            package, last = types[field].removeprefix("sequence<").removesuffix(">").split("/")
            setattr(message, field, [fill(kind(f"{package}/msg/{last}")(), one) for one in value])
        elif types[field] in ("double", "float"):
            setattr(message, field, float(value))
        else:
            setattr(message, field, value)
    return message


class Client:
    """One node or several; orders go round among them. Of several only those are spun that wait for an answer."""

    def __init__(self, name, count, executor):
        self.nodes = [rclpy.create_node(f"{name}_{index}") for index in range(count)]
        self.node = self.nodes[0]
        self.executor = executor
        self.made = {}
        self.goals = {}
        self.waits = {}
        if count == 1:
            executor.add_node(self.node)

    def do(self, told):
        self.node = self.nodes[told["id"] % len(self.nodes)]
        self.wait(told["id"])
        getattr(self, told["do"])(told)

    def wait(self, order):
        if len(self.nodes) > 1:
            self.waits[order] = self.node
            self.executor.add_node(self.node)

    def last(self, what):
        """Says what ends an order."""
        say(what)
        node = self.waits.pop(what["id"], None)
        if node is not None and node not in self.waits.values():
            self.executor.remove_node(node)

    def once(self, key, make):
        key = (self.node, key)
        if key not in self.made:
            self.made[key] = make()
        return self.made[key]

    def qos(self, told):
        profile = QoSProfile(depth=1 if told.get("latched") else 100)
        if told.get("latched"):
            profile.durability = DurabilityPolicy.TRANSIENT_LOCAL
        return profile

    def call(self, told):
        service = kind(told["type"])
        client = self.once(told["name"], lambda: self.node.create_client(service, told["name"], qos_profile=SERVICES))
        assert client.wait_for_service(20), "no such service"
        ended = client.call_async(fill(service.Request(), told["message"]))
        ended.add_done_callback(lambda done: self.last({"id": told["id"], "response": written(done.result())}))

    def goal(self, told):
        action = kind(told["type"])
        services = [f"{name}_service_qos_profile" for name in ("goal", "result", "cancel")]
        make = lambda: ActionClient(self.node, action, told["name"], **dict.fromkeys(services, SERVICES))
        client = self.once(told["name"], make)
        assert client.wait_for_server(20), "no such action"

        def ended(done):
            self.last({"id": told["id"], "status": done.result().status, "result": written(done.result().result)})

        def accepted(done):
            handle = done.result()
            self.goals[told["id"]] = handle
            say({"id": told["id"], "accepted": handle.accepted})
            if handle.accepted:
                handle.get_result_async().add_done_callback(ended)

        def feedback(message):
            say({"id": told["id"], "feedback": written(message.feedback)})

        client.send_goal_async(fill(action.Goal(), told["message"]), feedback).add_done_callback(accepted)

    def cancel(self, told):
        ended = self.goals[told["goal"]].cancel_goal_async()
        ended.add_done_callback(lambda done: say({"id": told["id"], "code": done.result().return_code}))

    def publish(self, told):
        message = kind(told["type"])
        make = lambda: self.node.create_publisher(message, told["name"], self.qos(told))
        self.once(("to", told["name"]), make).publish(fill(message(), told["message"]))

    def noise(self, told):
        """Publishes bytes that are nearly such a message, so many times."""
        message, chance = kind(told["type"]), random.Random(told["seed"])
        make = lambda: self.node.create_publisher(message, told["name"], self.qos(told))
        publisher = self.once(("to", told["name"]), make)
        good = serialize_message(fill(message(), told["message"]))
        for _ in range(told["count"]):
            bad = bytearray(good)
            for _ in range(chance.randint(1, 6)):
                # the first four bytes say how the others are written
                at = chance.randrange(4, len(bad)) if len(bad) > 4 else 0
                change = chance.randrange(6)
                if change == 0 and len(bad) > 12:
                    del bad[at:]
                elif change == 1:
                    bad[at:at] = bytes(chance.randrange(256) for _ in range(chance.randrange(40)))
                elif change == 2:
                    bad[at : at + 4] = chance.choice([b"\xff\xff\xff\xff", b"\0\0\0\0", b"\xff\xff\xff\x7f", b"\0\0\x80\x7f", b"\0\0\0\x10"])
                elif change == 3:
                    bad[at : at + 8] = chance.choice([b"\0\0\0\0\0\0\xf8\x7f", b"\0\0\0\0\0\0\xf0\xff", b"\xff" * 6 + b"\xef\x7f"])
                else:
                    bad[at % len(bad)] ^= 1 << chance.randrange(8)
            publisher.publish(bytes(bad))
        self.last({"id": told["id"], "published": told["count"]})

    def keep(self, told):
        """Publishes ten times a second from now on, as a robot does that says where it is."""
        key = ("kept", told["name"])
        if (before := self.made.pop((self.node, key), None)) is not None:
            self.node.destroy_timer(before)
        self.publish(told)
        self.once(key, lambda: self.node.create_timer(0.1, lambda: self.publish(told)))

    def hear(self, told):
        message = kind(told["type"])
        heard = lambda what: say({"topic": told["name"], "message": written(what)})
        self.once(("from", told["name"]), lambda: self.node.create_subscription(message, told["name"], heard, self.qos(told)))


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    client = Client(sys.argv[1], int(sys.argv[2]), executor)

    def spin():
        try:
            executor.spin()
        except ExternalShutdownException:
            pass

    spinning = threading.Thread(target=spin)
    spinning.start()
    say({"is": "there"})

    def do(told):
        try:
            client.do(told)
        except Exception as error:
            say({"id": told.get("id"), "error": repr(error)})

    # in the thread that spins: what rclpy's action clients are told in another one gets lost now and then (ros2/rclpy#1123)
    for line in sys.stdin:
        executor.create_task(do, json.loads(line))
    rclpy.shutdown()
    spinning.join()


main()

"""Lock-step with uwsim for nodes of rclpy: simulation time waits for what a node computes.

Copy this file next to your node. It needs rclpy and std_msgs, and nothing of uwsim.

    class Tracker:
        def __init__(self, lockstep):
            self.publish = lockstep.publisher("/cornersTopic", Float32MultiArray)
            lockstep.subscribe("/uwsim/camera1", Image, self.look)
            lockstep.call("startBench")
        def look(self, image): ...

    lockstep.run("tracker", Tracker)

and `uwsim bench visibility --ros2 --client tracker`. For each trial there is a new node and a new
Tracker. Its callbacks are called in the order in which the simulation published, once all messages
of a step are there; whatever they publish takes effect in the same step. Services that the
simulation calls (`autoInit`) are offered by `LockStep.serve`.
"""

import contextlib
import json
import os
import secrets
import sys
import time

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String

JOIN, TICK, ACK = (f"/uwsim/lockstep/{name}" for name in ("join", "tick", "ack"))
DEPTH = 100
WHOLE = QoSProfile(depth=DEPTH, durability=DurabilityPolicy.TRANSIENT_LOCAL)
"""With its history: nothing is lost while both ends get to know each other."""
GLANCE = 0.05
"""How often a node looks whether the simulation is still there [s]."""


class LockStep:
    """What an algorithm sees of the simulation: topics, and the time of the tick."""

    def __init__(self, node: Node, client: str, period: float) -> None:
        self.node, self.now = node, 0.0
        self._client, self._period = client, period
        self._who = {
            "client": client,
            "id": secrets.token_hex(4),
        }  # of two of one name one is heard
        self._callbacks, self._waiting, self._arrived, self._published = {}, {}, {}, {}
        self._calls, self._publishers, self._ticks, self._types = [], [], [], {}
        self._handlers, self._services, self._timers = {}, {}, []
        self.run, self.next_run = "", ""
        self.before_answer = lambda: None  # called before each answer; a test lets it sleep
        self._join = self._publisher(JOIN, String)
        self._ack = self._publisher(ACK, String)
        node.create_subscription(String, TICK, self._on_tick, WHOLE)

    def subscribe(self, topic: str, kind: type, callback, *, raw: bool = False) -> None:
        """Have a callback called with each message of a topic; ``raw``: with its bytes (CDR)."""
        self._callbacks.setdefault(topic, []).append(callback)
        if topic in self._waiting:
            return
        self._waiting[topic], self._arrived[topic] = [], 0

        def receive(message) -> None:
            self._waiting[topic].append(message)
            self._arrived[topic] += 1

        self.node.create_subscription(kind, topic, receive, DEPTH, raw=raw)

    def publisher(self, topic: str, kind: type):
        """Return ``publish(message)``."""
        out = self._publisher(topic, kind)
        self._published[topic] = 0
        package, part, _ = kind.__module__.split(".")
        self._types[topic] = f"{package}/{part}/{kind.__name__}"

        def publish(message) -> None:
            self._published[topic] += 1
            out.publish(message)

        return publish

    def call(self, service: str) -> None:
        """Call a service of std_srvs/Empty with the next answer, as ``startBench``."""
        self._calls.append(service)

    def serve(self, service: str, kind: str, handler) -> None:
        """Offer a service to the simulation, with requests and responses as dicts.

        They come by the topics of lock-step: its type (``package/srv/Name``) need not be
        installed, and it does not matter which DDS the node uses.
        """
        self._services[service], self._handlers[service] = kind, handler

    def every(self, period: float, callback) -> None:
        """Have a callback called every ``period`` [s] of simulation time."""
        self._timers.append(([self.now, period, 0], callback))

    def is_connected(self) -> bool:
        """Whether every topic has its other end, but for those that the algorithm publishes."""
        return all(each.get_subscription_count() for each in (self._join, self._ack)) and all(
            self.node.count_publishers(topic) for topic in (TICK, *self._callbacks)
        )

    def join(self) -> None:
        """Tell the simulation to wait for this client from now on."""
        self.run = self.next_run
        topics, more = list(self._callbacks), self._next(0.0)
        if secret := os.environ.get("UWSIM_CLIENT_SECRET"):  # if the simulation was given one
            more["secret"] = secret
        self._say(self._join, topics=topics, publishes=self._types, services=self._services, **more)

    def answer(self) -> None:
        """Answer the tick for which all messages are there, if there is one."""
        if not self._ticks or not all(o.get_subscription_count() for o in self._publishers):
            return
        tick = self._ticks[0]
        if "call" in tick:
            self._ticks.pop(0)
            values = self._handlers[tick["service"]](tick["args"])
            self._say_done(call=tick["call"], values=values)
            return
        if any(self._arrived.get(topic, 0) < n for topic, n in named(tick["sent"]).items()):
            return
        self._ticks.pop(0)
        self.now = tick["time"]
        for topic in tick["order"]:  # in which they came on the bus
            message = self._waiting[topic].pop(0)
            for callback in self._callbacks[topic]:
                callback(message)
        for timer, callback in self._timers:
            if self.now >= due(timer):
                timer[2] += 1
                callback()
        self._say_done(tick=tick["tick"], **self._next(self.now + self._period))

    def _say_done(self, **content) -> None:
        """Let the simulation go on, when it has what was published meanwhile."""
        self.before_answer()
        calls, self._calls = self._calls, []
        self._say(self._ack, published=self._published, calls=calls, **content)

    def _next(self, time: float) -> dict:
        """Wish for a tick at a time at the latest, whether there are messages or not."""
        times = [due(timer) for timer, _ in self._timers]
        times += [time] if self._period > 0.0 else []
        return {"next": max(0.0, min(times))} if times else {}

    def _on_tick(self, message: String) -> None:
        tick = json.loads(message.data)
        if tick.get("client") != self._client:
            return
        is_meant = tick.get("id") == self._who["id"]  # else another of this name is
        if "error" in tick and tick["run"] == self.run and is_meant:
            raise SystemExit(f"{self._client}: {tick['error']}")
        if tick.get("tick") == 0:  # a simulation invites
            self.next_run = tick["run"]
        elif tick["run"] == self.run and "error" not in tick:
            self._ticks.append(tick)

    def _publisher(self, topic: str, kind: type):
        self._publishers.append(self.node.create_publisher(kind, topic, WHOLE))
        return self._publishers[-1]

    def _say(self, out, **content) -> None:
        out.publish(String(data=json.dumps({**self._who, "run": self.run, **content})))


def due(timer: list) -> float:
    """Return when a timer is due next [s]."""
    start, period, n = timer
    return start + n * period - 1e-9 * period


def named(counts: dict) -> dict:
    """Give topics their leading slash."""
    return {f"/{topic.lstrip('/')}": n for topic, n in counts.items()}


def run(client: str, algorithm, *, period: float = 0.0, patience: float = 60.0) -> None:
    """Take part in trial after trial, until none has begun for some time.

    Args:
        client: the name that `uwsim bench --client` has.
        algorithm: is called with a LockStep for each trial.
        period: longest time between two ticks [s of simulation time]; 0: only with messages.
        patience: how long to wait for a simulation [s].
    """
    rclpy.init()
    before = ""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        before = take_part(client, algorithm, period, patience)
    if not before:
        sys.exit(f"{client}: took part in no trial; no simulation has invited it.")
    rclpy.try_shutdown()


def take_part(client: str, algorithm, period: float, patience: float) -> str:
    """Take part in trial after trial; returns what tells the last, empty if there was none."""
    before = ""
    while (lockstep := begin(client, algorithm, period, patience, before)) is not None:
        before = lockstep.run
        while lockstep.next_run == before and lockstep.is_connected():
            until = time.monotonic() + GLANCE
            while time.monotonic() < until:
                rclpy.spin_once(lockstep.node, timeout_sec=GLANCE)
                lockstep.answer()
        lockstep.node.destroy_node()
    return before


def begin(client: str, algorithm, period: float, patience: float, before: str):
    """Wait for a simulation that is not the one before, and join it; None: there is none."""
    node = Node(client)
    lockstep = LockStep(node, client, period)
    algorithm(lockstep)
    until = time.monotonic() + patience
    while time.monotonic() < until:
        rclpy.spin_once(node, timeout_sec=GLANCE)
        if lockstep.next_run not in ("", before) and lockstep.is_connected():
            lockstep.join()
            return lockstep
    node.destroy_node()
    return None


if __name__ == "__main__":
    print(__doc__)

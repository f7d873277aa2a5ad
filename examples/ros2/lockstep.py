"""Lock-step with uwsim for nodes of rclpy: simulation time waits for the node.

Copy this file next to your node. It needs rclpy and std_msgs, and nothing of uwsim.

    class Tracker:
        def __init__(self, lockstep):
            self.publish = lockstep.publisher("/cornersTopic", Float32MultiArray)
            lockstep.subscribe("/uwsim/camera1", Image, self.track)
            lockstep.call("startBench")
        def track(self, image): ...

    lockstep.run("tracker", Tracker)

and `uwsim bench visibility --ros2 --client tracker`. Each trial has a new node and a new
Tracker. Its callbacks run in the order of publication, once all messages of a step have arrived.
Messages that they publish take effect in the same step. `LockStep.serve` offers services that the
simulation calls (`autoInit`).
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
RELIABLE_HISTORY = QoSProfile(depth=DEPTH, durability=DurabilityPolicy.TRANSIENT_LOCAL)
"""The quality of service of lock-step: late subscribers receive earlier messages."""
POLL_INTERVAL = 0.05
"""The interval of checks of the connections [s]."""


class LockStep:
    """The interface of an algorithm to the simulation: topics, services, timers and time."""

    def __init__(self, node: Node, client: str, period: float) -> None:
        self.node, self.now = node, 0.0
        self._client, self._period = client, period
        self._identity = {
            "client": client,
            "id": secrets.token_hex(4),
        }  # distinguishes two clients of one name
        self._callbacks, self._queues, self._n_arrived, self._n_published = {}, {}, {}, {}
        self._calls, self._publishers, self._ticks, self._types = [], [], [], {}
        self._handlers, self._services, self._timers = {}, {}, []
        self.run, self.next_run = "", ""
        self.before_answer = lambda: None  # called before each answer, for example to delay it
        self._join = self._make_publisher(JOIN, String)
        self._ack = self._make_publisher(ACK, String)
        node.create_subscription(String, TICK, self._on_tick, RELIABLE_HISTORY)

    def subscribe(self, topic: str, kind: type, callback, *, is_raw: bool = False) -> None:
        """Call a callback with each message of a topic; with its bytes (CDR) if ``is_raw``."""
        self._callbacks.setdefault(topic, []).append(callback)
        if topic in self._queues:
            return
        self._queues[topic], self._n_arrived[topic] = [], 0

        def receive(message) -> None:
            self._queues[topic].append(message)
            self._n_arrived[topic] += 1

        self.node.create_subscription(kind, topic, receive, DEPTH, raw=is_raw)

    def publisher(self, topic: str, kind: type):
        """Return ``publish(message)``."""
        ros_publisher = self._make_publisher(topic, kind)
        self._n_published[topic] = 0
        package, part, _ = kind.__module__.split(".")
        self._types[topic] = f"{package}/{part}/{kind.__name__}"

        def publish(message) -> None:
            self._n_published[topic] += 1
            ros_publisher.publish(message)

        return publish

    def call(self, service: str) -> None:
        """Call a service of std_srvs/Empty with the next answer, as ``startBench``."""
        self._calls.append(service)

    def serve(self, service: str, kind: str, handler) -> None:
        """Offer a service to the simulation, with requests and responses as dicts.

        Requests arrive on the topics of lock-step. The type of the service (``package/srv/Name``)
        need not be installed, and the node may use any DDS.
        """
        self._services[service], self._handlers[service] = kind, handler

    def create_timer(self, period: float, callback) -> None:
        """Call a callback every ``period`` [s] of simulation time."""
        self._timers.append(([self.now, period, 0], callback))

    def is_connected(self) -> bool:
        """Return True if all topics are connected, except those that the algorithm publishes."""
        return all(
            publisher.get_subscription_count() for publisher in (self._join, self._ack)
        ) and all(self.node.count_publishers(topic) for topic in (TICK, *self._callbacks))

    def join(self) -> None:
        """Join the simulation, which waits for this client from now on."""
        self.run = self.next_run
        topics, fields = list(self._callbacks), self._next(0.0)
        if secret := os.environ.get("UWSIM_CLIENT_SECRET"):  # if the simulation has one
            fields["secret"] = secret
        self._publish_json(
            self._join, topics=topics, publishes=self._types, services=self._services, **fields
        )

    def answer(self) -> None:
        """Answer the next tick if all its messages have arrived."""
        if not self._ticks or not all(
            publisher.get_subscription_count() for publisher in self._publishers
        ):
            return
        tick = self._ticks[0]
        if "call" in tick:
            self._ticks.pop(0)
            values = self._handlers[tick["service"]](tick["args"])
            self._acknowledge(call=tick["call"], values=values)
            return
        if any(
            self._n_arrived.get(topic, 0) < n for topic, n in absolute_names(tick["sent"]).items()
        ):
            return
        self._ticks.pop(0)
        self.now = tick["time"]
        for topic in tick["order"]:  # the order of publication
            message = self._queues[topic].pop(0)
            for callback in self._callbacks[topic]:
                callback(message)
        for timer, callback in self._timers:
            if self.now >= due(timer):
                timer[2] += 1
                callback()
        self._acknowledge(tick=tick["tick"], **self._next(self.now + self._period))

    def _acknowledge(self, **content) -> None:
        """Let the simulation continue after it has received all published messages."""
        self.before_answer()
        calls, self._calls = self._calls, []
        self._publish_json(self._ack, published=self._n_published, calls=calls, **content)

    def _next(self, time: float) -> dict:
        """Return the latest time of the next tick [s], also without messages."""
        times = [due(timer) for timer, _ in self._timers]
        times += [time] if self._period > 0.0 else []
        return {"next": max(0.0, min(times))} if times else {}

    def _on_tick(self, message: String) -> None:
        tick = json.loads(message.data)
        if tick.get("client") != self._client:
            return
        is_meant = tick.get("id") == self._identity["id"]  # otherwise another client of this name
        if "error" in tick and tick["run"] == self.run and is_meant:
            raise SystemExit(f"{self._client}: {tick['error']}")
        if tick.get("tick") == 0:  # a simulation announces itself
            self.next_run = tick["run"]
        elif tick["run"] == self.run and "error" not in tick:
            self._ticks.append(tick)

    def _make_publisher(self, topic: str, kind: type):
        self._publishers.append(self.node.create_publisher(kind, topic, RELIABLE_HISTORY))
        return self._publishers[-1]

    def _publish_json(self, publisher, **content) -> None:
        publisher.publish(String(data=json.dumps({**self._identity, "run": self.run, **content})))


def due(timer: list) -> float:
    """Return when a timer is due next [s]."""
    start, period, n = timer
    return start + n * period - 1e-9 * period


def absolute_names(counts: dict) -> dict:
    """Return the counts with absolute topic names."""
    return {f"/{topic.lstrip('/')}": n for topic, n in counts.items()}


def run(client: str, algorithm, *, period: float = 0.0, timeout: float = 60.0) -> None:
    """Take part in all trials, until none starts within the timeout.

    Args:
        client: the name of `uwsim bench --client`.
        algorithm: called with a LockStep for each trial.
        period: the longest simulation time between two ticks [s]; 0: ticks only with messages.
        timeout: the longest wait for a simulation [s].
    """
    rclpy.init()
    last_run = ""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        last_run = take_part(client, algorithm, period, timeout)
    if not last_run:
        sys.exit(f"{client}: no simulation has announced a trial.")
    rclpy.try_shutdown()


def take_part(client: str, algorithm, period: float, timeout: float) -> str:
    """Take part in all trials; return the identifier of the last, empty if there was none."""
    last_run = ""
    while (lockstep := join_next_run(client, algorithm, period, timeout, last_run)) is not None:
        last_run = lockstep.run
        while lockstep.next_run == last_run and lockstep.is_connected():
            deadline = time.monotonic() + POLL_INTERVAL
            while time.monotonic() < deadline:
                rclpy.spin_once(lockstep.node, timeout_sec=POLL_INTERVAL)
                lockstep.answer()
        lockstep.node.destroy_node()
    return last_run


def join_next_run(client: str, algorithm, period: float, timeout: float, last_run: str):
    """Wait for the next simulation, and join it; return None after the timeout."""
    node = Node(client)
    lockstep = LockStep(node, client, period)
    algorithm(lockstep)
    deadline = time.monotonic() + timeout
    while time.monotonic() < deadline:
        rclpy.spin_once(node, timeout_sec=POLL_INTERVAL)
        if lockstep.next_run not in ("", last_run) and lockstep.is_connected():
            lockstep.join()
            return lockstep
    node.destroy_node()
    return None


if __name__ == "__main__":
    print(__doc__)

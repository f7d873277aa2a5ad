"""The cost of lock-step: a round trip with an algorithm outside the simulation's process.

Run ``python benchmarks/lockstep.py``. A controller gets an odometry message and answers with a
twist, 1000 times: one simulated control period at 100 Hz. The target is 0.5 ms of wall time.
"""

from __future__ import annotations

import importlib
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median

import numpy as np
from measure import main

from uwsim.base.rng import stream
from uwsim.bus import Bus, Node
from uwsim.messages import Image, Odometry, TwistStamped
from uwsim.middleware.admission import SingleProgram
from uwsim.middleware.lockstep.client import lockstep_clients
from uwsim.middleware.web.options import WebOptions
from uwsim.middleware.web.server import WebBridge
from uwsim.runs.own_process.process import OwnProcess, ProcessAlgorithm
from uwsim.simulation import InProcessNode

EXAMPLES = Path(__file__).parents[1] / "examples" / "websocket"
TIMESTEP = 0.002
CLIENT = """
import sys
sys.path.insert(0, sys.argv[1])
from lockstep import Client, open_connection
with open_connection(f"ws://127.0.0.1:{sys.argv[2]}") as socket:
    client = Client(socket, "controller")
    say = client.publisher("/twist", "geometry_msgs/TwistStamped")
    def answer(odometry):
        say({"twist": {"linear": {"x": -0.4 * odometry["pose"]["pose"]["position"]["x"]}}})
    client.subscribe("/odometry", answer)
    client.run()
"""
"""The same controller in a process without uwsim."""
TARGET_MS = 0.5
"""The target of a round trip [ms]."""
ROUNDS = 1000


class Controller:
    """An algorithm that answers each odometry message, and reads images."""

    def start(self, node: Node) -> None:
        """Connect to the bus."""
        self.publish = node.publisher("twist", TwistStamped)
        node.subscribe("odometry", Odometry, self.on_odometry)
        node.subscribe("image", Image, lambda message: None)

    def on_odometry(self, message: Odometry) -> None:
        """Command against the error."""
        answer = TwistStamped(header=message.header)
        answer.twist.linear.x = -0.4 * message.pose.pose.position.x
        self.publish(answer)


def measure_round_trips(bus: Bus, publish: Callable[[], None], rounds: int) -> list[float]:
    """Return the time of each publishing and delivering [ms]."""
    times = []
    for _ in range(rounds):
        bus.step += 5
        start_time = time.perf_counter_ns()
        publish()
        bus.deliver()
        times.append((time.perf_counter_ns() - start_time) / 1e6)
    return times


def summarize(times: list[float], target: float | None = None) -> dict[str, object]:
    """Return median and 95th percentile, and the fraction of the target."""
    figures: dict[str, object] = {
        "wall_ms": round(median(times), 4),
        "wall_ms_95": round(sorted(times)[int(0.95 * len(times))], 4),
        "rounds": len(times),
    }
    if target is not None:
        figures |= {"target_ms": target, "ratio": round(median(times) / target, 3)}
    return figures


def measure_own_process(rounds: int = ROUNDS) -> dict[str, object]:
    """Measure an algorithm in its own process."""
    bus = Bus()
    inbox = bus.inbox("twist", TwistStamped)
    start_time = time.perf_counter()
    with OwnProcess() as process:
        controller_class: type = importlib.import_module(
            "lockstep"
        ).Controller  # not the class of __main__
        algorithm = ProcessAlgorithm(process, controller_class)
        node = InProcessNode(
            bus, name="controller", timestep=TIMESTEP, rng=stream(0, "c"), parameters={}
        )
        node.run(algorithm)
        start_duration = time.perf_counter() - start_time
        publish_odometry = bus.publisher("odometry", Odometry)
        trips = measure_round_trips(bus, lambda: publish_odometry(Odometry()), rounds)
        publish_image = bus.publisher("image", Image)
        pixels = np.zeros(640 * 480 * 3, dtype=np.uint8)
        image = Image(height=480, width=640, encoding="rgb8", step=1920, data=pixels)
        images = measure_round_trips(bus, lambda: publish_image(image), rounds // 10)
    assert len(inbox.take()) == rounds
    return {
        "odometry in, twist out": summarize(trips, TARGET_MS),
        "image 640x480": summarize(images),
        "start_s": round(start_duration, 3),
    }


def measure_web_client(rounds: int = ROUNDS) -> dict[str, object]:
    """Measure an external program over WebSocket."""
    bus = Bus()
    inbox = bus.inbox("twist", TwistStamped)
    bridge = WebBridge(bus, lambda: bus.step * TIMESTEP, WebOptions(port=0))
    bridge.admission = SingleProgram(
        lambda subject, message: None
    )  # as in a run: frames are read at once
    client = subprocess.Popen([sys.executable, "-c", CLIENT, str(EXAMPLES), str(bridge.port)])
    try:
        (lockstep_client,) = lockstep_clients(
            [bridge], ["controller"], timestep=TIMESTEP, limit=60.0
        )
        node = InProcessNode(
            bus, name="controller", timestep=TIMESTEP, rng=stream(0, "c"), parameters={}
        )
        publish_odometry = bus.publisher("odometry", Odometry)
        node.run(lockstep_client)

        def publish() -> None:
            publish_odometry(Odometry())
            bus.deliver()
            node.tick()

        trips = measure_round_trips(bus, publish, rounds)
    finally:
        bridge.close()
        client.kill()
        client.wait()
    assert len(inbox.take()) == rounds
    return {"odometry in, twist out": summarize(trips, TARGET_MS)}


def measure() -> dict[str, object]:
    """Measure everything."""
    return {
        "a process of its own": measure_own_process(),
        "a program outside, WebSocket": measure_web_client(),
    }


if __name__ == "__main__":
    main(measure)

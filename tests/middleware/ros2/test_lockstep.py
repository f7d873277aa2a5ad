"""A node of rclpy in lock-step, by the example's ``lockstep.py``."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from tests.support.ros2_peers import BOUND_S, needs_rclpy, peer
from uwsim.messages import Float32MultiArray, Image
from uwsim.messages.build import image

pytest.importorskip("cyclonedds", reason="cyclonedds is not installed: pip install uwsim[ros2]")

from tests.middleware.ros2.simulator import Simulator, run_in_thread
from uwsim.middleware.lockstep.client import lockstep_clients

pytestmark = needs_rclpy
NODE = """
import random, sys, time
sys.path.insert(0, "examples/ros2")
import lockstep
from sensor_msgs.msg import Image
from std_msgs.msg import Float32MultiArray

class Answer:
    def __init__(self, lockstep):
        self.publish = lockstep.publisher("/answer", Float32MultiArray)
        lockstep.subscribe("/camera", Image, self.look)

    def look(self, image):
        time.sleep(random.random() * 0.02)
        self.publish(Float32MultiArray(data=[float(image.header.stamp.sec)]))

lockstep.run("answer", Answer)
"""


class FakeNode:
    """What a client needs of the node by which it is attached."""

    def __init__(self, simulator: Simulator) -> None:
        self._simulator, self.now = simulator, 0.0
        self.barrier: Callable[[], None] = lambda: None

    def subscribe(self, topic: str, type: type, callback: Callable[[object], None]) -> None:
        """Subscribe on the bus."""
        self._simulator.bus.subscribe(topic, type, callback)

    def create_timer(self, period_s: float, callback: Callable[[], None]) -> None:
        """Store the callback that runs at the end of each step."""
        self.barrier = callback


@pytest.mark.slow
def test_each_image_is_answered_in_its_step_and_two_simulations_have_a_node_each() -> None:
    with run_in_thread() as first_answers, peer(NODE, first_answers.domain, prelude="") as node:
        answers_of(first_answers, 10)
        first_answers.bridge.close()  # the client joins the next one
        second = Simulator(first_answers.domain)
        try:
            answers_of(second, 3)
        finally:
            second.bridge.close()
        assert node.process.poll() is None


def answers_of(simulator: Simulator, n: int) -> None:
    """Publish some images, a step each, and compare the answers."""
    publish = simulator.bus.publisher("camera", Image)
    box = simulator.bus.inbox("answer", Float32MultiArray)
    (client,) = lockstep_clients([simulator.bridge], ["answer"], timestep=0.1, limit=BOUND_S)
    node = FakeNode(simulator)
    client.start(node)  # type: ignore[arg-type]
    for k in range(n):
        node.now = 0.1 * k
        publish(image(np.zeros((24, 32, 3), np.uint8), time=float(k)))
        simulator.bus.deliver()
        node.barrier()
        simulator.bus.deliver()
        assert [entry.data[0] for entry in box.take()] == [k + 1.0], "stamps are on ROS's clock"

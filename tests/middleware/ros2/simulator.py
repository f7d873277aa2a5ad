"""A bus that is a node of ROS 2, and a clock that a test turns."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager

from tests.support.ros2_peers import free_domain
from uwsim.bus import Bus
from uwsim.middleware.log import Log
from uwsim.middleware.ros2.adapter import Ros2
from uwsim.middleware.ros2.choice import open_node


class Simulator:
    """A bus, its bridge, and its time."""

    def __init__(self, domain: int) -> None:
        self.bus, self.time, self.domain = Bus(), 0.0, domain
        self.lines: list[str] = []
        log = Log("", self.lines.append)
        node = open_node(os.environ, domain, log)
        self.lines.clear()  # which node it is
        self.bridge = Ros2(self.bus, lambda: self.time, node, log)

    def step(self) -> None:
        """Pass one step boundary."""
        self.time += 0.002
        self.bus.step += 1
        self.bus.deliver()
        self.bridge.step()


@contextmanager
def run_in_thread() -> Iterator[Simulator]:
    """Give one in a domain of its own."""
    with free_domain() as domain:
        actual = Simulator(domain)
        try:
            yield actual
        finally:
            actual.bridge.close()

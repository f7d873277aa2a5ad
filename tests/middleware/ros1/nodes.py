"""A simulation's bus in a ROS 1 graph, and a second one that stands for any other node."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from tests.support.waiting import LIMIT, free_port, wait_until
from uwsim.bus import Bus
from uwsim.middleware.log import Log
from uwsim.middleware.ros1 import Master, PeerTimeouts, Ros1Bridge

TIMESTEP = 0.002
NO_PARAMETERS: Mapping[str, Any] = MappingProxyType({})


class Graph:
    """A master and nodes; to be closed.

    Args:
        master: class of the master.
    """

    def __init__(self, master: type[Master] = Master) -> None:
        self.lines: list[str] = []
        self.log = Log("test", self.lines.append)
        self.master = master(self.log, port=free_port())
        self.nodes: list[Ros1Bridge] = []

    def node(
        self, name: str = "/uwsim", parameters: Mapping[str, Any] = NO_PARAMETERS, **waits: float
    ) -> Ros1Bridge:
        """Add a node with a bus of its own; how long it waits for peers [s]."""
        bus = Bus()
        bridge = Ros1Bridge(
            bus,
            lambda: bus.step * TIMESTEP,
            master=self.master.uri,
            node=name,
            log=self.log,
            parameters=parameters,
            limits=PeerTimeouts(**{"poll": 0.05, **waits}),
        )
        self.nodes.append(bridge)
        return bridge

    def step(self) -> None:
        """Take a step of every node's bus."""
        for node in self.nodes:
            node.bus.step += 1
            node.bus.deliver()
            node.step()

    def wait_until_ready(self) -> None:
        """Wait until the master knows all."""
        self.step()
        assert all(node.wait(LIMIT) for node in self.nodes)

    def wait_for_connections(self, topic: str) -> None:
        """Wait until a topic has a subscriber outside, and the bus knows."""
        wait_until(
            lambda: self.nodes[0].n_connected(topic) and self.nodes[0].bus.has_subscribers(topic),
            self.step,
        )

    def close(self) -> None:
        """End all of it."""
        for node in self.nodes:
            node.close()
        self.master.close()

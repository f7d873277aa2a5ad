"""The scene cirs as a node of a real graph of ROS 1."""

from __future__ import annotations

import subprocess

import uwsim
from tests.support.ros1_peers import Peers
from tests.support.waiting import LIMIT
from uwsim.middleware.log import Log
from uwsim.middleware.ros1 import Ros1Bridge
from uwsim.simulation import Simulation


class Sea:
    """The scene cirs as a node of a real graph."""

    def __init__(self, peers: Peers) -> None:
        self.peers = peers
        self.simulation: Simulation = uwsim.load("cirs")
        self.lines: list[str] = []
        self.bridge = Ros1Bridge(
            self.simulation.bus,
            lambda: self.simulation.time,
            master=peers.uri,
            log=Log("test", self.lines.append),
        )
        self.simulation.watch(self.bridge.step)
        self.simulation.advance(0.0)
        self.bridge.step()
        assert self.bridge.wait(LIMIT)

    def advance(self) -> None:
        """Let some time go by."""
        self.simulation.advance(0.02)

    def odometry(self) -> uwsim.messages.Odometry:
        """The newest odometry."""
        self.simulation.latest_message("/uwsim/girona500/odom")
        self.simulation.advance(0.2)
        actual = self.simulation.latest_message("/uwsim/girona500/odom")
        assert isinstance(actual, uwsim.messages.Odometry)
        return actual

    def output(self, program: subprocess.Popen[str]) -> str:
        """Let time go by until a program has ended, and return what it printed."""
        return self.peers.output(program, self.advance)

    def close(self) -> None:
        """End it."""
        self.bridge.close()
        self.simulation.close()

"""Algorithms that do not do what they should: one breaks, one never starts, one says nothing."""

from __future__ import annotations

from uwsim.bus import Node
from uwsim.messages import Empty, Image, String


class Silent:
    """Starts the benchmark and then says nothing."""

    def start(self, node: Node) -> None:
        node.call("startBench", Empty())


class Absent:
    """Never starts anything."""

    def start(self, node: Node) -> None:
        pass


class Raises:
    """Breaks at its fourth image."""

    def start(self, node: Node) -> None:
        self.n = 0
        node.subscribe("/uwsim/camera1", Image, self.look)
        node.call("startBench", Empty())

    def look(self, image: Image) -> None:
        self.n += 1
        if self.n == 4:
            raise ZeroDivisionError("no focus")


class Fails:
    """Says that it failed."""

    def start(self, node: Node) -> None:
        node.call("startBench", Empty())
        node.publisher("algorithmStatus", String)(String(data="failed: no template"))

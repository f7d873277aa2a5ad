"""Algorithms that fail: without publication, without start, with an error or a reported failure."""

from __future__ import annotations

from uwsim.bus import Node
from uwsim.messages import Empty, Image, String


class NoPublication:
    """An algorithm that starts the benchmark and publishes nothing."""

    def start(self, node: Node) -> None:
        node.call("startBench", Empty())


class NeverStarted:
    """An algorithm that never starts the benchmark."""

    def start(self, node: Node) -> None:
        pass


class RaisedError:
    """An algorithm that raises an error at the fourth image."""

    def start(self, node: Node) -> None:
        self.n = 0
        node.subscribe("/uwsim/camera1", Image, self.on_image)
        node.call("startBench", Empty())

    def on_image(self, image: Image) -> None:
        self.n += 1
        if self.n == 4:
            raise ZeroDivisionError("no focus")


class ReportedFailure:
    """An algorithm that reports its failure."""

    def start(self, node: Node) -> None:
        node.call("startBench", Empty())
        node.publisher("algorithmStatus", String)(String(data="failed: no template"))

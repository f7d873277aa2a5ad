"""Algorithms of these tests, which run in a process of their own: little is imported here."""

from __future__ import annotations

import os
import signal
from pathlib import Path

from uwsim.bus import Node
from uwsim.messages import Empty, Image


class Mortal:
    """Takes its process with it at the ninth image, in level 2, unless a file is there."""

    def start(self, node: Node) -> None:
        self.n_images = 0
        self.immortal = Path(str(node.parameters["immortal"]))
        self.dies_once = node.parameters["dies"] == "once"
        node.subscribe("/uwsim/camera1", Image, self.look)
        node.call("startBench", Empty())

    def look(self, image: Image) -> None:
        self.n_images += 1
        if self.n_images == 9 and not self.immortal.exists():
            if self.dies_once:
                self.immortal.touch()
            os.kill(os.getpid(), signal.SIGKILL)


class Wanders:
    """Goes to another folder."""

    def start(self, node: Node) -> None:
        node.subscribe("/uwsim/camera1", Image, lambda _: os.chdir(str(node.parameters["where"])))
        node.call("startBench", Empty())

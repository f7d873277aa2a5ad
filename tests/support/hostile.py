"""Algorithms that fail, flood, hang or cheat; `ATTACKS` has the expected reason of each.

The limits are 100 messages and 1 MiB.
"""

from __future__ import annotations

import asyncio
import os
import threading
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from uwsim.benchmark.measures.euclidean_norm import EuclideanNorm
from uwsim.bus import Node
from uwsim.messages import Float32MultiArray, PoseStamped, String, floats
from uwsim.simulation.nodes import undelivered

TOPIC = "estimate"


class Attacker:
    """The base class of attacks, half a second after the start."""

    def start(self, node: Node) -> None:
        self.node = node
        self.publish = node.publisher(TOPIC, Float32MultiArray)
        self.n = 0
        node.create_timer(0.1, self.tick)

    def tick(self) -> None:
        self.n += 1
        if self.n == 5:
            self.attack()

    def attack(self) -> None:
        raise NotImplementedError


class Cancels(Attacker):
    def attack(self) -> None:
        raise asyncio.CancelledError


class Leaves(Attacker):
    def attack(self) -> None:
        raise GeneratorExit


class Exits(Attacker):
    def attack(self) -> None:
        raise SystemExit(0)


class Unshowable(Exception):
    def __str__(self) -> str:
        raise ValueError("no text")


class RaisesTheUnshowable(Attacker):
    def attack(self) -> None:
        raise Unshowable


class Floods(Attacker):
    """An attack that publishes on, despite errors."""

    def attack(self) -> None:
        for _ in range(2 * undelivered.MAX_MESSAGES):
            with suppress(Exception):
                self.publish(floats([1.0]))


class Echoes(Attacker):
    """An attack that answers its own messages endlessly."""

    def attack(self) -> None:
        self.node.subscribe(TOPIC, Float32MultiArray, self.publish)
        self.publish(floats([1.0]))


class Swells(Attacker):
    """An attack that publishes more bytes than the limit, in messages below it."""

    def attack(self) -> None:
        piece = np.zeros(undelivered.MAX_BYTES // 16, dtype=np.float32)  # a quarter
        for _ in range(5):
            self.publish(Float32MultiArray(data=piece))


class UsesAThread(Attacker):
    def attack(self) -> None:
        def publish() -> None:
            with suppress(Exception):
                self.publish(floats([1.0]))

        thread = threading.Thread(target=publish)
        thread.start()
        thread.join()


class DerivedMessage(Float32MultiArray):
    """A message of a derived class, which could change its values at each read."""


class PublishesTheDerived(Attacker):
    def attack(self) -> None:
        self.publish(DerivedMessage(data=np.ones(1, dtype=np.float32)))


class PublishesTheWrongPart(Attacker):
    def attack(self) -> None:
        self.node.publisher("place", PoseStamped)(
            PoseStamped(pose=String())  # type: ignore[arg-type]
        )


class ExitsProcess(Attacker):
    """An attack that exits its process with status 0, unless a file exists."""

    def attack(self) -> None:
        if not Path(str(self.node.parameters["immortal"])).exists():
            os._exit(0)


class NeverReturns(Attacker):
    """An attack that never returns, whatever is raised."""

    def attack(self) -> None:
        while True:
            with suppress(BaseException):
                time.sleep(10.0)


class Patches(Attacker):
    """An attack that replaces the value of the measure."""

    def attack(self) -> None:
        EuclideanNorm.value = 0.0  # type: ignore[method-assign, assignment]
        self.publish(floats([7.0]))


class PublishesWrongEstimate(Attacker):
    """A fair algorithm with an error of 1."""

    def tick(self) -> None:
        self.publish(floats([2.0]))


ATTACKS: dict[type[Any], str] = {
    Cancels: "CancelledError",
    Leaves: "GeneratorExit",
    Exits: "SystemExit: 0",
    RaisesTheUnshowable: "Unshowable: its text cannot be shown",
    Floods: "more than 100 of its messages wait to be delivered",
    Echoes: "more than 100 of its messages wait to be delivered",
    Swells: "messages of more than 1 MiB wait to be delivered",
    UsesAThread: "it uses its node from a thread of its own",
    PublishesTheDerived: "carries std_msgs/msg/Float32MultiArray",
    PublishesTheWrongPart: "pose is String(",
}

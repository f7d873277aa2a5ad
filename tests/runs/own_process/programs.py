"""Algorithms for a process of their own; imported there, so this needs little."""

from __future__ import annotations

import gc
import os
import random
import signal
import sys
import threading
import time
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from uwsim.bus import Node
from uwsim.errors import BadMessage, BadSetting, UnknownName
from uwsim.messages import Empty, Float32MultiArray, GTpublish, GTpublishResponse, String, floats

TOPIC = "estimate"


@dataclass
class Note:
    """A message that only this program has."""

    text: str = ""
    numbers: np.ndarray[Any, np.dtype[np.float64]] | None = None


class Does:
    """Publishes a random estimate ten times a second, and does something at the fifth."""

    def start(self, node: Node) -> None:
        self.node, self.n = node, 0
        self.publish = node.publisher(TOPIC, Float32MultiArray)
        node.create_timer(0.1, self.tick)

    def tick(self) -> None:
        self.n += 1
        self.publish(floats([self.node.rng.normal() + self.node.now]))
        if self.n == 5:
            self.act()

    def act(self) -> None:
        pass


class Sleeps(Does):
    """Takes up to 20 ms for everything."""

    def tick(self) -> None:
        time.sleep(random.uniform(0.0, 0.02))  # as slow as it likes: other numbers each time
        super().tick()


class Raises(Does):
    def act(self) -> None:
        raise ValueError("a mistake")


class Exits(Does):
    def act(self) -> None:
        sys.exit(0)


class Interrupts(Does):
    def act(self) -> None:
        raise KeyboardInterrupt


class Threads(Does):
    def act(self) -> None:
        def publish() -> None:
            with suppress(Exception):
                self.publish(floats([1.0]))

        thread = threading.Thread(target=publish)
        thread.start()
        thread.join()


class Misshapes(Does):
    def act(self) -> None:
        self.publish(Float32MultiArray(data="no numbers"))  # type: ignore[arg-type]


class Mistypes(Does):
    def act(self) -> None:
        self.publish(String(data="no numbers"))  # type: ignore[arg-type]


class CallsNobody(Does):
    def act(self) -> None:
        self.node.call("nobody", Empty())


class Talks(Does):
    """Publishes one message again and again, each time with another number, then gives up."""

    def act(self) -> None:
        note = self.node.publisher("notes", Note)
        say = self.node.publisher(TOPIC, Float32MultiArray)
        message = floats([0.0])
        for k in range(250):
            message.data[0] = self.n + k / 1000
            say(message)
        note(Note("the end"))
        with suppress(BadMessage):
            say(Float32MultiArray(data="no numbers"))  # type: ignore[arg-type]
        say(Float32MultiArray(data=[7.0, 8.0]))  # type: ignore[arg-type]
        raise ValueError("enough")


class Recovers(Does):
    """Makes mistakes that it may make."""

    def act(self) -> None:
        for mistake in (
            lambda: self.node.call("nobody", Empty()),
            lambda: self.node.create_timer(-1.0, self.act),
            lambda: self.node.subscribe(TOPIC, String, print),
        ):
            with suppress(UnknownName, BadSetting):
                mistake()


class Nests(Does):
    """Calls its own service, within which it publishes and calls another of its own."""

    def start(self, node: Node) -> None:
        super().start(node)
        node.serve("outer", GTpublish, self.outer)
        node.serve("inner", GTpublish, self.inner)
        self.tell = node.publisher("notes", Note)
        node.subscribe("notes", Note, self.hear)

    def act(self) -> None:
        self.node.call("outer", GTpublish(groundTruth=np.ones(2, dtype=np.float32)))

    def outer(self, request: GTpublish) -> GTpublishResponse:
        self.publish(floats(request.groundTruth * 3))
        self.node.call("inner", request)
        return GTpublishResponse()

    def inner(self, request: GTpublish) -> GTpublishResponse:
        self.publish(floats(request.groundTruth * 5))
        self.tell(Note(text="told", numbers=np.array([0.1, 1.0 / 3.0])))
        return GTpublishResponse()

    def hear(self, note: Note) -> None:
        assert note.numbers is not None
        self.publish(floats(note.numbers * 7))


class Reports(Does):
    @property
    def parameters(self) -> dict[str, float | str]:
        return {"gain": 0.1 + 0.2, "made": "there"}


class ReportsRubbish(Does):
    parameters: ClassVar[dict[str, object]] = {"gain": [1]}


class ReportsAnObject(Does):
    parameters: ClassVar[dict[object, object]] = {"mode": 1.0, 5: object}


class RefusesToStart:
    def start(self, node: Node) -> None:
        raise BadSetting("gain: not today")


class CannotBeMade:
    def __init__(self) -> None:
        raise OSError("no camera")

    def start(self, node: Node) -> None:
        pass


class Dies(Does):
    def act(self) -> None:
        os._exit(3)


class Forks:
    """Dies; a child of it holds its socket."""

    def start(self, node: Node) -> None:
        if os.fork():
            os._exit(3)
        time.sleep(20.0)
        os._exit(0)


class SendsHalf:
    """Sends the length of a frame, and the frame never."""

    def start(self, node: Node) -> None:
        os.write(int(sys.argv[1]), (1000).to_bytes(4, "big"))
        time.sleep(20.0)


class IsKilled(Does):
    def act(self) -> None:
        os.kill(os.getpid(), signal.SIGKILL)


class SendsGarbage(Does):
    """Writes into every socket that it finds."""

    def act(self) -> None:
        for descriptor in range(3, 50):
            with suppress(OSError):
                os.write(descriptor, b"\x00\x00\x00\x05nasty")
        time.sleep(60.0)


class LooksForTheTruth(Does):
    """Fails unless there is nothing of the simulation here."""

    def act(self) -> None:
        found = {type(each).__name__ for each in gc.get_objects()}
        assert not found & {"Simulation", "InProcessNode", "LiveScene"}
        assert "uwsim.simulation" not in sys.modules


class Hangs(Does):
    """Does not come back, whatever happens."""

    def act(self) -> None:
        while True:
            with suppress(BaseException):
                time.sleep(600.0)


class NeverMade:
    """Its making does not come back."""

    def __init__(self) -> None:
        while True:
            time.sleep(10.0)


class Asks(Does):
    """Reads a parameter that it may not have been given, and one only when it is there."""

    def start(self, node: Node) -> None:
        super().start(node)
        self.gain = float(node.parameters.get("gain", 1.0))
        if "limit" in node.parameters:
            self.limit = node.parameters["limit"]


class AsksLater(Does):
    """Reads its parameter in a callback, and reports all of them."""

    def start(self, node: Node) -> None:
        super().start(node)
        self.parameters = node.parameters
        node.create_timer(0.3, lambda: float(node.parameters.get("gain", 1.0)))


class GoesThrough(Does):
    """Takes all parameters together."""

    def start(self, node: Node) -> None:
        super().start(node)
        self.settings = {"gain": 1.0, **node.parameters}

"""Topics that pages ask for: the numbers and texts of their newest messages.

A topic is listened to as somebody who does not count (`uwsim.bus.Bus.subscribe`), so nothing is
published, drawn or changed for it. A topic that nobody else reads may therefore be silent.
"""

from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Callable, Iterator, Set
from functools import partial
from typing import Any

import numpy as np

from ...bus import Bus

PERIOD = 0.1
"""Least wall time between two messages of a topic that are taken apart [s]."""
MAX_FIELDS = 40
"""Of a message that is shown."""
MAX_ENTRIES = 8
"""Of an array in it."""
MAX_LETTERS = 200
"""Of a text in it."""
CHANNEL = "?topic/"
"""How the channel of a topic begins."""
Value = float | str | None


class HeardTopics:
    """The topics of one simulation that pages ask for.

    Args:
        bus: of the simulation.
        time: returns the simulation time [s].
        wall: returns the wall time [s].
    """

    def __init__(self, bus: Bus, time: Callable[[], float], wall: Callable[[], float]) -> None:
        self._bus, self._time, self._wall = bus, time, wall
        self._stops: dict[str, Callable[[], None]] = {}
        self._due: dict[str, float] = {}
        self._news: dict[str, str] = {}
        self._listed: dict[str, str] = {}

    def list_changed(self) -> str | None:
        """Return the list of all topics as a message, where it is another than the last time."""
        topics = self._bus.topics
        if topics == self._listed:
            return None
        self._listed = topics
        return json.dumps({"type": "topics", "topics": list(topics.items())})

    def news(self, wanted: Set[str]) -> dict[str, str]:
        """Return what came on the wanted channels since the last call, channel -> message."""
        names = {channel.removeprefix(CHANNEL) for channel in wanted if channel.startswith(CHANNEL)}
        for name in self._stops.keys() - names:
            self._stops.pop(name)()
        for name in names - self._stops.keys():
            if name in self._bus.topics:
                heard = partial(self._hear, name)
                self._stops[name] = self._bus.subscribe(name, object, heard, counts=False)
                self._due[name] = 0.0
        news, self._news = self._news, {}
        return {f"{CHANNEL}{name}": text for name, text in news.items() if name in names}

    def close(self) -> None:
        """Listen to nothing more."""
        for stop in self._stops.values():
            stop()
        self._stops.clear()

    def _hear(self, name: str, message: object) -> None:
        wall = self._wall()
        if wall < self._due[name]:
            return
        self._due[name] = wall + PERIOD
        fields = list(_first(fields_of(message), MAX_FIELDS + 1))
        about = {"type": "topic", "name": name, "time": self._time()}
        cut = {"fields": fields[:MAX_FIELDS], "is_cut": len(fields) > MAX_FIELDS}
        self._news[name] = json.dumps(about | cut)


def _first(fields: Iterator[tuple[str, Value]], n: int) -> Iterator[tuple[str, Value]]:
    for _, field in zip(range(n), fields, strict=False):
        yield field


def fields_of(message: object, path: str = "") -> Iterator[tuple[str, Value]]:
    """Yield the numbers and texts in a message, with their paths as ``pose.position.x``.

    Of an array the first entries, and its length as ``NAME.length`` where it has more. What is not
    finite is None. Headers and covariances are left out.
    """
    if dataclasses.is_dataclass(message):
        for field in dataclasses.fields(message):
            if field.name.startswith("header") or field.name.endswith("covariance"):
                continue
            under = f"{path}.{field.name}" if path else field.name
            yield from fields_of(getattr(message, field.name), under)
    elif isinstance(message, str):
        yield path, message[:MAX_LETTERS]
    elif isinstance(message, bool | np.bool_ | int | float | np.number):
        yield path, _number(message)
    elif isinstance(message, list | tuple | np.ndarray):
        for index, entry in enumerate(message[:MAX_ENTRIES]):
            yield from fields_of(entry, f"{path}[{index}]")
        if len(message) > MAX_ENTRIES:
            yield f"{path}.length", float(len(message))


def _number(value: Any) -> float | None:
    try:
        number = float(value)
    except OverflowError:
        return None
    return number if math.isfinite(number) else None

"""The topics that pages request: the numbers and texts of their messages, ten a second at most.

The bus does not count these subscriptions (`uwsim.bus.Bus.subscribe`): nothing is published,
rendered or changed because of them. A topic without another subscriber may have no messages.
"""

from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Callable, Iterator, Set
from functools import partial
from itertools import islice
from typing import Any

import numpy as np

from ...bus import Bus

MIN_PERIOD = 0.1
"""The shortest wall time between two messages of a topic that are accepted for pages [s]."""
MAX_FIELDS = 40
"""The greatest number of fields of a message that are shown."""
MAX_ENTRIES = 8
"""The greatest number of entries of an array that are shown."""
MAX_CHARACTERS = 200
"""The greatest number of characters of a text that are shown."""
CHANNEL = "?topic/"
"""The prefix of a topic's name in the name of the channel on which the live server sends it."""
Value = float | str | None
"""The value of a field: a number, a text, or None for a number that is not finite."""


class TopicMonitor:
    """The topics of one simulation that pages request.

    Args:
        bus: the bus of the simulation.
        time: the function that returns the simulation time [s].
        wall: the function that returns the wall time [s].
    """

    def __init__(self, bus: Bus, time: Callable[[], float], wall: Callable[[], float]) -> None:
        self._bus, self._time, self._wall = bus, time, wall
        self._unsubscribe: dict[str, Callable[[], None]] = {}  # by topic
        self._due: dict[str, float] = {}  # wall time of the next accepted message, by topic [s]
        self._new_messages: dict[str, str] = {}  # the newest accepted, JSON by topic
        self._last_list: dict[str, str] = {}  # types by topic, as sent last

    def changed_list(self) -> str | None:
        """Return the list of all topics as a message, if it has changed."""
        topics = self._bus.topics
        if topics == self._last_list:
            return None
        self._last_list = topics
        return json.dumps({"type": "topics", "topics": list(topics.items())})

    def new_messages(self, channels: Set[str]) -> dict[str, str]:
        """Return the newest accepted message since the last call, as JSON, by channel.

        Messages that follow an accepted one of the topic within `MIN_PERIOD` are skipped.

        Args:
            channels: the channels that pages request; only their topics are subscribed to.
        """
        names = {name.removeprefix(CHANNEL) for name in channels if name.startswith(CHANNEL)}
        for name in self._unsubscribe.keys() - names:
            self._unsubscribe.pop(name)()
        for name in names - self._unsubscribe.keys():
            if name in self._bus.topics:
                handler = partial(self._on_message, name)
                self._unsubscribe[name] = self._bus.subscribe(
                    name, object, handler, is_counted=False
                )
                self._due[name] = 0.0
        messages, self._new_messages = self._new_messages, {}
        return {f"{CHANNEL}{name}": text for name, text in messages.items() if name in names}

    def close(self) -> None:
        """End all subscriptions."""
        for unsubscribe in self._unsubscribe.values():
            unsubscribe()
        self._unsubscribe.clear()

    def _on_message(self, name: str, message: object) -> None:
        wall = self._wall()
        if wall < self._due[name]:
            return
        self._due[name] = wall + MIN_PERIOD
        fields = list(islice(fields_of(message), MAX_FIELDS + 1))
        head = {"type": "topic", "name": name, "time": self._time()}
        content = {"fields": fields[:MAX_FIELDS], "is_cut": len(fields) > MAX_FIELDS}
        self._new_messages[name] = json.dumps(head | content)


def fields_of(message: object, path: str = "") -> Iterator[tuple[str, Value]]:
    """Yield the numbers and texts in a message, with their paths as ``pose.position.x``.

    The first `MAX_ENTRIES` entries of an array are yielded; if the array has more, its length
    follows as ``NAME.length``. Numbers that are not finite are None. Headers and covariances are
    left out.
    """
    if dataclasses.is_dataclass(message):
        for field in dataclasses.fields(message):
            if field.name.startswith("header") or field.name.endswith("covariance"):
                continue
            field_path = f"{path}.{field.name}" if path else field.name
            yield from fields_of(getattr(message, field.name), field_path)
    elif isinstance(message, str):
        yield path, message[:MAX_CHARACTERS]
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

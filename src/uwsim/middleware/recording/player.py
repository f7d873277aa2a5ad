"""Puts a recording onto a bus, each message at its time."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping

from ...bus import Node
from .bag_reader import BagReader

PREFIX = "/recorded"
"""In front of topics that something else publishes, too."""


class Player:
    """Publishes the messages of a recording, as an algorithm that is attached to a simulation.

    A message is delivered at the first step at or after its time; those of one step in the order
    of `BagReader.messages`. A recording of a simulation with the same step is so played at the same
    steps.

    Args:
        reader: the recording.
        timestep: of the simulation [s].
        published: topics, with a leading slash, that others publish: the recorded messages go to
            ``/recorded/TOPIC``.
        left_out: topics that are not played.
    """

    def __init__(
        self,
        reader: BagReader,
        timestep: float,
        *,
        published: Collection[str] = (),
        left_out: Collection[str] = (),
    ) -> None:
        self._timestep = timestep
        self._messages = reader.messages()
        self._next = next(self._messages, None)
        self._publishers: dict[str, Callable[[object], None]] = {}
        self.topics: Mapping[str, str] = {
            topic: f"{PREFIX}{topic}" if topic in published else topic
            for topic in reader.topics
            if topic not in left_out
        }
        """Topic in the recording -> topic on the bus."""
        self._types = reader.topics

    def start(self, node: Node) -> None:
        """Publish from now on."""
        self._node = node
        for topic, name in self.topics.items():
            self._publishers[topic] = node.publisher(name, self._types[topic])
        node.create_timer(self._timestep, self._play)

    @property
    def is_over(self) -> bool:
        """Whether all is played."""
        return self._next is None

    def _play(self) -> None:
        step = round(self._node.now / self._timestep)
        while self._next is not None:
            time, topic, message = self._next
            if math.ceil(time / self._timestep - 1e-6) > step:
                return
            if topic in self._publishers:
                self._publishers[topic](message)
            self._next = next(self._messages, None)

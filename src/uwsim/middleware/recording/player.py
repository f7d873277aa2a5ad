"""Playback of a recording on a bus, each message at the time at which it was recorded."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping

from ...bus import Node
from .bag_reader import BagReader

PREFIX = "/recorded"
"""The prefix of those recorded topics that the simulation itself publishes."""


class Player:
    """An algorithm that publishes the messages of a recording.

    A message is delivered at the first step at or after its time; messages of one step are in the
    order of `BagReader.messages`. The messages of a simulation with an equal time step are thus
    delivered at the steps at which they were recorded.

    Args:
        reader: the recording.
        timestep: the step of the simulation [s].
        bus_topics: the topics, with a leading slash, that the simulation itself publishes; their
            recorded messages are published on ``/recorded/TOPIC``.
        left_out: the topics that are not played.
    """

    def __init__(
        self,
        reader: BagReader,
        timestep: float,
        *,
        bus_topics: Collection[str] = (),
        left_out: Collection[str] = (),
    ) -> None:
        self._timestep = timestep
        self._messages = reader.messages()
        self._next_message = next(self._messages, None)
        self._publishers: dict[str, Callable[[object], None]] = {}
        self.topics: Mapping[str, str] = {
            topic: f"{PREFIX}{topic}" if topic in bus_topics else topic
            for topic in reader.topics
            if topic not in left_out
        }
        """The topic on the bus of each topic in the recording."""
        self._types = reader.topics

    def start(self, node: Node) -> None:
        """Publish from now on."""
        self._node = node
        for topic, name in self.topics.items():
            self._publishers[topic] = node.publisher(name, self._types[topic])
        node.create_timer(self._timestep, self._play)

    @property
    def is_over(self) -> bool:
        """True if all messages are published."""
        return self._next_message is None

    def _play(self) -> None:
        step = round(self._node.now / self._timestep)
        while self._next_message is not None:
            time, topic, message = self._next_message
            if math.ceil(time / self._timestep - 1e-6) > step:
                return
            if topic in self._publishers:
                self._publishers[topic](message)
            self._next_message = next(self._messages, None)

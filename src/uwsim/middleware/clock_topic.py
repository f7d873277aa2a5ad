"""The topic ``/clock`` of a transport, and the schedule of its messages."""

from __future__ import annotations

import math
from collections.abc import Callable

COARSE_PERIOD = 0.01
"""The shortest simulation time between two messages on ``/clock`` for web clients, and for nodes
for whose outputs the simulation waits [s]."""
ROS_PERIOD = 0.001
"""The shortest simulation time between two messages on ``/clock`` for nodes of ROS [s].

A node's ``sleep`` and timers end with a message on ``/clock``; with a longer period, each round of
a loop of 1 ms would take a whole period.
"""


class ClockTopic:
    """The publisher of the simulation time; in the thread of the simulation.

    Args:
        time: a function that returns the simulation time [s].
        publish: a function that publishes the time, if the topic has a subscriber.
        is_read: a function that returns whether the topic has an external subscriber; True if the
            transport cannot know it.
        period: the shortest simulation time between two messages [s].
    """

    def __init__(
        self,
        time: Callable[[], float],
        publish: Callable[[], None],
        is_read: Callable[[], bool],
        *,
        period: float,
    ) -> None:
        self.time = time
        """The function that returns the simulation time [s]."""
        self._publish, self._is_read = publish, is_read
        self.period = period
        """The shortest simulation time between two messages [s]."""
        self._last_time = -math.inf

    @property
    def is_due(self) -> bool:
        """True if the next message is due, also because time went back."""
        return not self._last_time <= self.time() + 1e-9 < self._last_time + self.period

    @property
    def is_read(self) -> bool:
        """True if the topic has an external subscriber."""
        return self._is_read()

    def send(self) -> None:
        """Publish the time."""
        self._last_time = self.time()
        self._publish()

    def send_at_next_step(self) -> None:
        """Publish the time at the next step boundary, for a new subscriber.

        May be called from any thread.
        """
        self._last_time = -math.inf

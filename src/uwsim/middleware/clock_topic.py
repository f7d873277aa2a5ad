"""The topic ``/clock`` of a transport: when a message on it is due."""

from __future__ import annotations

import math
from collections.abc import Callable

COARSE_PERIOD = 0.01
"""Shortest simulation time between two messages on ``/clock``, for web clients, and for nodes
whose outputs are waited for [s]."""
ROS_PERIOD = 0.001
"""The same for nodes of ROS [s]: every step, unless steps are shorter.

A node's ``sleep`` and timers end with a message on ``/clock``; with longer periods, a loop of 1 ms
would take as long as they are.
"""


class ClockTopic:
    """Tells those outside the time; in the thread of the simulation.

    Args:
        time: returns the simulation time [s].
        publish: sends it, if anybody reads it.
        is_read: whether anybody outside does; True where a transport cannot tell.
        period: shortest simulation time between two messages [s].
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
        """Returns the simulation time [s]."""
        self._publish, self._is_read = publish, is_read
        self.period = period
        """Shortest simulation time between two messages [s]."""
        self._last = -math.inf

    @property
    def is_due(self) -> bool:
        """Whether it is time for the next message, also because time went back."""
        return not self._last <= self.time() + 1e-9 < self._last + self.period

    @property
    def is_read(self) -> bool:
        """Whether anybody outside reads it."""
        return self._is_read()

    def send(self) -> None:
        """Tell the time."""
        self._last = self.time()
        self._publish()

    def send_at_next_step(self) -> None:
        """Have the time told at the next step boundary: somebody has come. Any thread."""
        self._last = -math.inf

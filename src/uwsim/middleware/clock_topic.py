"""The topic ``/clock`` of a transport: when a message on it is due."""

from __future__ import annotations

from collections.abc import Callable

CLOCK_PERIOD = 0.01
"""Simulation time from one message on ``/clock`` to the next, at least [s]."""


class ClockTopic:
    """Tells those outside the time; in the thread of the simulation.

    Args:
        time: returns the simulation time [s].
        publish: sends it, if anybody reads it.
        is_read: whether anybody outside does; True where a transport cannot tell.
    """

    def __init__(
        self, time: Callable[[], float], publish: Callable[[], None], is_read: Callable[[], bool]
    ) -> None:
        self._time, self._publish, self._is_read = time, publish, is_read
        self._next = 0.0

    @property
    def is_due(self) -> bool:
        """Whether it is time for the next message, also because time went back."""
        return not self._next - CLOCK_PERIOD <= self._time() + 1e-9 < self._next

    @property
    def is_read(self) -> bool:
        """Whether anybody outside reads it."""
        return self._is_read()

    def send(self) -> None:
        """Tell the time."""
        self._next = self._time() + CLOCK_PERIOD
        self._publish()

    def send_at_next_step(self) -> None:
        """Have the time told at the next step boundary: somebody has come. Any thread."""
        self._next = 0.0

"""The observer of streams: it measures delays outside of the simulation."""

from __future__ import annotations

from typing import Protocol


class StreamObserver(Protocol):
    """An observer of streams, such as a strict clock. It changes nothing in the simulation."""

    def note_sent(self, name: str, time: float, due_time: float) -> None:
        """Note that a stream has sent a measurement.

        Args:
            name: the name of the stream.
            time: the simulation time of the measurement [s].
            due_time: the simulation time at which its last byte leaves the line [s].
        """

    def note_unsent(self, name: str) -> None:
        """Note that a stream could not send a measurement: nobody reads, or a buffer is full."""

    def note_command(self, name: str, stamp: float | None) -> None:
        """Note that a stream has applied a command.

        Args:
            name: the name of the stream.
            stamp: the simulation time of the measurement that the command answers [s], if known.
        """

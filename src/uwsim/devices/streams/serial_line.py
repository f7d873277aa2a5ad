r"""The transmission time of a serial line.

A byte takes 10 bits: a start bit, 8 data bits and a stop bit. With the bit rate B, n bytes that are
queued at time t while the line is busy until :math:`t_b` have left at

.. math:: t_n = \max(t, t_b) + 10 n / B .

Not modelled: parity, flow control, and the latency of the driver.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass, field

from ...base.record import Record

BITS_PER_BYTE = 10
"""The number of bits of a byte on a serial line, with start and stop bit."""


@dataclass(slots=True)
class LineState(Record):
    """The state of a serial line."""

    busy_until: float = 0.0
    """The simulation time at which the last queued byte leaves [s]."""
    n_queued: int = 0
    """The number of bytes that have not left."""
    n_lost: int = 0
    """The number of messages that did not fit into the buffer."""
    queue: deque[tuple[float, bytes, float]] = field(default_factory=deque)
    """The time at which each message has left, its bytes, and the time of its values [s]."""


class SerialLine:
    """A line that delays messages by their transmission time.

    Args:
        bit_rate: the bit rate [bit/s]; None: messages leave at once.
        buffer_size: the greatest number of bytes that wait [bytes].
    """

    def __init__(self, bit_rate: int | None, buffer_size: int) -> None:
        self._bit_rate, self._buffer_size = bit_rate, buffer_size
        self.state = LineState()
        """The state of the line."""

    @property
    def next_time(self) -> float:
        """The time at which the next message has left [s]; inf if none waits."""
        return self.state.queue[0][0] if self.state.queue else math.inf

    def push(self, data: bytes, time: float) -> None:
        """Queue a message at a time [s]; it is lost if it does not fit into the buffer."""
        state = self.state
        if state.n_queued + len(data) > self._buffer_size:
            state.n_lost += 1
            return
        if self._bit_rate is not None:
            start = max(time, state.busy_until)
            state.busy_until = start + BITS_PER_BYTE * len(data) / self._bit_rate
        else:
            state.busy_until = time
        state.queue.append((state.busy_until, data, time))
        state.n_queued += len(data)

    def pop_sent(self, time: float) -> list[tuple[bytes, float, float]]:
        """Return the messages that have left until a time [s].

        Each is the bytes, the time of their values, and the time at which they left [s].
        """
        messages = []
        while self.next_time <= time:
            due_time, data, value_time = self.state.queue.popleft()
            self.state.n_queued -= len(data)
            messages.append((data, value_time, due_time))
        return messages

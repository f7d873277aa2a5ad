"""WebSocket connections within limits: of the time to read them, and of their number."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable
from functools import partial

from websockets.asyncio.server import Server, ServerConnection
from websockets.protocol import State
from websockets.server import ServerProtocol

from .work_budget import WorkBudget

MAX_COST, MAX_SHARED_COST = 1.0, 0.05
"""The most time that one reading counts for its client, and for all together [s]: a large frame of
one client keeps the others from being read for a moment only."""
FRAME_COST = 5e-5
"""Time that a frame takes, besides what is measured [s]."""
LARGE = 2**16
"""Length from which a frame is large [characters]."""
LARGE_SHARE, LARGE_BURST = 0.02, 0.05
"""Share of the wall time in which large frames of all clients are handled, and the time at once
[s]. They wait for each other alone, and count wholly, whoever sent them: the budget of one
connection counts too late what its first frame takes."""
LONGEST_SLEEP = 1.0
"""How often a client whose large frame waits is looked at: it may have left [s]."""
REST = 0.1
"""How long a client beyond its share is not read, besides what it has taken too much [s]: each time
that the server wakes, the simulation waits for Python's lock."""


class ConnectionLimits:
    """The limits of the connections of one server.

    Args:
        share: of the wall time, in which one connection is read.
        burst: the time at once after a rest [s].
        work: the budget of all connections together; None: there is none.
        max_waiting: how many connections may be open that are not admitted yet; beyond it, the
            oldest of them is broken off (1 or more).
    """

    def __init__(
        self, share: float, burst: float, work: WorkBudget | None = None, max_waiting: int = 64
    ) -> None:
        self.share, self.burst, self.work = share, burst, work
        self._max_waiting = max_waiting
        self._open: dict[LimitedConnection, None] = {}  # the oldest first
        self.large = WorkBudget(LARGE_SHARE, LARGE_BURST)
        """For the large frames of all connections together."""

    def add(self, connection: LimitedConnection) -> None:
        """Count a new connection; where too many wait, break off the oldest of those."""
        self._open[connection] = None
        waiting = [each for each in self._open if each.state is State.CONNECTING]
        for each in waiting[: -self._max_waiting]:
            self.discard(each)
            each.transport.abort()

    def discard(self, connection: LimitedConnection) -> None:
        """Count a connection no more."""
        self._open.pop(connection, None)

    def abort_all(self) -> None:
        """Break off every connection; its transport is closed in the next turn of the loop."""
        for connection in tuple(self._open):
            connection.transport.abort()


class LimitedConnection(ServerConnection):
    """A connection that is not read for a while when it has taken more than its share.

    All that arrives counts: the library answers control frames itself.

    Args:
        protocol: of the connection.
        server: that serves it.
        limits: those of the server.
        ping_interval: time between two pings [s]; None: none are sent.
        ping_timeout: how long an answer to a ping may take [s]; None: for ever.
        close_timeout: how long closing may take [s]; None: for ever.
        max_queue: frames that wait to be read.
        write_limit: of what is on its way [byte].
    """

    def __init__(
        self,
        protocol: ServerProtocol,
        server: Server,
        *,
        limits: ConnectionLimits,
        ping_interval: float | None = 20.0,
        ping_timeout: float | None = 20.0,
        close_timeout: float | None = 10.0,
        max_queue: int | tuple[int | None, int | None] | None = 16,
        write_limit: int | tuple[int, int | None] = 2**15,
    ) -> None:
        super().__init__(
            protocol,
            server,
            ping_interval=ping_interval,
            ping_timeout=ping_timeout,
            close_timeout=close_timeout,
            max_queue=max_queue,
            write_limit=write_limit,
        )
        self._limits = limits
        self._own = WorkBudget(limits.share, limits.burst)
        self.is_spared: Callable[[], bool] = lambda: False
        """Returns whether it may take as long as it likes."""
        self.report_rest: Callable[[], None] = lambda: None
        """Called when it is not read for a while."""

    def spend(self, seconds: float) -> None:
        """Count work for this connection [s], unless it is spared."""
        if self.is_spared():
            return
        self._own.spend(min(seconds, MAX_COST))
        if self._limits.work is not None:
            self._limits.work.spend(min(seconds, MAX_SHARED_COST))

    async def handle(self, frame: str | bytes, by: Callable[[str | bytes], None]) -> None:
        """Have a frame handled when it may be, then wait while the client is beyond its share."""
        is_large = len(frame) >= LARGE and not self.is_spared()
        while is_large and (delay := self._limits.large.delay) > 0.0:
            await asyncio.sleep(min(delay + REST, LONGEST_SLEEP))
            if self.state is not State.OPEN:
                return
        took = _time_of(partial(by, frame))
        if is_large:
            self._limits.large.spend(took)
        self.spend(FRAME_COST + took)
        if (rest := self.rest) > 0.0:  # a flood waits in the sockets, not here
            self.report_rest()
            await asyncio.sleep(rest)

    @property
    def rest(self) -> float:
        """How long it should not be read now [s]; 0: it may be."""
        if self.is_spared():
            return 0.0
        shared = 0.0 if self._limits.work is None else self._limits.work.delay
        delay = max(self._own.delay, shared)
        return delay + REST if delay > 0.0 else 0.0

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Count it."""
        super().connection_made(transport)
        self._limits.add(self)

    def connection_lost(self, exc: Exception | None) -> None:
        """Count it no more."""
        self._limits.discard(self)
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Read what has arrived, then nothing for a while if that took too long."""
        self.spend(_time_of(partial(super().data_received, data)))
        if (rest := self.rest) > 0.0:
            self.report_rest()
            self.transport.pause_reading()
            self.loop.call_later(rest, self._read_on)

    def _read_on(self) -> None:
        """Read again, unless messages wait in the queue: the library reads on after those."""
        if not self.recv_messages.paused and not self.transport.is_closing():
            self.transport.resume_reading()


def _time_of(work: Callable[[], None]) -> float:
    """Do some work, and return the time that it took the processor [s]."""
    began = time.thread_time()
    work()
    return time.thread_time() - began

"""WebSocket connections with limits on their number and on the time spent reading them."""

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
"""The greatest time that one read counts for its client, and for all clients together [s], so that
a large frame of one client delays reading the others only briefly."""
FRAME_COST = 5e-5
"""The time that a frame takes in addition to the measured time [s]."""
LARGE_FRAME = 2**16
"""The length from which a frame is large [characters]."""
LARGE_SHARE, LARGE_BURST = 0.02, 0.05
"""The budget for the large frames of all clients: the fraction of the wall time, and the longest
burst [s]. It limits also the first large frame of a new connection, for which the connection's own
budget comes too late. Large frames wait only for each other."""
MAX_SLEEP = 1.0
"""The longest time between two checks whether a client whose large frame waits has left [s]."""
PAUSE = 0.1
"""The pause of a client that has exceeded its share, in addition to the excess [s]. It limits how
often the server wakes, because the simulation then waits for Python's global lock."""


class ConnectionLimits:
    """The limits of the connections of one server.

    Args:
        share: the fraction of the wall time in which one connection is read.
        burst: the longest time of reading without a pause [s].
        work: the budget of all connections together; None: no limit.
        max_waiting: the maximum number of open connections that are not admitted yet; beyond it,
            the oldest of them is aborted (1 or more).
    """

    def __init__(
        self, share: float, burst: float, work: WorkBudget | None = None, max_waiting: int = 64
    ) -> None:
        self.share, self.burst, self.work = share, burst, work
        self._max_waiting = max_waiting
        self._open_connections: dict[LimitedConnection, None] = {}  # the oldest first
        self.large_frames = WorkBudget(LARGE_SHARE, LARGE_BURST)
        """The budget of the large frames of all connections together."""

    def add(self, connection: LimitedConnection) -> None:
        """Count a new connection; if too many wait, abort the oldest of those."""
        self._open_connections[connection] = None
        clients = [client for client in self._open_connections if client.state is State.CONNECTING]
        for client in clients[: -self._max_waiting]:
            self.discard(client)
            client.transport.abort()

    def discard(self, connection: LimitedConnection) -> None:
        """Stop counting a connection."""
        self._open_connections.pop(connection, None)

    def abort_all(self) -> None:
        """Abort every connection; the next iteration of the event loop closes its transport."""
        for connection in tuple(self._open_connections):
            connection.transport.abort()


class LimitedConnection(ServerConnection):
    """A connection that is not read for a while after it has exceeded its share.

    All data that arrive count, also control frames, which the library answers itself.

    Args:
        protocol: the protocol of the connection.
        server: the server of the connection.
        limits: the limits of the server.
        ping_interval: the time between two pings [s]; None: no pings.
        ping_timeout: the timeout of the answer to a ping [s]; None: no limit.
        close_timeout: the timeout of closing [s]; None: no limit.
        max_queue: the number of frames that may wait to be read.
        write_limit: the size of the write buffer [byte].
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
        self._budget = WorkBudget(limits.share, limits.burst)
        self.has_no_time_limit: Callable[[], bool] = lambda: False
        """The function that returns whether the connection has no time limit."""
        self.report_pause: Callable[[], None] = lambda: None
        """The function that is called when reading is paused."""

    def spend(self, seconds: float) -> None:
        """Count work for this connection [s], unless the connection has no time limit."""
        if self.has_no_time_limit():
            return
        self._budget.spend(min(seconds, MAX_COST))
        if self._limits.work is not None:
            self._limits.work.spend(min(seconds, MAX_SHARED_COST))

    async def handle(self, frame: str | bytes, handler: Callable[[str | bytes], None]) -> None:
        """Handle a frame when the budget allows it, then pause if the client exceeds its share."""
        is_large = len(frame) >= LARGE_FRAME and not self.has_no_time_limit()
        while is_large and (delay := self._limits.large_frames.delay) > 0.0:
            await asyncio.sleep(min(delay + PAUSE, MAX_SLEEP))
            if self.state is not State.OPEN:
                return
        duration = _measure_time(partial(handler, frame))
        if is_large:
            self._limits.large_frames.spend(duration)
        self.spend(FRAME_COST + duration)
        if (pause := self.pause) > 0.0:  # a flood waits in the sockets, not in memory
            self.report_pause()
            await asyncio.sleep(pause)

    @property
    def pause(self) -> float:
        """The time for which the connection is not read [s]; 0: it may be read now."""
        if self.has_no_time_limit():
            return 0.0
        shared_delay = 0.0 if self._limits.work is None else self._limits.work.delay
        delay = max(self._budget.delay, shared_delay)
        return delay + PAUSE if delay > 0.0 else 0.0

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Count the connection."""
        super().connection_made(transport)
        self._limits.add(self)

    def connection_lost(self, exc: Exception | None) -> None:
        """Stop counting the connection."""
        self._limits.discard(self)
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Read the data that have arrived, then pause if that took too long."""
        self.spend(_measure_time(partial(super().data_received, data)))
        if (pause := self.pause) > 0.0:
            self.report_pause()
            self.transport.pause_reading()
            self.loop.call_later(pause, self._resume_reading)

    def _resume_reading(self) -> None:
        """Read again, unless messages wait in the queue: the library resumes after those."""
        if not self.recv_messages.paused and not self.transport.is_closing():
            self.transport.resume_reading()


def _measure_time(work: Callable[[], None]) -> float:
    """Call a function, and return the processor time that it took [s]."""
    start_time = time.thread_time()
    work()
    return time.thread_time() - start_time

"""A program outside as an algorithm of the simulation: it is waited for at the end of each step."""

from __future__ import annotations

import json
import math
from collections import Counter, deque
from typing import Any

from ...bus import Node
from ...errors import ClientLost, NeverStarted
from ...messages import String
from ..bridge import Bridge
from .topics import ACK, JOIN, TICK

MAX_ROUNDS = 1000
"""Ticks of one step: a client that answers its own messages without end goes no further."""


class LockStepClient:
    """One client; an algorithm in the sense of `uwsim.bus.Algorithm`.

    Args:
        bridge: to the transport by which it comes.
        name: under which it joins.
        timestep: of the simulation [s].
        limit: how long it may take to join, and to answer a tick [s of wall time].
    """

    def __init__(self, bridge: Bridge, name: str, *, timestep: float, limit: float) -> None:
        self._bridge, self._name, self._timestep, self._limit = bridge, name, timestep, limit
        self._joins: deque[dict[str, Any]] = deque()
        self._acks: deque[dict[str, Any]] = deque()
        self._sent: Counter[str] = Counter()
        self._is_due, self._next_time = False, math.inf
        self._period = math.inf
        self._n_ticks = 0
        for topic, queue in ((JOIN, self._joins), (ACK, self._acks)):
            bridge.bus.subscribe(topic, String, _nothing)  # so that transports subscribe outside
            bridge.tap(topic, self._receiver(queue))
        bridge.bus.publisher(TICK, String)

    def start(self, node: Node) -> None:
        """Wait until the client has joined, and subscribe for it.

        Raises:
            NeverStarted: it did not join within the limit.
        """
        self._node = node
        bridge = self._bridge
        bridge.step()
        if not bridge.wait(lambda: bool(self._joins), self._limit):
            raise NeverStarted(
                f"No client {self._name!r} has joined within {self._limit:g} s of wall time "
                "(--client-limit)."
            )
        joined = self._joins.popleft()
        period = joined.get("period")
        if isinstance(period, int | float) and period > 0.0:
            self._period, self._next_time = float(period), node.now
        for topic in _texts(joined.get("topics")):
            node.subscribe(topic, object, self._counter(topic))
        node.every(self._timestep, self._barrier)

    @property
    def parameters(self) -> dict[str, float | str]:
        """Those of the client are its own."""
        return {}

    def _receiver(self, queue: deque[dict[str, Any]]) -> Any:
        def receive(message: object) -> None:
            found = _object_in(message)
            if found.get("client") == self._name:
                queue.append(found)

        return receive

    def _counter(self, topic: str) -> Any:
        def count(message: object) -> None:
            self._sent[topic] += 1
            self._is_due = True

        return count

    def _barrier(self) -> None:
        """Tick the client if something is due for it, and wait until it has answered."""
        node = self._node
        if node.now >= self._next_time - 0.5 * self._timestep:
            self._is_due = True
            n = math.floor((node.now + 0.5 * self._timestep) / self._period) + 1
            self._next_time = n * self._period
        for _ in range(MAX_ROUNDS):
            if not self._is_due:
                return
            self._is_due = False
            self._tick()
        raise ClientLost(f"Client {self._name!r} answers its own messages without end.")

    def _tick(self) -> None:
        bridge, now = self._bridge, self._node.now
        self._n_ticks += 1
        number = self._n_ticks
        tick = {"client": self._name, "tick": number, "time": now, "sent": dict(self._sent)}
        bridge.send(TICK, String(data=json.dumps(tick)))
        if not bridge.wait(lambda: self._is_answered(number), self._limit):
            raise ClientLost(
                f"Client {self._name!r} did not answer the tick at {now:g} s within "
                f"{self._limit:g} s of wall time (--client-limit): the run is invalid."
            )
        bridge.step()

    def _is_answered(self, number: int) -> bool:
        """Whether the ack of a tick is there, and all that it announces."""
        while self._acks and self._acks[0].get("tick") != number:
            self._acks.popleft()  # of an earlier tick, or of no tick
        for gone in self._joins:
            if gone.get("left"):
                now = self._node.now
                raise ClientLost(f"Client {self._name!r} left at {now:g} s: the run is invalid.")
        if not self._acks:
            return False
        published = self._acks[0].get("published")
        return not isinstance(published, dict) or all(
            self._bridge.n_arrived[str(topic).lstrip("/")] >= n
            for topic, n in published.items()
            if isinstance(n, int)
        )


def _nothing(message: object) -> None:
    """Read by a tap."""


def _object_in(message: object) -> dict[str, Any]:
    try:
        found = json.loads(message.data) if isinstance(message, String) else None
    except (ValueError, RecursionError):
        return {}
    return found if isinstance(found, dict) else {}


def _texts(value: object) -> list[str]:
    found = value if isinstance(value, list) else []
    return list(dict.fromkeys(each for each in found if isinstance(each, str)))

"""Lock-step over WebSocket for any Python program; needs `websockets` alone, not uwsim.

A program subscribes, advertises and offers services, then calls `run`. Messages are dicts, as in
JSON. Its callbacks run while simulation time waits. The simulation continues when all due callbacks
are done.
"""

from __future__ import annotations

import json
import math
import os
import secrets
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any

from websockets.exceptions import (
    ConnectionClosed,
    ConnectionClosedOK,
    InvalidHandshake,
    InvalidURI,
)
from websockets.sync.client import ClientConnection, connect

JOIN, TICK, ACK = (f"/uwsim/lockstep/{name}" for name in ("join", "tick", "ack"))
TEXT = "std_msgs/String"


class Client:
    """A client in lock-step.

    Args:
        socket: an open connection.
        name: the name of ``--client``.
        before_ack: called before each acknowledgement, for example to delay it.
    """

    def __init__(
        self, socket: ClientConnection, name: str, before_ack: Callable[[], None] = lambda: None
    ) -> None:
        self._socket, self._name, self._before_ack = socket, name, before_ack
        self._id = secrets.token_hex(4)  # distinguishes two clients of one name
        self._callbacks: dict[str, list[Callable[[Any], None]]] = {}
        self._handlers: dict[str, Callable[[Any], Any]] = {}
        self._queue: list[tuple[str, Any]] = []  # messages before their tick
        self._timers: list[tuple[list[float], Callable[[], None]]] = []
        self._n_calls = 0
        self.now = 0.0
        """The simulation time [s]."""

    def subscribe(self, topic: str, callback: Callable[[Any], None]) -> None:
        """Call ``callback`` with every message of a topic."""
        if topic not in self._callbacks:
            self._callbacks[topic] = []
            self._send(op="subscribe", topic=topic)
        self._callbacks[topic].append(callback)

    def publisher(self, topic: str, type: str) -> Callable[[Any], None]:
        """Return ``publish(message)`` for a topic."""
        self._send(op="advertise", topic=topic, type=type)
        return lambda message: self._send(op="publish", topic=topic, msg=message)

    def serve(self, name: str, type: str, handler: Callable[[Any], Any]) -> None:
        """Offer a service: ``handler`` takes the request and returns the response."""
        self._handlers[name] = handler
        self._send(op="advertise_service", service=name, type=type)

    def call(self, name: str, request: Any) -> Any:
        """Call a service and return its response; LookupError with the reason if it fails."""
        self._n_calls += 1
        number = f"call {self._n_calls}"
        self._send(op="call_service", id=number, service=name, args=request)
        while True:
            frame = self._receive()
            if frame.get("op") == "service_response" and frame.get("id") == number:
                if not frame["result"]:
                    raise LookupError(frame["values"])
                return frame["values"]
            self._handle(frame)

    def create_timer(self, period: float, callback: Callable[[], None]) -> None:
        """Call ``callback`` every ``period`` [s] of simulation time."""
        self._timers.append(([self.now, period, 0], callback))

    def run(self) -> None:
        """Join, and answer ticks until the simulation closes the connection."""
        self._send(op="advertise", topic=JOIN, type=TEXT)
        self._send(op="advertise", topic=ACK, type=TEXT)
        self._send(op="subscribe", topic=TICK)
        secret = os.environ.get("UWSIM_CLIENT_SECRET")  # if the simulation has one
        secret_fields = {} if secret is None else {"secret": secret}
        self._publish_json(JOIN, topics=list(self._callbacks), next=self._next(), **secret_fields)
        with suppress(ConnectionClosedOK):
            while True:
                self._handle(self._receive())

    def _handle(self, frame: dict[str, Any]) -> None:
        if frame["op"] == "call_service":
            values = self._handlers[frame["service"]](frame.get("args", {}))
            answer = {"service": frame["service"], "id": frame["id"], "values": values}
            self._send(op="service_response", result=True, **answer)
        elif frame["op"] == "publish" and frame["topic"] == TICK:
            self._tick(json.loads(frame["msg"]["data"]))
        elif frame["op"] == "publish":
            self._queue.append((frame["topic"], frame["msg"]))
        elif frame["op"] == "status":
            raise SystemExit(f"{self._name}: {frame['msg']}")

    def _tick(self, tick: dict[str, Any]) -> None:
        """Run the callbacks of messages in their order, then the due timers; then acknowledge."""
        if "error" in tick:
            if tick.get("id") == self._id:  # otherwise the error is of another client of this name
                raise SystemExit(f"{self._name}: {tick['error']}")
            return
        self.now = tick["time"]
        while self._queue:
            topic, message = self._queue.pop(0)
            for callback in self._callbacks[topic]:
                callback(message)
        for timer, callback in self._timers:
            if self.now >= _due(timer):
                timer[2] += 1
                callback()
        self._before_ack()
        self._publish_json(ACK, tick=tick["tick"], next=self._next())

    def _next(self) -> float | None:
        times = [_due(timer) for timer, _ in self._timers]
        return max(0.0, min(times)) if times else None

    def _publish_json(self, topic: str, **content: Any) -> None:
        text = json.dumps({"client": self._name, "id": self._id, **content})
        self._send(op="publish", topic=topic, msg={"data": text})

    def _send(self, **frame: Any) -> None:
        self._socket.send(json.dumps(frame))

    def _receive(self) -> Any:
        return json.loads(self._socket.recv())


def _due(timer: list[float]) -> float:
    start, period, n = timer
    return start + n * period - 1e-9 * period if math.isfinite(period) else math.inf


@contextmanager
def open_connection(uri: str, timeout: float = 60.0) -> Iterator[ClientConnection]:
    """Open a connection; retry until the simulation listens, at most ``timeout`` seconds.

    The block ends when the simulation closes the connection. If the connection fails or is lost,
    the program exits with one line and status 1.
    """
    deadline = time.monotonic() + timeout
    while True:
        try:
            connection = connect(uri, max_size=2**26, open_timeout=timeout)
            break
        except OSError as error:
            if time.monotonic() > deadline:
                raise SystemExit(f"{uri}: {error}") from None
            time.sleep(0.05)
        except (InvalidHandshake, InvalidURI) as error:
            raise SystemExit(f"{uri}: {error}") from None
    with connection as socket:
        try:
            yield socket
        except ConnectionClosedOK:
            return
        except ConnectionClosed as error:
            raise SystemExit(f"{uri}: the connection was lost: {error}") from None

"""The server of a live view: one port for the page and its socket, in a thread of its own.

The simulation hands over copies; whoever looks gets the newest of each kind, and what a slow
reader has missed is gone. Only this computer is listened to. A request needs the token of the
address that is printed; the socket, besides, the origin of the page.
"""

from __future__ import annotations

import asyncio
import hmac
import os
import secrets
import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from http import HTTPStatus
from typing import Any, cast
from urllib.parse import parse_qs, urlsplit

from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.datastructures import Headers
from websockets.exceptions import ConnectionClosed
from websockets.http11 import Request, Response

from ...base.peer_json import read_peer_json
from ...errors import BadSetting
from ...middleware.limited_connection import ConnectionLimits, LimitedConnection

HOST = "127.0.0.1"
MAX_MESSAGE = 4096
"""Of a viewer [byte]."""
MAX_MESSAGES = 120
"""Of a viewer in a second."""
SHARE, BURST = 0.05, 0.1
"""Share of the wall time in which a viewer is read, and the time at once [s]."""
MAX_VIEWERS = 16
MAX_WANTED = 16
"""Of cameras, and of topics, that a viewer gets."""
KEPT = 256
"""Messages of viewers that wait for the simulation."""
BUFFER = 64 * 1024
"""Of what is on its way to a viewer [byte]."""
CLOSING = 1.0
"""How long a viewer that is disconnected may take to answer [s]."""
START = 60.0
"""Longest time that the port takes to open [s]."""

Message = dict[str, Any]


@dataclass(eq=False)
class Viewer:
    """Somebody who looks."""

    number: int
    """Counts viewers from 1."""
    socket: ServerConnection
    """The connection."""
    wake: asyncio.Event = field(default_factory=asyncio.Event)
    """Set when there is something new."""
    sent: dict[str, int] = field(default_factory=dict)
    """Channel -> version that was sent last."""
    wanted: frozenset[str] = frozenset()
    """Optional channels that are wanted."""


class LiveServer:
    """Serves a page and what is published to everybody who looks.

    A *channel* is a name of which only the newest content is sent: text or bytes. Channels that
    begin with ``?`` go only to those who want them.

    Args:
        page: returns the HTML.
        port: 0: any that is free.

    Raises:
        BadSetting: the port is taken.
    """

    def __init__(self, page: Callable[[], str], port: int = 0) -> None:
        self._page, self._token = page, secrets.token_urlsafe(18)
        self._lock = threading.Lock()
        self._channels: dict[str, tuple[int, str | bytes]] = {}
        self._version = 0
        self._viewers: dict[int, Viewer] = {}
        self._n_viewers = 0
        self._limits = ConnectionLimits(SHARE, BURST)
        self._messages: deque[tuple[int, Message]] = deque(maxlen=KEPT)
        self._loop = asyncio.new_event_loop()
        self._stop = asyncio.Event()
        self._started = threading.Event()
        self._failure: OSError | None = None
        self.port = port
        """The port that is listened to."""
        self._thread = threading.Thread(target=self._run, name="live view", daemon=True)
        self._thread.start()
        self._started.wait(START)
        if self._failure is not None:
            self._thread.join(START)
            why = os.strerror(self._failure.errno or 0)  # asyncio's own text repeats the address
            raise BadSetting(f"--port {port}: cannot be opened: {why}.")

    @property
    def url(self) -> str:
        """What a browser opens."""
        return f"http://{HOST}:{self.port}/?token={self._token}"

    @property
    def n_viewers(self) -> int:
        """How many look now."""
        with self._lock:
            return len(self._viewers)

    def wanted(self) -> frozenset[str]:
        """Return the optional channels that anybody wants."""
        with self._lock:
            return frozenset().union(*(viewer.wanted for viewer in self._viewers.values()))

    def publish(self, channel: str, content: str | bytes) -> None:
        """Make something the newest of its channel; returns at once."""
        with self._lock:
            self._version += 1
            self._channels[channel] = self._version, content
            if not self._viewers:
                return
        self._call(self._wake)

    def forget(self, channels: Callable[[str], bool]) -> None:
        """Send nothing more of the channels that this chooses."""
        with self._lock:
            self._channels = {n: c for n, c in self._channels.items() if not channels(n)}

    def messages(self) -> list[tuple[int, Message]]:
        """Take out what viewers have said: number of the viewer, and message; oldest first."""
        with self._lock:
            taken = list(self._messages)
            self._messages.clear()
        return taken

    def drop(self, number: int, reason: str) -> None:
        """Disconnect one viewer; ``reason`` is what its browser shows."""
        with self._lock:
            viewer = self._viewers.get(number)
        if viewer is not None:
            socket = viewer.socket
            self._call(lambda: self._loop.create_task(socket.close(1008, reason[:100])))

    def close(self) -> None:
        """Disconnect everybody and close the port."""
        self._call(self._stop.set)
        self._thread.join(START)

    def _call(self, function: Callable[[], object]) -> None:
        try:
            self._loop.call_soon_threadsafe(function)
        except RuntimeError:  # the loop has been closed
            return

    def _run(self) -> None:
        asyncio.set_event_loop(self._loop)
        try:
            self._loop.run_until_complete(self._serve())
        finally:
            self._started.set()
            self._loop.close()

    async def _serve(self) -> None:
        try:
            server = await serve(
                self._talk,
                HOST,
                self.port,
                process_request=self._answer,
                create_connection=cast(Any, partial(LimitedConnection, limits=self._limits)),
                max_size=MAX_MESSAGE,
                max_queue=4,
                write_limit=BUFFER,
                compression=None,
                ping_interval=20.0,
                close_timeout=CLOSING,
            )
        except OSError as error:
            self._failure = error
            return
        self.port = _port_of(server)
        self._started.set()
        await self._stop.wait()
        server.close()
        await server.wait_closed()

    def _answer(self, connection: ServerConnection, request: Request) -> Response | None:
        """Answer what asks for the page; None lets a socket be opened."""
        try:
            return self._answer_to(request)
        except (ValueError, LookupError):  # an address of nonsense, two headers of one name
            return _text(HTTPStatus.BAD_REQUEST, "The request is not as it should be.")

    def _answer_to(self, request: Request) -> Response | None:
        address = urlsplit(request.path)
        token = parse_qs(address.query).get("token", [""])[0]
        if not hmac.compare_digest(token.encode(), self._token.encode()):
            return _text(HTTPStatus.FORBIDDEN, "The address lacks the token that was printed.")
        if address.path == "/":
            return _text(HTTPStatus.OK, self._page(), kind="text/html")
        if address.path != "/socket":
            return _text(HTTPStatus.NOT_FOUND, "There is nothing here.")
        origin = request.headers.get("Origin")
        if origin is not None and origin not in self._origins():
            return _text(HTTPStatus.FORBIDDEN, "The page comes from elsewhere.")
        if len(self._viewers) >= MAX_VIEWERS:
            return _text(HTTPStatus.SERVICE_UNAVAILABLE, "Too many look already.")
        return None

    def _origins(self) -> tuple[str, str]:
        return f"http://{HOST}:{self.port}", f"http://localhost:{self.port}"

    async def _talk(self, socket: ServerConnection) -> None:
        self._n_viewers += 1
        viewer = Viewer(number=self._n_viewers, socket=socket)
        viewer.wake.set()
        with self._lock:
            self._viewers[viewer.number] = viewer
        sender = asyncio.create_task(self._send(viewer))
        try:
            await self._listen(viewer)
        except ConnectionClosed:
            pass
        finally:
            sender.cancel()
            with self._lock:
                del self._viewers[viewer.number]
                self._messages.append((viewer.number, {"type": "left"}))

    async def _send(self, viewer: Viewer) -> None:
        """Send what is new; while the viewer reads slowly, newer things replace older ones."""
        try:
            while True:
                await viewer.wake.wait()
                viewer.wake.clear()
                for channel, version in self._news(viewer):
                    with self._lock:
                        now = self._channels.get(channel)
                    if now is not None:
                        viewer.sent[channel] = max(version, now[0])
                        await viewer.socket.send(now[1])
        except ConnectionClosed:
            return

    def _news(self, viewer: Viewer) -> list[tuple[str, int]]:
        """Channels with something new for a viewer, and its version; the oldest first."""
        with self._lock:
            new = [
                (version, channel)
                for channel, (version, _) in self._channels.items()
                if version > viewer.sent.get(channel, 0)
                and (not channel.startswith("?") or channel in viewer.wanted)
            ]
        return [(channel, version) for version, channel in sorted(new)]

    async def _listen(self, viewer: Viewer) -> None:
        """Take the viewer's messages; one who says too much, or nonsense, is disconnected."""
        began, n = self._loop.time(), 0
        async for text in viewer.socket:
            now = self._loop.time()
            if now - began >= 1.0:
                began, n = now, 0
            n += 1
            message = _message(text)
            if message is None or n > MAX_MESSAGES:
                why = "too many messages" if message is not None else "no such message"
                await viewer.socket.close(1008, why)
                return
            viewer.wanted = _wanted(message, viewer.wanted)
            with self._lock:
                self._messages.append((viewer.number, message))

    def _wake(self) -> None:
        for viewer in list(self._viewers.values()):
            viewer.wake.set()


def _port_of(server: Server) -> int:
    port: int = next(iter(server.sockets)).getsockname()[1]
    return port


def _wanted(message: Message, before: frozenset[str]) -> frozenset[str]:
    """Return the optional channels that a viewer wants after a message."""
    for kind, key, prefix in (("images", "cameras", "?image/"), ("topics", "names", "?topic/")):
        names = message.get(key)
        if message["type"] == kind and isinstance(names, list):
            kept = {channel for channel in before if not channel.startswith(prefix)}
            chosen = {f"{prefix}{name}" for name in names[:MAX_WANTED] if isinstance(name, str)}
            return frozenset(kept | chosen)
    return before


def _message(text: str | bytes) -> Message | None:
    """Read a message; None if it is none."""
    if not isinstance(text, str):
        return None
    try:
        message = read_peer_json(text)
    except ValueError:
        return None
    return message if isinstance(message, dict) and isinstance(message.get("type"), str) else None


def _text(status: HTTPStatus, text: str, kind: str = "text/plain") -> Response:
    body = text.encode()
    headers = Headers(
        {
            "Content-Type": f"{kind}; charset=utf-8",
            "Content-Length": str(len(body)),
            "Cache-Control": "no-store",
            "Referrer-Policy": "no-referrer",
            "X-Content-Type-Options": "nosniff",
            "Connection": "close",
        }
    )
    return Response(status.value, status.phrase, headers, body)

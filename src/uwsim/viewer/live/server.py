"""The server of a live view: one port for the page and its WebSocket, in a separate thread.

The simulation publishes copies of its state on channels. Each viewer receives the newest content of
each channel; a slow viewer misses older content. The server listens on the loopback interface only.
A request needs the token of the printed address; the WebSocket also needs the origin of the page.
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
"""The greatest size of a viewer's message [byte]."""
MAX_MESSAGES = 120
"""The greatest number of messages that a viewer may send in a second."""
READING_FRACTION = 0.05
"""The greatest fraction of the wall time for reading the messages of one viewer [1]."""
READING_BURST = 0.1
"""The longest time for reading the messages of one viewer without a pause [s]."""
MAX_VIEWERS = 16
MAX_REQUESTED = 16
"""The greatest number of cameras, and also of topics, that a viewer receives."""
MAX_WAITING = 256
"""The greatest number of messages that wait for the simulation."""
WRITE_BUFFER = 64 * 1024
"""The size of the write buffer of a viewer [byte]."""
CLOSE_TIMEOUT = 1.0
"""The longest wait for a viewer's answer to the closing handshake [s]."""
START_TIMEOUT = 60.0
"""The longest wait until the port is open [s]."""

Message = dict[str, Any]
"""A message of a viewer, in a format of `uwsim.viewer.head`; ``type`` is ``left`` after its end."""


@dataclass(eq=False)
class Viewer:
    """A connected page."""

    number: int
    """The number of the viewer, from 1."""
    socket: ServerConnection
    """The connection."""
    wake: asyncio.Event = field(default_factory=asyncio.Event)
    """The event that is set when a channel has new content."""
    sent_versions: dict[str, int] = field(default_factory=dict)
    """The version that was sent last, by channel."""
    channels: frozenset[str] = frozenset()
    """The optional channels that the viewer has requested."""


class LiveServer:
    """The server of a page and of the content that is published to its viewers.

    A *channel* has a name, and its newest content as text or bytes. Channels whose names begin with
    ``?`` are optional: they are sent only to viewers that request them.

    Args:
        page: the function that returns the HTML.
        port: the port; 0 selects a free one.

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
        self._limits = ConnectionLimits(READING_FRACTION, READING_BURST)
        self._messages: deque[tuple[int, Message]] = deque(maxlen=MAX_WAITING)
        self._loop = asyncio.new_event_loop()
        self._stop = asyncio.Event()
        self._start_event = threading.Event()
        self._failure: OSError | None = None
        self.port = port
        """The port that the server listens on."""
        self._thread = threading.Thread(target=self._run, name="live view", daemon=True)
        self._thread.start()
        self._start_event.wait(START_TIMEOUT)
        if self._failure is not None:
            self._thread.join(START_TIMEOUT)
            reason = os.strerror(self._failure.errno or 0)  # asyncio's text repeats the address
            raise BadSetting(f"--port {port}: cannot be opened: {reason}.")

    @property
    def url(self) -> str:
        """The address of the page for a browser."""
        return f"http://{HOST}:{self.port}/?token={self._token}"

    @property
    def n_viewers(self) -> int:
        """The present number of viewers."""
        with self._lock:
            return len(self._viewers)

    def channels(self) -> frozenset[str]:
        """Return the optional channels that any viewer requests."""
        with self._lock:
            return frozenset().union(*(viewer.channels for viewer in self._viewers.values()))

    def publish(self, channel: str, content: str | bytes) -> None:
        """Replace the content of a channel; return at once."""
        with self._lock:
            self._version += 1
            self._channels[channel] = self._version, content
            if not self._viewers:
                return
        self._call(self._wake)

    def remove_channels(self, channels: Callable[[str], bool]) -> None:
        """Remove the channels for whose name the function returns True."""
        with self._lock:
            self._channels = {n: c for n, c in self._channels.items() if not channels(n)}

    def pop_messages(self) -> list[tuple[int, Message]]:
        """Remove and return the messages of viewers, oldest first, with the viewers' numbers."""
        with self._lock:
            messages = list(self._messages)
            self._messages.clear()
        return messages

    def disconnect(self, number: int, reason: str) -> None:
        """Disconnect one viewer; its browser shows the ``reason``."""
        with self._lock:
            viewer = self._viewers.get(number)
        if viewer is not None:
            socket = viewer.socket
            self._call(lambda: self._loop.create_task(socket.close(1008, reason[:100])))

    def close(self) -> None:
        """Disconnect all viewers and close the port."""
        self._call(self._stop.set)
        self._thread.join(START_TIMEOUT)

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
            self._start_event.set()
            self._loop.close()

    async def _serve(self) -> None:
        try:
            server = await serve(
                self._handle_socket,
                HOST,
                self.port,
                process_request=self._handle_request,
                create_connection=cast(Any, partial(LimitedConnection, limits=self._limits)),
                max_size=MAX_MESSAGE,
                max_queue=4,
                write_limit=WRITE_BUFFER,
                compression=None,
                ping_interval=20.0,
                close_timeout=CLOSE_TIMEOUT,
            )
        except OSError as error:
            self._failure = error
            return
        self.port = _port_of(server)
        self._start_event.set()
        await self._stop.wait()
        server.close()
        await server.wait_closed()

    def _handle_request(self, connection: ServerConnection, request: Request) -> Response | None:
        """Return the response to a request for the page; None accepts a WebSocket."""
        try:
            return self._check_request(request)
        except (ValueError, LookupError):  # an invalid address, or a repeated header
            return _text_response(HTTPStatus.BAD_REQUEST, "The request is invalid.")

    def _check_request(self, request: Request) -> Response | None:
        address = urlsplit(request.path)
        token = parse_qs(address.query).get("token", [""])[0]
        if not hmac.compare_digest(token.encode(), self._token.encode()):
            return _text_response(
                HTTPStatus.FORBIDDEN,
                "The token is missing or wrong. Open the address that uwsim has printed.",
            )
        if address.path == "/":
            return _text_response(HTTPStatus.OK, self._page(), kind="text/html")
        if address.path != "/socket":
            return _text_response(HTTPStatus.NOT_FOUND, "There is no such page.")
        origin = request.headers.get("Origin")
        if origin is not None and origin not in self._origins():
            return _text_response(
                HTTPStatus.FORBIDDEN, "The request comes from a page of another origin."
            )
        if len(self._viewers) >= MAX_VIEWERS:
            return _text_response(HTTPStatus.SERVICE_UNAVAILABLE, "There are too many viewers.")
        return None

    def _origins(self) -> tuple[str, str]:
        return f"http://{HOST}:{self.port}", f"http://localhost:{self.port}"

    async def _handle_socket(self, socket: ServerConnection) -> None:
        self._n_viewers += 1
        viewer = Viewer(number=self._n_viewers, socket=socket)
        viewer.wake.set()
        with self._lock:
            self._viewers[viewer.number] = viewer
        sender = asyncio.create_task(self._send(viewer))
        try:
            await self._receive(viewer)
        except ConnectionClosed:
            pass
        finally:
            sender.cancel()
            with self._lock:
                del self._viewers[viewer.number]
                self._messages.append((viewer.number, {"type": "left"}))

    async def _send(self, viewer: Viewer) -> None:
        """Send new content to a viewer; if it is slow, newer content replaces older content."""
        try:
            while True:
                await viewer.wake.wait()
                viewer.wake.clear()
                for channel, version in self._new_versions(viewer):
                    with self._lock:
                        now = self._channels.get(channel)
                    if now is not None:
                        viewer.sent_versions[channel] = max(version, now[0])
                        await viewer.socket.send(now[1])
        except ConnectionClosed:
            return

    def _new_versions(self, viewer: Viewer) -> list[tuple[str, int]]:
        """Return the channels with new content for a viewer, with their versions, oldest first."""
        with self._lock:
            versions = [
                (version, channel)
                for channel, (version, _) in self._channels.items()
                if version > viewer.sent_versions.get(channel, 0)
                and (not channel.startswith("?") or channel in viewer.channels)
            ]
        return [(channel, version) for version, channel in sorted(versions)]

    async def _receive(self, viewer: Viewer) -> None:
        """Receive a viewer's messages; disconnect it if they are too many or invalid."""
        start, n = self._loop.time(), 0
        async for text in viewer.socket:
            now = self._loop.time()
            if now - start >= 1.0:
                start, n = now, 0
            n += 1
            message = _parse_message(text)
            if message is None or n > MAX_MESSAGES:
                reason = "too many messages" if message is not None else "invalid message"
                await viewer.socket.close(1008, reason)
                return
            viewer.channels = _requested_channels(message, viewer.channels)
            with self._lock:
                self._messages.append((viewer.number, message))

    def _wake(self) -> None:
        for viewer in list(self._viewers.values()):
            viewer.wake.set()


def _port_of(server: Server) -> int:
    port: int = next(iter(server.sockets)).getsockname()[1]
    return port


def _requested_channels(message: Message, channels: frozenset[str]) -> frozenset[str]:
    """Return the optional channels that a viewer requests, after it has sent a message.

    Args:
        message: the message.
        channels: the optional channels that it has requested before.
    """
    for kind, key, prefix in (("images", "cameras", "?image/"), ("topics", "names", "?topic/")):
        names = message.get(key)
        if message["type"] == kind and isinstance(names, list):
            rest = {channel for channel in channels if not channel.startswith(prefix)}
            texts = (name for name in names[:MAX_REQUESTED] if isinstance(name, str))
            return frozenset(rest | {f"{prefix}{name}" for name in texts})
    return channels


def _parse_message(text: str | bytes) -> Message | None:
    if not isinstance(text, str):
        return None
    try:
        message = read_peer_json(text)
    except ValueError:
        return None
    return message if isinstance(message, dict) and isinstance(message.get("type"), str) else None


def _text_response(status: HTTPStatus, text: str, kind: str = "text/plain") -> Response:
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

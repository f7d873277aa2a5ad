"""The WebSocket server, in a thread of its own, and the bridge between the server and the bus."""

from __future__ import annotations

import asyncio
import hmac
import http
import re
import threading
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from contextlib import suppress
from functools import partial
from typing import Any, cast
from urllib.parse import parse_qs, urlsplit

from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.datastructures import Headers
from websockets.exceptions import ConnectionClosed
from websockets.http11 import Request, Response

from ...base.message_fields import size_of
from ...bus import Bus, TopicEndpoints
from ...errors import BadSetting
from ...messages.services import Service
from ..bridge import Bridge, TransportTraits
from ..limited_connection import ConnectionLimits, LimitedConnection
from ..log import Log
from ..stamps import clock_time
from ..types import message_class, ros2_store
from ..work_budget import WorkBudget
from .client_services import ClientServices
from .graph import WebGraph
from .options import WebOptions
from .outgoing import EncodedMessage
from .readers import CLOCK, WebReaders
from .republications import Republications
from .session import Session, SessionParts

LOCAL_PAGES = re.compile(r"https?://(localhost|127\.0\.0\.1|\[::1\])(:\d+)?")
"""The pattern of the origins of pages on this computer, which may always connect."""
MAX_FRAME = 16 * 2**20
"""The maximum length of a client's frame [bytes]."""
SMALL_FRAME = 2**20
"""The maximum length of a frame of clients beyond the first `N_LARGE` [bytes], which bounds the
memory for unfinished frames."""
N_LARGE = 8
"""The number of clients that may send frames up to `MAX_FRAME`."""
MAX_FRAMES = 2
"""The maximum number of waiting frames of one client; while they wait, no more are read."""
CLIENT_SHARE, CLIENT_BURST = 0.02, 0.05
"""The budget for reading one client: the fraction of the wall time, and the longest burst [s]."""
ALL_SHARE, ALL_BURST = 0.04, 0.1
"""The budget for reading all clients together, as for one client. One read counts in it
for at most `limited_connection.MAX_SHARED_COST`. It does not apply to clients for which a run in
lock-step waits."""
MAX_CLIENTS = 64
"""The maximum number of clients."""
PING_INTERVAL, PING_TIMEOUT = 20.0, 300.0
"""The interval of pings, and the time limit for the pongs that answer them [s]."""
CLOSE_TIMEOUT = 2.0
"""The timeout of closing [s of wall time]."""


class WebBridge(Bridge):
    """A server of the topics and services of a bus for web clients.

    Args:
        bus: the bus of the simulation.
        clock: a function that returns the simulation time [s].
        options: the address, and the clients that may connect.
        log: the log for events.

    Raises:
        BadSetting: the server cannot listen on the address.
    """

    traits = TransportTraits(relays_between_clients=True)

    def __init__(
        self, bus: Bus, clock: Callable[[], float], options: WebOptions, log: Log | None = None
    ) -> None:
        super().__init__(bus, clock, log or Log("web"))
        self._options = options
        self._sessions: set[Session] = set()
        self.graph = WebGraph(clock, self._sessions, bus.hidden_reason)
        """The topics and services that clients can query."""
        self._readers = WebReaders(self.graph, self.subscribers, self.clock_topic)
        self._client_services = ClientServices(self.external_services, lambda: self.admission)
        self._republications = Republications(self.subscribers, self._readers, clock)
        self._parts = SessionParts(
            graph=self.graph,
            readers=self._readers,
            services=self._client_services,
            republications=self._republications,
        )
        self._limits = ConnectionLimits(
            CLIENT_SHARE, CLIENT_BURST, WorkBudget(ALL_SHARE, ALL_BURST)
        )
        self._loop = asyncio.new_event_loop()
        self._port_future: Future[int] = Future()
        self._end_event: asyncio.Event | None = None
        self._begin_event, self._has_begun = asyncio.Event(), False
        self._thread = threading.Thread(target=self._run, name="uwsim web", daemon=True)
        self._thread.start()
        try:
            self.port = self._port_future.result()
            """The port of the server."""
        except OSError as error:
            self._thread.join()
            raise BadSetting(
                f"--web {options.port}: cannot listen on {options.host}: {error.strerror or error}."
            ) from None
        self.log.report(f"listening on ws://{options.host}:{self.port}", kind="listening")

    def on_topics(self, topics: Mapping[str, TopicEndpoints]) -> None:
        """Store the topics of the bus for the clients."""
        self.graph.topics = dict(topics)

    def on_services(self, services: Mapping[str, Service]) -> None:
        """Store the services of the bus for the clients."""
        self.graph.services = dict(services)

    def send(self, topic: str, message: object) -> None:
        """Send a message to all readers of its topic."""
        self._readers.send(topic, message)
        self._republications.send(topic, message)

    def send_to(self, client_name: str, topic: str, message: object) -> None:
        """Send a message to one client, if it reads the topic."""
        content = EncodedMessage(topic, message, size_of(message))
        self._readers.post(topic, content, client_name=client_name)

    def _tick(self) -> None:
        """Publish the time if it is due; at the first step boundary, begin to serve clients.

        Before that, the topics on the bus are not known.
        """
        if not self._has_begun:
            self._has_begun = True
            self._loop.call_soon_threadsafe(self._begin_event.set)
        super()._tick()

    def _publish_clock(self) -> None:
        if CLOCK in self._readers and CLOCK not in self.graph.topics:
            clock = message_class("rosgraph_msgs/Clock")
            self.send(CLOCK, clock(clock=clock_time(self.clock_topic.time())))

    def _clock_is_read(self) -> bool:
        return CLOCK in self._readers

    def has_publisher(self, topic: str) -> bool:
        """Return whether a client has advertised ``topic``."""
        return any(session.has_advertised(topic) for session in tuple(self._sessions))

    def report_error(self, client_name: str, text: str) -> None:
        """Send an error to a client, as a status message."""
        for session in tuple(self._sessions):
            if session.name == client_name:
                session.reply({"op": "status", "level": "error", "msg": text})

    def call_external_service(self, name: str, request: object) -> Future[object]:
        """Call a service of a client."""
        return self._client_services.call(name, request)

    def close(self) -> None:
        """Close all connections and the port."""
        if self._end_event is not None:
            with suppress(RuntimeError):
                self._loop.call_soon_threadsafe(self._end_event.set)
        self._thread.join(2 * CLOSE_TIMEOUT)
        super().close()

    def _run(self) -> None:
        asyncio.set_event_loop(self._loop)
        try:
            self._loop.run_until_complete(self._listen())
        except OSError as error:
            self._port_future.set_exception(error)
        finally:
            tasks = asyncio.all_tasks(self._loop)  # of clients that have not closed the connection
            for task in tasks:
                task.cancel()
            self._loop.run_until_complete(asyncio.gather(*tasks, return_exceptions=True))
            self._limits.abort_all()  # clients that do not read, or have sent no request yet
            self._loop.run_until_complete(self._loop.shutdown_asyncgens())
            self._loop.close()

    async def _listen(self) -> None:
        self._end_event = asyncio.Event()
        ros2_store()  # loaded now, as later the time would count as work for a client
        options = self._options
        server = await serve(
            self._serve_client,
            options.host,
            options.port,
            origins=[None, LOCAL_PAGES, *(re.compile(re.escape(o)) for o in options.origins)],
            process_request=self._check_request,
            create_connection=cast(Any, partial(LimitedConnection, limits=self._limits)),
            max_size=MAX_FRAME,
            max_queue=MAX_FRAMES,
            ping_interval=PING_INTERVAL,
            ping_timeout=PING_TIMEOUT,
            close_timeout=CLOSE_TIMEOUT,
            server_header=None,
            compression=None,
        )
        self._port_future.set_result(server.sockets[0].getsockname()[1])
        await self._end_event.wait()
        await _stop_accepting(server)
        server.close(code=1001, reason="the simulation has ended")
        self._begin_event.set()  # release clients that still wait for the first step
        with suppress(TimeoutError):
            await asyncio.wait_for(server.wait_closed(), CLOSE_TIMEOUT)

    def _check_request(self, connection: ServerConnection, request: Request) -> Response | None:
        """Refuse clients without a valid token, and clients beyond the maximum number."""
        if len(self._sessions) >= MAX_CLIENTS:
            self.log.report(f"more than {MAX_CLIENTS} clients; one is refused")
            return connection.respond(http.HTTPStatus.SERVICE_UNAVAILABLE, "Too many clients.\n")
        token = self._options.token
        if token and not hmac.compare_digest(_token_of(request), token.encode()):
            self.log.report(f"a client at {_peer(connection)} was refused: no valid token")
            return connection.respond(http.HTTPStatus.UNAUTHORIZED, "A token is required.\n")
        return None

    async def _serve_client(self, connection: ServerConnection) -> None:
        """Serve one client until it disconnects."""
        assert isinstance(connection, LimitedConnection)
        name = f"client {_peer(connection)}"
        session = Session(self, self._parts, self._loop, name)
        self._sessions.add(session)
        self.log.report(f"{name} connected", kind="connected")
        writer = asyncio.create_task(_write(connection, session))
        connection.has_no_time_limit = lambda: session.is_waited_for
        connection.report_pause = lambda: self.log.report(
            f"{name} sends faster than the server reads; its frames are delayed", kind="flood"
        )
        protocol = connection.protocol
        if len(self._sessions) > N_LARGE:
            protocol.max_message_size = min(protocol.max_message_size or MAX_FRAME, SMALL_FRAME)
        try:
            await self._begin_event.wait()
            async for frame in connection:
                await connection.handle(frame, session.handle)
        except ConnectionClosed:
            pass
        finally:
            writer.cancel()
            session.close()
            if self.admission is not None:
                self.admission.remove(name)
            self._sessions.discard(session)
            reason = connection.close_reason or connection.close_code or "its connection broke"
            self.log.report(f"{name} disconnected ({reason})", kind="disconnected")


async def _stop_accepting(server: Server) -> None:
    """Accept no more clients, and let asyncio make the transports of clients just accepted.

    If the server closes before that, asyncio never closes these (python/cpython#109564).
    """
    loop = asyncio.get_running_loop()
    for listener in server.sockets:
        loop.remove_reader(listener.fileno())
    await asyncio.sleep(0.0)


async def _write(connection: ServerConnection, session: Session) -> None:
    with suppress(ConnectionClosed):
        while True:
            await connection.send(await session.next_frame())


def _token_of(request: Request) -> bytes:
    """Return the token of a request; empty if the token is missing or cannot be read."""
    headers: Headers = request.headers
    try:
        token = parse_qs(urlsplit(request.path).query).get("token", [""])[0]
        token = token or headers.get("Authorization", "").removeprefix("Bearer ").strip()
        return token.encode(errors="surrogateescape")
    except (ValueError, LookupError):  # an invalid address, or two headers with one name
        return b""


def _peer(connection: ServerConnection) -> str:
    address = connection.remote_address
    return f"{address[0]}:{address[1]}" if address else "unknown"

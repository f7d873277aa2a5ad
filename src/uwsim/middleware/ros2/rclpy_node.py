"""A node of rclpy: on whatever middleware the user's ROS 2 runs, services included.

Messages go out and come in as CDR bytes; only requests and responses of services are objects of
rclpy on their way. One thread (``uwsim-ros2``) spins the node. Endpoints are made in the thread of
the simulation and destroyed in that of the node, so that none goes while it is waited for.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Hashable
from concurrent.futures import Future
from typing import Any, ClassVar, cast

import rclpy.task
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.exceptions import InvalidHandle
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message, serialize_message

from ...environment import environment
from ...errors import BadMessage, UwsimError
from ..encodings import from_cdr, to_cdr
from ..log import Log
from ..queues import MAX_ITEMS
from ..types import WireService, service_of, wire_service
from .node import BytesWriter, Call, Endpoint
from .quality import Quality
from .rclpy_types import RclpyTypes
from .settings import NODE, Ros2Settings

LINGER_S = 1.0
"""How long the last messages may take to be acknowledged at the end [s]."""
DISCOVERY_S = 10.0
"""How long a service that is called may take to be connected [s]."""
GLANCE_S = 0.005
"""How often it is looked whether it is [s]."""


class RclpyNode:
    """A node of rclpy.

    Args:
        settings: which domain, and on which network.
        log: where events are reported.

    Raises:
        UwsimError: the domain cannot be joined.
    """

    lease: ClassVar[str] = "for a while"
    """Each middleware has its own; Fast DDS 20 s."""

    def __init__(self, settings: Ros2Settings, log: Log) -> None:
        self._log, self._types = log, RclpyTypes()
        self._context = Context()
        try:
            with environment(settings.variables):
                self._context.init([], initialize_logging=False, domain_id=settings.domain)
                self._node: Any = Node(
                    NODE,
                    context=self._context,
                    use_global_arguments=False,
                    enable_rosout=False,
                    start_parameter_services=False,
                )
        except Exception as error:  # whatever a middleware raises
            raise UwsimError(
                f"--ros2: rclpy cannot join domain {settings.domain}: {error} (UWSIM_ROS2=dds does "
                "without rclpy)"
            ) from error
        self._group = ReentrantCallbackGroup()
        self._echoes: dict[str, Echoes] = {}
        self._clients: dict[str, Any] = {}
        self._writers: list[RclpyWriter] = []
        self._is_open = True
        self.error: BaseException | None = None
        """What ended the thread, if anything did."""
        self._executor: Any = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._thread = threading.Thread(target=self._spin, name="uwsim-ros2", daemon=True)
        self._thread.start()

    def writer(
        self, topic: str, type: type, quality: Quality, on_readers: Callable[[int], None]
    ) -> BytesWriter:
        """Make a writer."""
        found = self._types.message(type, topic)
        if found is None:
            return Nowhere()
        echoes = self._echoes_of(topic)
        made = RclpyWriter(self, echoes, is_latched=quality.is_latched)
        events = PublisherEventCallbacks(matched=lambda _: made.look(), use_default_callbacks=False)
        made.publisher = self._node.create_publisher(
            found,
            f"/{topic}",
            profile(quality),
            callback_group=self._group,
            event_callbacks=events,
        )
        self._writers.append(made)
        made.follow(on_readers)
        return made

    def reader(
        self,
        topic: str,
        type: type,
        quality: Quality,
        receive: Callable[[bytes], None],
        on_refused: Callable[[], None],
    ) -> Endpoint:
        """Make a reader."""
        found = self._types.message(type, topic)
        if found is None:
            return Nowhere()
        echoes = self._echoes_of(topic)

        def take(data: bytes) -> None:
            if not echoes.is_own(data):
                receive(data)

        events = SubscriptionEventCallbacks(
            incompatible_qos=lambda _: on_refused(), use_default_callbacks=False
        )
        subscription = self._node.create_subscription(
            found,
            f"/{topic}",
            take,
            profile(quality),
            raw=True,
            callback_group=self._group,
            event_callbacks=events,
        )
        echoes.n_readers += 1
        self._count_readers(topic)
        return RclpyReader(self, subscription, topic)

    def server(self, name: str, kind: WireService, call: Call) -> Endpoint:
        """Offer a service."""
        found = self._types.service(kind, name)
        if found is None:
            return Nowhere()
        service = self._node.create_service(
            found, f"/{name}", self._answering(name, kind, found, call), callback_group=self._group
        )
        return RclpyServer(self, service)

    def _answering(self, name: str, kind: WireService, found: Any, call: Call) -> Any:
        """Return what answers a request of rclpy once the simulation has."""

        async def answer(asked: Any, _: Any) -> Any:
            try:
                request: object = from_cdr(kind.service.request, serialize_message(asked))
                response = await self._answered(call(request))
            except UwsimError as error:
                self._log.say(f"service /{name}: no answer: {error}", kind=name)
                raise Unanswered from error
            return deserialize_message(bytes(to_cdr(response)), found.Response)

        return answer

    def _answered(self, response: Future[object]) -> Any:
        """Return what can be awaited in the node's thread for a response of the simulation."""
        waiting: Any = rclpy.task.Future()

        def pass_on(_: Future[object]) -> None:
            if response.exception() is None:
                waiting.set_result(response.result())
            else:
                waiting.set_exception(response.exception())
            self._executor.wake()

        response.add_done_callback(pass_on)
        return waiting

    def tell(self) -> None:
        """Report what is not on the graph, as rclpy has no type for it."""
        for line in self._types.faults():
            self._log.say(line)

    def offers(self, name: str) -> bool:
        """Whether a service is offered on the graph, by this node or another."""
        return any(found == f"/{name}" for found, _ in self._node.get_service_names_and_types())

    def call(self, name: str, request: object) -> Future[object]:
        """Call a service of another node.

        Raises:
            UwsimError: rclpy has no such type, or nobody answers at the other end.
        """
        service = service_of(cast(Hashable, request.__class__))
        if service is None:
            raise UwsimError(f"Service /{name}: {type(request).__name__} has no definition.")
        kind = wire_service(service)
        client = self._client(name, kind)
        asked = deserialize_message(bytes(to_cdr(request)), client.srv_type.Request)
        future: Future[object] = Future()

        def pass_on(answered: Any) -> None:
            try:
                found = serialize_message(answered.result())
                future.set_result(from_cdr(kind.service.response, found))
            except (BadMessage, RuntimeError) as error:
                future.set_exception(UwsimError(f"Service /{name}: {error}"))

        client.call_async(asked).add_done_callback(pass_on)
        return future

    def _client(self, name: str, kind: WireService) -> Any:
        if name not in self._clients:
            found = self._types.service(kind, name)
            self.tell()
            if found is None:
                raise UwsimError(f"Service /{name}: rclpy has no type {kind.ros2_name}.")
            self._clients[name] = self._node.create_client(
                found, f"/{name}", callback_group=self._group
            )
        client = self._clients[name]
        end = time.monotonic() + DISCOVERY_S
        while not client.service_is_ready():
            if time.monotonic() > end:
                raise UwsimError(f"Service /{name}: not connected within {DISCOVERY_S:g} s.")
            time.sleep(GLANCE_S)
        return client

    def close(self) -> None:
        """Leave the graph, when the last messages have been acknowledged."""
        if not self._is_open:
            return
        end = time.monotonic() + LINGER_S
        for writer in self._writers:
            writer.wait(end - time.monotonic())
        self._executor.create_task(self._stop)
        self._thread.join()
        self._node.destroy_node()
        self._executor.shutdown()
        self._context.try_shutdown()

    def destroy(self, destroy: Callable[[Any], object], entity: Any) -> None:
        """Destroy an endpoint in the thread of the node."""
        self._executor.create_task(destroy, entity)

    def drop_writer(self, writer: RclpyWriter) -> None:
        """Take a writer off the graph."""
        self._writers.remove(writer)
        self.destroy(self._node.destroy_publisher, writer.publisher)

    def drop_reader(self, subscription: Any, topic: str) -> None:
        """Take a reader off the graph."""
        self._echoes_of(topic).n_readers -= 1
        self.destroy(self._node.destroy_subscription, subscription)
        self._count_readers(topic)

    def drop_server(self, service: Any) -> None:
        """Offer a service no more."""
        self.destroy(self._node.destroy_service, service)

    def _echoes_of(self, topic: str) -> Echoes:
        return self._echoes.setdefault(topic, Echoes())

    def _count_readers(self, topic: str) -> None:
        for writer in self._writers:
            if writer.echoes is self._echoes_of(topic):
                writer.look()

    def _stop(self) -> None:
        self._is_open = False

    def _spin(self) -> None:
        """Call callbacks until `close`."""
        try:
            while self._is_open:
                try:
                    self._executor.spin_once()
                except (Unanswered, InvalidHandle):  # told already; gone meanwhile
                    continue
        except ExternalShutdownException:
            return
        except BaseException as error:  # reported by the owner; a thread has nobody to raise to
            self.error = error


class Unanswered(Exception):
    """A call of a service has no answer; rclpy has no other way to send none."""


class Echoes:
    """What this node has sent on a topic that it reads as well: rclpy gives it back to it.

    Messages are compared by their bytes. Of two equal ones it does not matter which was whose.
    """

    def __init__(self) -> None:
        self.n_readers = 0
        """Readers of this node."""
        self._sent: deque[int] = deque(maxlen=MAX_ITEMS)
        self._lock = threading.Lock()

    def add(self, data: bytes) -> None:
        """Note what is being sent."""
        with self._lock:
            self._sent.append(hash(data))

    def is_own(self, data: bytes) -> bool:
        """Whether a message that has come is one of ours, and forget it."""
        if not self._sent:
            return False
        with self._lock:
            try:
                self._sent.remove(hash(data))
            except ValueError:
                return False
            return True


class Nowhere:
    """An endpoint of a type that rclpy does not have."""

    def write(self, data: bytes) -> bool:
        """Nobody reads it."""
        return True

    def close(self) -> None:
        """There is nothing to close."""


class RclpyWriter:
    """A publisher, and how many others read it."""

    publisher: Any

    def __init__(self, node: RclpyNode, echoes: Echoes, *, is_latched: bool) -> None:
        self._node, self.echoes, self._is_latched = node, echoes, is_latched
        self._on_readers: Callable[[int], None] = lambda n: None
        self._n, self._lock = 0, threading.Lock()

    def follow(self, on_readers: Callable[[int], None]) -> None:
        """Have ``on_readers`` called with the number of readers outside, when it changes."""
        self._on_readers = on_readers
        self.look()

    def look(self) -> None:
        """Count the readers outside."""
        with self._lock:
            try:
                n = max(0, self.publisher.get_subscription_count() - self.echoes.n_readers)
            except (InvalidHandle, AttributeError):  # gone already, or not there yet
                return
            if n != self._n:
                self._n = n
                self._on_readers(n)

    def write(self, data: bytes) -> bool:
        """Publish a message; the middleware keeps the newest for readers that are behind."""
        if self._is_latched or self.echoes.n_readers:
            self.echoes.add(data)
        try:
            self.publisher.publish(data)
        except InvalidHandle:  # gone meanwhile
            return True
        except RuntimeError as error:
            raise UwsimError(f"rclpy refuses a message: {error}") from error
        return True

    def wait(self, limit_s: float) -> None:
        """Wait until readers have acknowledged what was sent, at most ``limit_s``."""
        self.publisher.wait_for_all_acked(Duration(seconds=max(0.0, limit_s)))

    def close(self) -> None:
        """Take it off the graph."""
        self._node.drop_writer(self)


class RclpyReader:
    """A subscription."""

    def __init__(self, node: RclpyNode, subscription: Any, topic: str) -> None:
        self._node, self._subscription, self._topic = node, subscription, topic

    def close(self) -> None:
        """Take it off the graph."""
        self._node.drop_reader(self._subscription, self._topic)


class RclpyServer:
    """A service."""

    def __init__(self, node: RclpyNode, service: Any) -> None:
        self._node, self._service = node, service

    def close(self) -> None:
        """Offer it no more."""
        self._node.drop_server(self._service)


def profile(quality: Quality) -> Any:
    """Return a quality of service for rclpy."""
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST if quality.depth else HistoryPolicy.KEEP_ALL,
        depth=quality.depth,
        reliability=ReliabilityPolicy.RELIABLE
        if quality.is_reliable
        else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL
        if quality.is_latched
        else DurabilityPolicy.VOLATILE,
    )

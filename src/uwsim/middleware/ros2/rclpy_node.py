"""A node on rclpy, with the middleware of the user's ROS 2 installation.

Messages are sent and received as CDR bytes; only requests and responses of services are converted
to objects of rclpy. One thread (``uwsim-ros2``) spins the node. Endpoints are made in the thread of
the simulation, and destroyed in the thread of the node, so that no endpoint is destroyed while the
node waits for it.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from functools import partial
from typing import Any, ClassVar

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.context import Context
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.exceptions import InvalidHandle
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node

from ...base.environment import set_environment
from ...errors import UwsimError
from ..log import Log
from ..types import WireService
from .node import BytesReader, BytesWriter, Call, Endpoint, Receive
from .quality import Quality
from .rclpy_endpoints import Echoes, NullEndpoint, RclpyReader, RclpyWriter, profile
from .rclpy_services import NoAnswer, RclpyServices
from .rclpy_types import RclpyTypes
from .settings import NODE, Ros2Settings

LINGER_S = 1.0
"""The time limit for the acknowledgement of the last messages at the end [s]."""
UNKNOWN_NAME = "_NODE_NAME_UNKNOWN_"
"""The name that rclpy gives a node whose name it has not discovered yet."""


class RclpyNode:
    """A node on rclpy.

    Args:
        settings: the domain and the network interfaces.
        log: the log for events.

    Raises:
        UwsimError: the domain cannot be joined.
    """

    lease: ClassVar[str] = "for a while"
    """The time after which a silent node counts as gone, which depends on the middleware."""

    def __init__(self, settings: Ros2Settings, log: Log) -> None:
        self._log, self._types = log, RclpyTypes()
        self._context = Context()
        try:
            with set_environment(settings.variables):
                self._context.init([], initialize_logging=False, domain_id=settings.domain)
                self._node: Any = Node(
                    NODE,
                    context=self._context,
                    use_global_arguments=False,
                    enable_rosout=False,
                    start_parameter_services=False,
                )
        except Exception as error:  # a middleware may raise anything
            raise UwsimError(
                f"--ros2: rclpy cannot join domain {settings.domain}: {error} (UWSIM_ROS2=dds does "
                "without rclpy)"
            ) from error
        self._group = ReentrantCallbackGroup()
        self._echoes: dict[str, Echoes] = {}
        self._writers: list[RclpyWriter] = []
        self._is_open = True
        self.error: BaseException | None = None
        """The error that ended the thread; None if it runs."""
        self._executor: Any = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._services = RclpyServices(self._node, self._executor, self._group, self._types, log)
        self._thread = threading.Thread(target=self._spin, name="uwsim-ros2", daemon=True)
        self._thread.start()

    def writer(
        self, topic: str, type: type, quality: Quality, on_readers: Callable[[int], None]
    ) -> BytesWriter:
        """Make a writer; ``on_readers`` is called with the number of external readers."""
        message_type = self._types.message(type, topic)
        if message_type is None:
            return NullEndpoint()
        echoes = self._echoes_of(topic)
        writer = RclpyWriter(self._drop_writer, echoes, is_latched=quality.is_latched)
        events = PublisherEventCallbacks(
            matched=lambda _: writer.count_readers(), use_default_callbacks=False
        )
        writer.publisher = self._node.create_publisher(
            message_type,
            f"/{topic}",
            profile(quality),
            callback_group=self._group,
            event_callbacks=events,
        )
        self._writers.append(writer)
        writer.follow(on_readers)
        return writer

    def reader(
        self,
        topic: str,
        type: type,
        quality: Quality,
        receive: Receive,
        on_refused: Callable[[], None],
    ) -> BytesReader:
        """Make a reader; ``on_refused`` is called for a writer with an insufficient quality."""
        message_type = self._types.message(type, topic)
        if message_type is None:
            return NullEndpoint()
        reader = RclpyReader(partial(self._drop_reader, topic), partial(self._n_writers, topic))

        def take(data: bytes) -> None:
            if reader.is_open and not self._echoes_of(topic).is_own(data):
                receive(data)

        events = SubscriptionEventCallbacks(
            incompatible_qos=lambda _: on_refused(), use_default_callbacks=False
        )
        reader.subscription = self._node.create_subscription(
            message_type,
            f"/{topic}",
            take,
            profile(quality),
            raw=True,
            callback_group=self._group,
            event_callbacks=events,
        )
        self._count_readers(topic, 1)
        return reader

    def server(self, name: str, kind: WireService, call: Call) -> Endpoint:
        """Offer a service."""
        return self._services.server(name, kind, call)

    def announce_endpoints(self) -> None:
        """Report the topics and services for which rclpy has no type."""
        for line in self._types.faults():
            self._log.report(line)

    def offers(self, name: str) -> bool:
        """Return whether a service is offered on the graph."""
        return self._services.offers(name)

    def call(self, name: str, request: object) -> Future[object]:
        """Call a service of another node; raise UwsimError if it cannot be called."""
        return self._services.call(name, request)

    def publishers(self, topic: str) -> list[str]:
        """Return the names of the other nodes that publish a topic."""
        publishers = self._node.get_publishers_info_by_topic(f"/{topic}")
        names = {
            f"{publisher.node_namespace.rstrip('/')}/{publisher.node_name}"
            for publisher in publishers
            if publisher.node_name != UNKNOWN_NAME  # messages can come before the node's name
        }
        return sorted(names - {f"/{NODE}"})

    def close(self) -> None:
        """Leave the graph, after the last messages have been acknowledged."""
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

    def _n_writers(self, topic: str) -> int:
        return sum(writer.echoes is self._echoes_of(topic) for writer in self._writers)

    def _drop_writer(self, writer: RclpyWriter) -> None:
        self._writers.remove(writer)
        self._executor.create_task(self._node.destroy_publisher, writer.publisher)

    def _drop_reader(self, topic: str, subscription: Any) -> None:
        def drop() -> None:
            self._node.destroy_subscription(subscription)
            self._count_readers(topic, -1)

        self._executor.create_task(drop)

    def _echoes_of(self, topic: str) -> Echoes:
        return self._echoes.setdefault(topic, Echoes())

    def _count_readers(self, topic: str, change: int) -> None:
        """Update the counts of external readers after a reader of this node has come or gone."""
        echoes = self._echoes_of(topic)
        echoes.count_reader(change)
        for writer in list(self._writers):
            if writer.echoes is echoes:
                writer.count_readers()

    def _stop(self) -> None:
        self._is_open = False

    def _spin(self) -> None:
        try:
            while self._is_open:
                try:
                    self._executor.spin_once()
                except (NoAnswer, InvalidHandle):  # reported already; destroyed meanwhile
                    continue
        except ExternalShutdownException:
            return
        except BaseException as error:  # reported by the bridge, as a thread has no caller
            self.error = error

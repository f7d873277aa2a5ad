"""A node of rclpy: on whatever middleware the user's ROS 2 runs, services included.

Messages go out and come in as CDR bytes; only requests and responses of services are objects of
rclpy on their way. One thread (``uwsim-ros2``) spins the node. Endpoints are made in the thread of
the simulation and destroyed in that of the node, so that none goes while it is waited for.
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
from .rclpy_endpoints import Echoes, Nowhere, RclpyReader, RclpyWriter, profile
from .rclpy_services import RclpyServices, Unanswered
from .rclpy_types import RclpyTypes
from .settings import NODE, Ros2Settings

LINGER_S = 1.0
"""How long the last messages may take to be acknowledged at the end [s]."""
UNKNOWN = "_NODE_NAME_UNKNOWN_"
"""What rclpy calls a node whose endpoints it has found and whose name it has not."""


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
            with set_environment(settings.variables):
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
        self._writers: list[RclpyWriter] = []
        self._is_open = True
        self.error: BaseException | None = None
        """What ended the thread, if anything did."""
        self._executor: Any = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._services = RclpyServices(self._node, self._executor, self._group, self._types, log)
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
        made = RclpyWriter(self._drop_writer, echoes, is_latched=quality.is_latched)
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
        receive: Receive,
        on_refused: Callable[[], None],
    ) -> BytesReader:
        """Make a reader."""
        found = self._types.message(type, topic)
        if found is None:
            return Nowhere()
        made = RclpyReader(partial(self._drop_reader, topic), partial(self._n_writers, topic))

        def take(data: bytes) -> None:
            if made.is_open and not self._echoes_of(topic).is_own(data):
                receive(data)

        events = SubscriptionEventCallbacks(
            incompatible_qos=lambda _: on_refused(), use_default_callbacks=False
        )
        made.subscription = self._node.create_subscription(
            found,
            f"/{topic}",
            take,
            profile(quality),
            raw=True,
            callback_group=self._group,
            event_callbacks=events,
        )
        self._count_readers(topic, 1)
        return made

    def server(self, name: str, kind: WireService, call: Call) -> Endpoint:
        """Offer a service."""
        return self._services.server(name, kind, call)

    def tell(self) -> None:
        """Report what is not on the graph, as rclpy has no type for it."""
        for line in self._types.faults():
            self._log.report(line)

    def offers(self, name: str) -> bool:
        """Whether a service is offered on the graph."""
        return self._services.offers(name)

    def call(self, name: str, request: object) -> Future[object]:
        """Call a service of another node; raises UwsimError."""
        return self._services.call(name, request)

    def publishers(self, topic: str) -> list[str]:
        """Names of the other nodes that publish a topic."""
        found = self._node.get_publishers_info_by_topic(f"/{topic}")
        names = {
            f"{each.node_namespace.rstrip('/')}/{each.node_name}"
            for each in found
            if each.node_name != UNKNOWN  # its messages can come before its name
        }
        return sorted(names - {f"/{NODE}"})

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

    def _n_writers(self, topic: str) -> int:
        """How many of this node's own write a topic."""
        return sum(writer.echoes is self._echoes_of(topic) for writer in self._writers)

    def _drop_writer(self, writer: RclpyWriter) -> None:
        """Take a writer off the graph."""
        self._writers.remove(writer)
        self._executor.create_task(self._node.destroy_publisher, writer.publisher)

    def _drop_reader(self, topic: str, subscription: Any) -> None:
        """Take a reader off the graph."""

        def drop() -> None:
            self._node.destroy_subscription(subscription)
            self._count_readers(topic, -1)

        self._executor.create_task(drop)

    def _echoes_of(self, topic: str) -> Echoes:
        return self._echoes.setdefault(topic, Echoes())

    def _count_readers(self, topic: str, change: int) -> None:
        """Have the writers of a topic count readers outside after one here has come or gone."""
        echoes = self._echoes_of(topic)
        echoes.count_reader(change)
        for writer in list(self._writers):
            if writer.echoes is echoes:
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

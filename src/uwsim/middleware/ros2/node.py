"""What the adapter needs of a node of ROS 2: endpoints that take and give bytes, and services.

There are two: `uwsim.middleware.ros2.rclpy_node`, with ROS 2, and `uwsim.middleware.ros2.dds_node`,
without. Topics and services have no leading slash here.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from typing import ClassVar, Protocol

from ..types import WireService
from .quality import Quality


class Receive(Protocol):
    """Takes in an encoded message, its CDR header included."""

    def __call__(self, data: bytes, sender: str = "") -> None:
        """``sender``: who sent it; empty where the node cannot tell."""


class Call(Protocol):
    """Hands a request to the simulation; returns the response to come."""

    def __call__(self, request: object, sender: str = "") -> Future[object]:
        """``sender``: who calls; empty where the node cannot tell."""


class Endpoint(Protocol):
    """A reader, a writer or the server of a service."""

    def close(self) -> None:
        """Take it off the graph."""


class BytesReader(Endpoint, Protocol):
    """A reader of encoded messages."""

    @property
    def n_writers(self) -> int:
        """How many writers outside it reads."""


class BytesWriter(Endpoint, Protocol):
    """A writer of messages that are encoded already."""

    def write(self, data: bytes) -> bool:
        """Write a message, its CDR header included; whether it was accepted.

        Raises:
            UwsimError: it cannot be sent.
        """


class Ros2Node(Protocol):
    """A node; its callbacks come in a thread of its own."""

    lease: ClassVar[str]
    """How long another node may be silent before it counts as gone, as ``for 10 s``."""

    @property
    def error(self) -> BaseException | None:
        """What ended its thread, if anything did."""

    def writer(
        self, topic: str, type: type, quality: Quality, on_readers: Callable[[int], None]
    ) -> BytesWriter:
        """Make a writer of a class of the bus; ``on_readers(n)``: so many outside read it now."""

    def reader(
        self,
        topic: str,
        type: type,
        quality: Quality,
        receive: Receive,
        on_refused: Callable[[], None],
    ) -> BytesReader:
        """Make a reader of messages from outside.

        ``receive(data)`` has each with its CDR header. ``on_refused()``: there is a writer whose
        quality of service does not suffice.
        """

    def server(self, name: str, kind: WireService, call: Call) -> Endpoint:
        """Offer a service."""

    def tell(self) -> None:
        """Make known which endpoints there are; called after some have been made or closed."""

    def offers(self, name: str) -> bool:
        """Whether another node offers a service that this one can call."""

    def call(self, name: str, request: object) -> Future[object]:
        """Call a service of another node; raises UwsimError."""

    def publishers(self, topic: str) -> list[str]:
        """Names of the other nodes that publish a topic, where they are known."""

    def close(self) -> None:
        """Leave the graph, with all endpoints."""

"""The protocol of a node of ROS 2 for the adapter: endpoints for bytes, and services.

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
    """A function that accepts an encoded message, its CDR header included."""

    def __call__(self, data: bytes, sender: str = "") -> None:
        """Accept a message; ``sender`` is empty if the node cannot tell it."""


class Call(Protocol):
    """A function that passes a request to the simulation; returns the future of the response."""

    def __call__(self, request: object, sender: str = "") -> Future[object]:
        """Pass on a request; ``sender`` is empty if the node cannot tell it."""


class Endpoint(Protocol):
    """A reader, a writer or the server of a service."""

    def close(self) -> None:
        """Remove the endpoint from the graph."""


class BytesReader(Endpoint, Protocol):
    """A reader of encoded messages."""

    @property
    def n_writers(self) -> int:
        """The number of external writers that match it."""


class BytesWriter(Endpoint, Protocol):
    """A writer of messages that are encoded already."""

    def write(self, data: bytes) -> bool:
        """Write a message, its CDR header included; return whether it was accepted.

        Raises:
            UwsimError: it cannot be sent.
        """


class Ros2Node(Protocol):
    """A node; its callbacks are called in a thread of its own."""

    lease: ClassVar[str]
    """The time after which a silent node counts as gone, as ``for 10 s``."""

    @property
    def error(self) -> BaseException | None:
        """The error that ended its thread, if any."""

    def writer(
        self, topic: str, type: type, quality: Quality, on_readers: Callable[[int], None]
    ) -> BytesWriter:
        """Make a writer of a class of the bus; ``on_readers(n)`` gets the number of readers."""

    def reader(
        self,
        topic: str,
        type: type,
        quality: Quality,
        receive: Receive,
        on_refused: Callable[[], None],
    ) -> BytesReader:
        """Make a reader of messages from outside.

        ``receive(data)`` has each with its CDR header. ``on_refused()``: the quality of service of
        a writer does not suffice.
        """

    def server(self, name: str, kind: WireService, call: Call) -> Endpoint:
        """Offer a service."""

    def announce_endpoints(self) -> None:
        """Announce the endpoints; called after some have been made or closed."""

    def offers(self, name: str) -> bool:
        """Return whether another node offers a service that this one can call."""

    def call(self, name: str, request: object) -> Future[object]:
        """Call a service of another node; raise UwsimError."""

    def publishers(self, topic: str) -> list[str]:
        """Return the names of the other nodes that publish a topic, if they are known."""

    def close(self) -> None:
        """Leave the graph, with all endpoints."""

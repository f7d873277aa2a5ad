"""The protocol of a node of ROS 2, as the adapter uses it: endpoints for bytes, and services.

Two classes implement it: `RclpyNode` with ROS 2, and `DdsNode` without. The names of topics and
services have no leading slash here.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from typing import ClassVar, Protocol

from ..types import WireService
from .quality import Quality


class Receive(Protocol):
    """A function that accepts an encoded message, including the CDR header."""

    def __call__(self, data: bytes, sender: str = "") -> None:
        """Accept a message; ``sender`` is empty if the node does not know the sender."""


class Call(Protocol):
    """A function that passes a request to the simulation and returns the future of the response."""

    def __call__(self, request: object, sender: str = "") -> Future[object]:
        """Pass on a request; ``sender`` is empty if the node does not know the sender."""


class Endpoint(Protocol):
    """A reader, a writer or the server of a service."""

    def close(self) -> None:
        """Remove the endpoint from the graph."""


class BytesReader(Endpoint, Protocol):
    """A reader of encoded messages."""

    @property
    def n_writers(self) -> int:
        """The number of external writers that match the reader."""


class BytesWriter(Endpoint, Protocol):
    """A writer of encoded messages."""

    def write(self, data: bytes) -> bool:
        """Write a message, including the CDR header; return whether it was accepted.

        Raises:
            UwsimError: the message cannot be sent.
        """


class Ros2Node(Protocol):
    """A node; the callbacks are called in the thread of the node."""

    lease: ClassVar[str]
    """The time after which a silent node counts as gone, as text: ``for 10 s``."""

    @property
    def error(self) -> BaseException | None:
        """The error that ended the thread of the node; None if it runs."""

    def writer(
        self, topic: str, type: type, quality: Quality, on_readers: Callable[[int], None]
    ) -> BytesWriter:
        """Make a writer of messages of a class of the bus.

        ``on_readers(n)`` is called with the number of external readers, when it changes.
        """

    def reader(
        self,
        topic: str,
        type: type,
        quality: Quality,
        receive: Receive,
        on_refused: Callable[[], None],
    ) -> BytesReader:
        """Make a reader of messages from outside.

        ``receive(data)`` is called with each message. ``on_refused()`` is called if the quality of
        service of a writer does not suffice.
        """

    def server(self, name: str, kind: WireService, call: Call) -> Endpoint:
        """Offer a service; ``call`` passes each request to the simulation."""

    def announce_endpoints(self) -> None:
        """Announce the endpoints of the node; called after some have been made or closed."""

    def offers(self, name: str) -> bool:
        """Return whether another node offers a service that this node can call."""

    def call(self, name: str, request: object) -> Future[object]:
        """Call a service of another node; raise UwsimError if it cannot be called."""

    def publishers(self, topic: str) -> list[str]:
        """Return the names of the other nodes that publish a topic, if they are known."""

    def close(self) -> None:
        """Leave the graph, with all endpoints."""

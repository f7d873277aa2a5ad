"""Protocols: what the session of a web client uses of the bridge, and the bridge of a session."""

from __future__ import annotations

import math
from collections.abc import Mapping
from concurrent.futures import Future
from dataclasses import dataclass, field
from typing import Protocol

from ...messages.services import Service
from ..admission import Admission
from ..log import Log
from .outgoing import Outgoing
from .queue import Lane


@dataclass(eq=False)
class Subscription:
    """A topic that the client reads."""

    topic: str
    """Without a leading slash."""
    lane: Lane
    """What waits to be sent."""
    throttle: float
    """Shortest time between two messages [s of wall time]."""
    ids: set[str | None] = field(default_factory=set)
    """The ids under which the client has subscribed."""
    last: float = -math.inf
    """When the last message was sent [s of wall time]."""
    source: str = ""
    """The topic of the bus that its messages are made of."""

    def __post_init__(self) -> None:
        self.source = self.source or self.topic


class Client(Protocol):
    """A client, as the bridge sees it."""

    @property
    def name(self) -> str:
        """Its name in the log."""

    def post(self, subscription: Subscription, message: Outgoing) -> None:
        """Send a message of a subscription. Any thread."""

    def call(self, name: str, request: object) -> Future[object]:
        """Call a service that it offers. Any thread."""

    def reply(self, content: dict[str, object]) -> None:
        """Send an object, behind what waits already. Any thread."""


class Graph(Protocol):
    """Topics, services and clients, as rosapi describes them."""

    services: Mapping[str, Service]

    def clock(self) -> float:
        """Return the simulation time [s]."""

    def types(self) -> dict[str, str]:
        """Return topic -> name of its type in ROS 2, sorted by topic."""

    def is_published(self, topic: str) -> bool:
        """Whether anybody publishes a topic."""

    def is_subscribed(self, topic: str) -> bool:
        """Whether anybody in the simulation reads a topic."""

    def clients_publishing(self, topic: str) -> list[str]:
        """Return the clients that have advertised a topic, as names of nodes."""

    def clients_reading(self, topic: str) -> list[str]:
        """Return the clients that have subscribed to a topic, as names of nodes."""


class SessionBridge(Graph, Protocol):
    """The bridge, as the session of a client uses it. In the thread of the server."""

    log: Log
    admission: Admission | None

    def type_of(self, topic: str) -> type | None:
        """Return the class of the messages of a topic; None if it is not known."""

    def put(self, topic: str, message: object, by: str = "") -> None:
        """Take in a message of a client."""

    def read(self, topic: str, session: Client, subscription: Subscription) -> None:
        """Begin a subscription."""

    def unread(self, topic: str, session: Client, subscription: Subscription) -> None:
        """End a subscription."""

    def service_named(self, name: str) -> Service:
        """Return the type of a service of the bus; UnknownName if it is not there."""

    def request(self, name: str, request: object, by: str = "") -> Future[object]:
        """Call a service of the bus."""

    def offer_of(self, name: str, service: Service, session: Client) -> None:
        """Offer a service of a client."""

    def withdraw_of(self, name: str, session: Client) -> None:
        """Withdraw a service of a client."""

    def republish(self, arguments: object, session: Client, goal: str = "") -> str:
        """Publish transforms for a client; returns the topic."""

    def cancel_republication(self, goal: str) -> None:
        """End the transforms for a goal."""

    def end_republications(self, session: Client) -> None:
        """Publish no more transforms for a client."""

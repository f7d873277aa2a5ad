"""Protocols of the bridge for the session of a web client, and of the session for the bridge."""

from __future__ import annotations

import math
from concurrent.futures import Future
from dataclasses import dataclass, field
from typing import Protocol

from ..admission import Admission
from ..log import Log
from .outgoing import EncodedMessage
from .queue import Lane


@dataclass(eq=False)
class Subscription:
    """A topic that the client reads."""

    topic: str
    """The topic, without a leading slash."""
    lane: Lane
    """The messages that wait to be sent."""
    throttle: float
    """The shortest time between two messages [s of wall time]."""
    ids: set[str | None] = field(default_factory=set)
    """The ids under which the client has subscribed."""
    last_time: float = -math.inf
    """The time at which the last message was sent [s of wall time]."""
    source: str = ""
    """The topic of the bus from which its messages are made."""

    def __post_init__(self) -> None:
        self.source = self.source or self.topic


class Client(Protocol):
    """A client, as the bridge uses it."""

    @property
    def name(self) -> str:
        """The name of the client in the log."""

    def has_advertised(self, topic: str) -> bool:
        """Return whether it has advertised a topic. Any thread."""

    def has_subscribed(self, topic: str) -> bool:
        """Return whether it has subscribed to a topic. Any thread."""

    def post(self, subscription: Subscription, message: EncodedMessage) -> None:
        """Send a message of a subscription. Any thread."""

    def call(self, name: str, request: object) -> Future[object]:
        """Call a service that the client offers. Any thread."""

    def reply(self, content: dict[str, object]) -> None:
        """Send an object, after all that waits already. Any thread."""


class SessionBridge(Protocol):
    """The bridge, as the session of a client uses it. In the thread of the server."""

    log: Log
    admission: Admission | None

    def put(self, topic: str, message: object, sender: str = "") -> None:
        """Accept a message of a client."""

    def request(self, name: str, request: object, sender: str = "") -> Future[object]:
        """Call a service of the bus."""

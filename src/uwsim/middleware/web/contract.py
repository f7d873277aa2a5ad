"""Protocols: what the session of a web client uses of the bridge, and the bridge of a session."""

from __future__ import annotations

import math
from concurrent.futures import Future
from dataclasses import dataclass, field
from typing import Protocol

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

    def advertises(self, topic: str) -> bool:
        """Whether it has said that it publishes a topic. Any thread."""

    def reads(self, topic: str) -> bool:
        """Whether it has subscribed to a topic. Any thread."""

    def post(self, subscription: Subscription, message: Outgoing) -> None:
        """Send a message of a subscription. Any thread."""

    def call(self, name: str, request: object) -> Future[object]:
        """Call a service that it offers. Any thread."""

    def reply(self, content: dict[str, object]) -> None:
        """Send an object, behind what waits already. Any thread."""


class SessionBridge(Protocol):
    """The bridge, as the session of a client uses it. In the thread of the server."""

    log: Log
    admission: Admission | None

    def put(self, topic: str, message: object, sender: str = "") -> None:
        """Take in a message of a client."""

    def request(self, name: str, request: object, sender: str = "") -> Future[object]:
        """Call a service of the bus."""

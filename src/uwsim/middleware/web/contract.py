"""The protocol of the bridge as a client's session uses it, and of a session as the bridge does."""

from __future__ import annotations

import math
from concurrent.futures import Future
from dataclasses import dataclass, field
from typing import Protocol

from ..admission import Admission
from ..log import Log
from .outgoing import EncodedMessage
from .queue import SubscriptionQueue


@dataclass(eq=False)
class Subscription:
    """The subscription of a client to a topic."""

    topic: str
    """The topic, without a leading slash."""
    queue: SubscriptionQueue
    """The queue of messages to send."""
    throttle: float
    """The shortest time between two messages [s of wall time]."""
    ids: set[str | None] = field(default_factory=set)
    """The ids under which the client has subscribed."""
    last_time: float = -math.inf
    """The time at which the last message was sent [s of wall time]."""
    source: str = ""
    """The topic of the bus from which the messages are made: for compressed images, another one."""

    def __post_init__(self) -> None:
        self.source = self.source or self.topic


class Client(Protocol):
    """A client, as the bridge uses it."""

    @property
    def name(self) -> str:
        """The name of the client in the log."""

    def has_advertised(self, topic: str) -> bool:
        """Return whether the client has advertised a topic. May be called from any thread."""

    def has_subscribed(self, topic: str) -> bool:
        """Return whether the client has subscribed to a topic. May be called from any thread."""

    def post(self, subscription: Subscription, message: EncodedMessage) -> None:
        """Send a message of a subscription, unless its throttle forbids it.

        May be called from any thread.
        """

    def call(self, name: str, request: object) -> Future[object]:
        """Call a service that the client offers. May be called from any thread."""

    def reply(self, content: dict[str, object]) -> None:
        """Send a JSON object, after all messages that wait already.

        May be called from any thread.
        """


class SessionBridge(Protocol):
    """The bridge, as the session of a client uses it in the thread of the server."""

    log: Log
    """The log of the transport."""
    admission: Admission | None
    """The rule that decides which programs may publish and call; None: all programs."""

    def put(self, topic: str, message: object, sender: str = "") -> None:
        """Accept a message of a client."""

    def request(self, name: str, request: object, sender: str = "") -> Future[object]:
        """Call a service of the bus."""

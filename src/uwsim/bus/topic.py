"""A topic: its message type, subscribers and publishers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

OBSERVER = object()
"""The owner of subscribers that only observe, such as a recorder; they are no endpoints."""

Remark = tuple[str, str]
"""The value found in a message, and the value expected with the consequence."""


@dataclass
class Topic:
    """A topic of the bus."""

    type: type | None = None
    """The class of the messages; None before the first endpoint with a type."""
    callbacks: list[Callable[[Any], None]] = field(default_factory=list)
    """The functions that are called with each message."""
    subscribers: list[object] = field(default_factory=list)
    """The owner of each callback; None if it has none."""
    uncounted_callbacks: list[Callable[[Any], None]] = field(default_factory=list)
    """The callbacks of subscriptions that are not counted as subscribers."""
    checks: list[Callable[[Any], None]] = field(default_factory=list)
    """The functions that check a message when it is published."""
    remarks: list[Callable[[Any], Remark | None]] = field(default_factory=list)
    """The functions that may return a remark on a message when it is published."""
    expectations_reported: set[str] = field(default_factory=set)
    """The expected values in the remarks so far."""
    publishers: list[object] = field(default_factory=list)
    """The owners of publishers, each once; None if one has none."""
    is_latched: bool = False
    """The newest message is stored for later inboxes."""
    unread_message: Any = None
    """The newest message that was published without a subscriber."""
    make_unread_message: Callable[[], Any] | None = None
    """A function that creates this message on request, in place of ``unread_message``."""

    def format_new_remark(self, remark: Remark | None) -> str | None:
        """Return a remark as text if its expected value was not reported before; else None."""
        if remark is None or remark[1] in self.expectations_reported:
            return None
        self.expectations_reported.add(remark[1])
        return "; expected ".join(remark)

    def endpoints(self, ignored_owner: object) -> TopicEndpoints | None:
        """Return the endpoints without one owner and observers; None without a type."""
        if self.type is None:
            return None
        return TopicEndpoints(
            self.type,
            is_published=any(
                owner is None or owner is not ignored_owner for owner in self.publishers
            ),
            is_read=any(
                owner is None or (owner is not ignored_owner and owner is not OBSERVER)
                for owner in self.subscribers
            ),
        )


@dataclass(frozen=True)
class TopicEndpoints:
    """The message type of a topic, and the presence of publishers and subscribers."""

    type: type
    """The class of the messages."""
    is_published: bool
    """The topic has a publisher."""
    is_read: bool
    """The topic has a subscriber."""

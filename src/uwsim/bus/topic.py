"""A topic: its message type, subscribers and publishers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

OBSERVER = object()
"""The owner of subscribers that only observe, such as a recorder; `endpoints` ignores them."""

Remark = tuple[str, str]
"""Two texts: the value found in a message; the value expected, with the consequence."""


@dataclass
class Topic:
    """A topic of the bus."""

    type: type | None = None
    """The class of the messages; None before the first endpoint with a type."""
    callbacks: list[Callable[[Any], None]] = field(default_factory=list)
    """The functions that are called with each message."""
    subscribers: list[object] = field(default_factory=list)
    """The owner of each callback; None for a callback without an owner."""
    uncounted_callbacks: list[Callable[[Any], None]] = field(default_factory=list)
    """The callbacks of subscriptions that are not counted as subscribers."""
    checks: list[Callable[[Any], None]] = field(default_factory=list)
    """The functions that check a message when it is published."""
    remarks: list[Callable[[Any], Remark | None]] = field(default_factory=list)
    """The functions that may return a remark on a message when it is published."""
    reported_expectations: set[str] = field(default_factory=set)
    """The second texts of the remarks so far; each is reported once."""
    publishers: list[object] = field(default_factory=list)
    """The owners of publishers, each once; None for publishers without an owner."""
    is_latched: bool = False
    """True if the newest message is stored for later inboxes."""
    unread_message: Any = None
    """The newest message that was published without a subscriber."""
    make_unread_message: Callable[[], Any] | None = None
    """A function that creates the newest message on request, in place of ``unread_message``."""

    def format_new_remark(self, remark: Remark | None) -> str | None:
        """Return a remark as text if its expected value was not reported before; else None."""
        if remark is None or remark[1] in self.reported_expectations:
            return None
        self.reported_expectations.add(remark[1])
        return "; expected ".join(remark)

    def endpoints(self, ignored_owner: object) -> TopicEndpoints | None:
        """Return whether the topic has publishers and subscribers; None if it has no type yet.

        The endpoints of ``ignored_owner`` and of observers are not counted.
        """
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
    """The message type of a topic, and whether it has publishers and subscribers."""

    type: type
    """The class of the messages."""
    is_published: bool
    """True if the topic has a publisher."""
    is_read: bool
    """True if the topic has a subscriber."""

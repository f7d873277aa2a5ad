"""A topic: what it carries, who reads it and who publishes on it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

OBSERVER = object()
"""Owner of those who only listen to what others publish, as a recorder: at no end of a topic."""

Remark = tuple[str, str]
"""What was found in a message, and what was expected, with what becomes of it."""


@dataclass
class Topic:
    """A topic as the bus keeps it."""

    type: type | None = None
    """Class of its messages; None before the first reader or writer."""
    readers: list[Callable[[Any], None]] = field(default_factory=list)
    """Who is called with each message."""
    owners: list[object] = field(default_factory=list)
    """Who reads, of each reader; None for anyone."""
    hearers: list[Callable[[Any], None]] = field(default_factory=list)
    """Who hears what there is, and counts as no reader."""
    checks: list[Callable[[Any], None]] = field(default_factory=list)
    """What is called while a message is published."""
    remarks: list[Callable[[Any], Remark | None]] = field(default_factory=list)
    """What is asked while a message is published: whether it is odd."""
    said: set[str] = field(default_factory=set)
    """What was expected in the remarks so far."""
    writers: list[object] = field(default_factory=list)
    """Who publishes, each once; None for anyone."""
    is_kept: bool = False
    """Whether its newest message is kept, for inboxes that come later."""
    unread: Any = None
    """The newest message that was published while the topic had no subscriber."""
    make_unread: Callable[[], Any] | None = None
    """Makes that message when it is asked for, in place of ``unread``."""

    def said_once(self, remark: Remark | None) -> str | None:
        """Return a remark as a text, the first of what is expected; else None."""
        if remark is None or remark[1] in self.said:
            return None
        self.said.add(remark[1])
        return "; expected ".join(remark)

    def ends(self, besides: object) -> TopicEnds | None:
        """Who is at its ends, one owner and observers left out; None without a type."""
        if self.type is None:
            return None
        return TopicEnds(
            self.type,
            is_published=any(each is None or each is not besides for each in self.writers),
            is_read=any(
                each is None or (each is not besides and each is not OBSERVER)
                for each in self.owners
            ),
        )


@dataclass(frozen=True)
class TopicEnds:
    """What a topic carries, and who is at its ends."""

    type: type
    """Class of its messages."""
    is_published: bool
    """Whether anyone publishes on it."""
    is_read: bool
    """Whether anyone subscribes to it."""

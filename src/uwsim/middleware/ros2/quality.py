"""Quality of service of the endpoints, as ROS 2 names it.

Writers are reliable, so that a subscriber may request either reliability. Readers are reliable, as
those of a ROS 2 node with default settings; a best-effort publisher does not match them.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..bridge import DEPTH, LATCHED, LATCHED_DEPTH
from ..lockstep.topics import TICK

CLOCK = "clock"


@dataclass(frozen=True, kw_only=True)
class Quality:
    """The quality of service of an endpoint."""

    depth: int = DEPTH
    """The number of messages kept for a slow reader (keep last); 0 keeps all."""
    is_reliable: bool = True
    is_latched: bool = False
    """True if a late reader receives earlier messages (transient local)."""
    ignores_own: bool = False
    """True if messages of the same participant are not read."""


def quality_of(topic: str) -> Quality:
    """Return the quality of a topic of the simulator; no leading slash."""
    if topic in (*LATCHED, TICK):
        return Quality(depth=LATCHED_DEPTH, is_latched=True)
    return Quality()

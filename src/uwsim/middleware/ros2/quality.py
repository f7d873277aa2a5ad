"""Quality of service of the endpoints, as ROS 2 names it.

Writers are reliable, so that a subscriber may ask for either reliability. Readers are reliable, as
those of a ROS 2 node with default settings; a publisher of best effort does not match them.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..bridge import DEPTH, LATCHED, LATCHED_DEPTH
from ..lockstep.topics import TICK

CLOCK = "clock"


@dataclass(frozen=True, kw_only=True)
class Quality:
    """Of one endpoint."""

    depth: int = DEPTH
    """Messages kept for a reader that is behind (keep last); 0 keeps all."""
    is_reliable: bool = True
    is_latched: bool = False
    """Whether a late reader gets what was written before (transient local)."""
    ignores_own: bool = False
    """Whether what the same participant writes is not read."""


def quality_of(topic: str) -> Quality:
    """Return the quality of a topic of the simulator; no leading slash."""
    if topic in (*LATCHED, TICK):
        return Quality(depth=LATCHED_DEPTH, is_latched=True)
    return Quality()

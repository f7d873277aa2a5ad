"""Quality of service of the endpoints, with the policies of ROS 2.

Writers are reliable, so that a subscriber may request either reliability. Readers are reliable,
which is the default in ROS 2; a best-effort publisher does not match them.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..bridge import DEPTH, LATCHED, LATCHED_DEPTH
from ..lockstep.topics import TICK

CLOCK = "clock"
"""The topic of the simulation time."""


@dataclass(frozen=True, kw_only=True)
class Quality:
    """The quality of service of an endpoint."""

    depth: int = DEPTH
    """The number of messages kept for a slow reader (keep last); 0 keeps all."""
    is_reliable: bool = True
    """True if lost messages are sent again (reliable), False for best effort."""
    is_latched: bool = False
    """True if a late reader receives earlier messages (transient local)."""
    ignores_own: bool = False
    """True if the reader ignores messages of its own participant."""


def quality_of(topic: str) -> Quality:
    """Return the quality of service of a topic of the simulator, without a leading slash."""
    if topic in (*LATCHED, TICK):
        return Quality(depth=LATCHED_DEPTH, is_latched=True)
    return Quality()

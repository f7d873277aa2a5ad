"""Quality of service of the endpoints, as ROS 2 names it.

Writers are reliable, so that a subscriber may ask for either reliability. Readers are reliable, as
those of a ROS 2 node with default settings; a publisher of best effort does not match them.
"""

from __future__ import annotations

from dataclasses import dataclass

from cyclonedds.qos import Policy, Qos
from cyclonedds.util import duration

from ..bridge import DEPTH, LATCHED, LATCHED_DEPTH
from ..lockstep.topics import TICK

CLOCK = "clock"
MAX_BLOCKING_S = 0.1
"""How long a write waits for a reader that does not keep up [s]; then the message is dropped."""


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

    def policies(self, user_data: bytes = b"") -> Qos:
        """Return them for cyclonedds, with the USER_DATA of the endpoint."""
        blocking = duration(milliseconds=round(MAX_BLOCKING_S * 1000))
        policies = [
            Policy.Reliability.Reliable(blocking)
            if self.is_reliable
            else Policy.Reliability.BestEffort,
            Policy.History.KeepLast(self.depth) if self.depth else Policy.History.KeepAll,
            Policy.Durability.TransientLocal if self.is_latched else Policy.Durability.Volatile,
        ]
        if self.is_latched:
            infinite = -1
            policies.append(
                Policy.DurabilityService(
                    cleanup_delay=0,
                    history=Policy.History.KeepLast(max(1, self.depth)),
                    max_samples=infinite,
                    max_instances=infinite,
                    max_samples_per_instance=infinite,
                )
            )
        if self.ignores_own:
            policies.append(Policy.IgnoreLocal.Participant)
        if user_data:
            policies.append(Policy.Userdata(user_data))
        return Qos(*policies)


def quality_of(topic: str) -> Quality:
    """Return the quality of a topic of the simulator; no leading slash."""
    if topic in (*LATCHED, TICK):
        return Quality(depth=LATCHED_DEPTH, is_latched=True)
    return Quality()

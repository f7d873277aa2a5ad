"""Quality of service in the words of Cyclone DDS."""

from __future__ import annotations

from cyclonedds.qos import Policy, Qos
from cyclonedds.util import duration

from .quality import Quality

MAX_BLOCKING_S = 0.1
"""How long a write waits for a reader that does not keep up [s]; then the message is dropped."""


def policies(quality: Quality, user_data: bytes = b"") -> Qos:
    """Return a quality of service for cyclonedds, with the USER_DATA of the endpoint."""
    blocking = duration(milliseconds=round(MAX_BLOCKING_S * 1000))
    found = [
        Policy.Reliability.Reliable(blocking)
        if quality.is_reliable
        else Policy.Reliability.BestEffort,
        Policy.History.KeepLast(quality.depth) if quality.depth else Policy.History.KeepAll,
        Policy.Durability.TransientLocal if quality.is_latched else Policy.Durability.Volatile,
    ]
    if quality.is_latched:
        infinite = -1
        found.append(
            Policy.DurabilityService(
                cleanup_delay=0,
                history=Policy.History.KeepLast(max(1, quality.depth)),
                max_samples=infinite,
                max_instances=infinite,
                max_samples_per_instance=infinite,
            )
        )
    if quality.ignores_own:
        found.append(Policy.IgnoreLocal.Participant)
    if user_data:
        found.append(Policy.Userdata(user_data))
    return Qos(*found)

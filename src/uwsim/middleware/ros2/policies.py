"""Conversion of the quality of service for Cyclone DDS."""

from __future__ import annotations

from cyclonedds.qos import Policy, Qos
from cyclonedds.util import duration

from .quality import Quality

MAX_BLOCKING_S = 0.1
"""The longest wait of a write for a slow reader [s]; then the message is dropped."""


def policies(quality: Quality, user_data: bytes = b"") -> Qos:
    """Convert a quality of service for cyclonedds, with the USER_DATA of the endpoint."""
    max_blocking_time = duration(milliseconds=round(MAX_BLOCKING_S * 1000))
    policy_list = [
        Policy.Reliability.Reliable(max_blocking_time)
        if quality.is_reliable
        else Policy.Reliability.BestEffort,
        Policy.History.KeepLast(quality.depth) if quality.depth else Policy.History.KeepAll,
        Policy.Durability.TransientLocal if quality.is_latched else Policy.Durability.Volatile,
    ]
    if quality.is_latched:
        no_limit = -1
        policy_list.append(
            Policy.DurabilityService(
                cleanup_delay=0,
                history=Policy.History.KeepLast(max(1, quality.depth)),
                max_samples=no_limit,
                max_instances=no_limit,
                max_samples_per_instance=no_limit,
            )
        )
    if quality.ignores_own:
        policy_list.append(Policy.IgnoreLocal.Participant)
    if user_data:
        policy_list.append(Policy.Userdata(user_data))
    return Qos(*policy_list)

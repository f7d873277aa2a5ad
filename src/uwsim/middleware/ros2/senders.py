"""Which participant has written a sample.

All nodes of a process are one participant, as a rule. Its identity is a claim: a program that makes
packets of its own can send any.
"""

from __future__ import annotations

from typing import Any

MAX_WRITERS = 1000
"""Writers whose participant is remembered."""
PREFIX = 12
"""Bytes of a writer's identity that are those of its participant."""


class Senders:
    """Names the participants whose samples a reader gets."""

    def __init__(self) -> None:
        self._names: dict[int, str] = {}

    def sender_of(self, reader: Any, sample: Any) -> str:
        """Return how messages and calls name the participant that has written a sample."""
        handle = sample.sample_info.publication_handle
        name = self._names.get(handle)
        if name is None:
            found = reader.get_matched_publication_data(handle)
            if found is None:
                return "participant unknown"
            name = f"participant {bytes(found.key.bytes[:PREFIX]).hex()}"
            if len(self._names) < MAX_WRITERS:
                self._names[handle] = name
        return name

"""The identification of the participant that has written a sample.

As a rule, all nodes of a process share one participant. Its identity is not verified: a program
that makes its own packets can send any identity.
"""

from __future__ import annotations

from typing import Any

MAX_WRITERS = 1000
"""The maximum number of writers whose participant is stored."""
PREFIX_LENGTH = 12
"""The number of bytes of a writer's identity that identify its participant."""


class Senders:
    """The names of the participants whose samples a reader receives."""

    def __init__(self) -> None:
        self._names: dict[int, str] = {}

    def sender_of(self, reader: Any, sample: Any) -> str:
        """Return the name of the participant that has written a sample."""
        handle = sample.sample_info.publication_handle
        name = self._names.get(handle)
        if name is None:
            publication = reader.get_matched_publication_data(handle)
            if publication is None:
                return "participant unknown"
            name = f"participant {bytes(publication.key.bytes[:PREFIX_LENGTH]).hex()}"
            if len(self._names) < MAX_WRITERS:
                self._names[handle] = name
        return name

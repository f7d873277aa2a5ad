"""Medium access control.

==============  ==================================================================================
ALOHA           at once, whatever is heard
slotted ALOHA   at the beginning of the next slot; all clocks agree
CSMA            when nothing is heard; else after 1 to ``max_backoff`` slots, drawn anew each time
==============  ==================================================================================

Not modelled: acknowledgements, and so retransmissions; handshakes (MACA, FAMA).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

MacKind = Literal["aloha", "slotted", "csma"]
NAMES: dict[str, MacKind] = {
    "": "aloha",
    "none": "aloha",
    "broadcast": "aloha",
    "aloha": "aloha",
    "purealoha": "aloha",
    "slottedaloha": "slotted",
    "slotted": "slotted",
    "csma": "csma",
}
"""Name in a file, without case, ``ns3::``, ``AquaSim`` and ``Mac`` -> what it does."""


def mac_kind(name: str) -> MacKind | None:
    """Return the protocol that a file names; None where it is none of `NAMES`."""
    plain = "".join(letter for letter in name.lower().removeprefix("ns3::") if letter.isalnum())
    return NAMES.get(plain.removeprefix("aquasim").removesuffix("mac"))


@dataclass(frozen=True, kw_only=True)
class Mac:
    """A protocol with its slots."""

    kind: MacKind = "aloha"
    """Which."""
    slot: int = 1_000_000_000
    """Length of a slot [ns]."""
    max_backoff: int = 4
    """Longest wait when another is heard [slots]."""

    def send_time(self, now: int, *, hears: bool, draw: Callable[[int], int]) -> int:
        """Return when to try again [ns]; ``now``: the packet may be sent.

        Args:
            now: [ns].
            hears: whether another's packet arrives.
            draw: returns a whole number from 0 to below its argument.
        """
        if self.kind == "slotted":
            return -(-now // self.slot) * self.slot
        if self.kind == "csma" and hears:
            return now + (1 + draw(max(self.max_backoff, 1))) * self.slot
        return now

"""Medium access control.

==============  ==================================================================================
ALOHA           immediately, even if another packet arrives
slotted ALOHA   at the beginning of the next slot; all clocks agree
CSMA            when no packet arrives; else after 1 to ``max_backoff`` slots, redrawn each time
==============  ==================================================================================

Not modelled: acknowledgements, and so retransmissions; handshakes (MACA, FAMA).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

MacKind = Literal["aloha", "slotted", "csma"]
MAC_KINDS: dict[str, MacKind] = {
    "": "aloha",
    "none": "aloha",
    "broadcast": "aloha",
    "aloha": "aloha",
    "purealoha": "aloha",
    "slottedaloha": "slotted",
    "slotted": "slotted",
    "csma": "csma",
}
"""The protocol of each name in a file, without case, ``ns3::``, ``AquaSim`` and ``Mac``."""


def mac_kind(name: str) -> MacKind | None:
    """Return the protocol that a file names; None where it is none of `MAC_KINDS`."""
    letters = "".join(letter for letter in name.lower().removeprefix("ns3::") if letter.isalnum())
    return MAC_KINDS.get(letters.removeprefix("aquasim").removesuffix("mac"))


@dataclass(frozen=True, kw_only=True)
class Mac:
    """A medium access protocol with its slots."""

    kind: MacKind = "aloha"
    """The kind of the protocol."""
    slot: int = 1_000_000_000
    """The length of a slot [ns]."""
    max_backoff: int = 4
    """The longest wait while another packet arrives [slots]."""

    def send_time(self, now: int, *, is_receiving: bool, draw: Callable[[int], int]) -> int:
        """Return the time of the next try [ns]; if it is ``now``, the packet may be sent.

        Args:
            now: the present time [ns].
            is_receiving: whether a packet of another device arrives.
            draw: returns a random integer from 0 to below its argument.
        """
        if self.kind == "slotted":
            return -(-now // self.slot) * self.slot
        if self.kind == "csma" and is_receiving:
            return now + (1 + draw(max(self.max_backoff, 1))) * self.slot
        return now

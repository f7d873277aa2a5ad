"""Medium access control: when a device may send a packet.

==============  ==================================================================================
protocol        time of sending
==============  ==================================================================================
ALOHA           immediately, even while another packet arrives
slotted ALOHA   at the beginning of the next slot; the clocks of all devices agree
CSMA            immediately if no packet arrives; else the device tries again after a random number
                of slots, from 1 to ``max_backoff``
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
"""The protocol of each name in a file; ``ns3::``, ``AquaSim``, ``Mac`` and case are ignored."""


def mac_kind(name: str) -> MacKind | None:
    """Return the protocol that a file names; None if the name is not in `MAC_KINDS`."""
    letters = "".join(letter for letter in name.lower().removeprefix("ns3::") if letter.isalnum())
    return MAC_KINDS.get(letters.removeprefix("aquasim").removesuffix("mac"))


@dataclass(frozen=True, kw_only=True)
class Mac:
    """A medium access protocol with its parameters."""

    kind: MacKind = "aloha"
    """The kind of the protocol."""
    slot: int = 1_000_000_000
    """The length of a slot [ns]."""
    max_backoff: int = 4
    """The longest wait of CSMA while another packet arrives [slots]."""

    def send_time(self, now: int, *, is_receiving: bool, draw: Callable[[int], int]) -> int:
        """Return the time of the next try [ns]; if it is ``now``, the packet may be sent.

        Args:
            now: the present time [ns].
            is_receiving: True if a packet of another device is arriving.
            draw: a function that returns a random integer from 0 to below its argument.
        """
        if self.kind == "slotted":
            return -(-now // self.slot) * self.slot
        if self.kind == "csma" and is_receiving:
            return now + (1 + draw(max(self.max_backoff, 1))) * self.slot
        return now

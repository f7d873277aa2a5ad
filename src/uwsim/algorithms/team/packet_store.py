"""The packets that a relay keeps, and how often it has sent each of them."""

from __future__ import annotations


class PacketStore:
    """Packets in the order of their arrival; each is kept once."""

    def __init__(self) -> None:
        self._counts: dict[bytes, int] = {}  # how often each packet was sent

    def __len__(self) -> int:
        """Return the number of packets."""
        return len(self._counts)

    def add(self, data: bytes) -> bool:
        """Keep a packet; return whether it is new."""
        is_new = data not in self._counts
        self._counts.setdefault(data, 0)
        return is_new

    def take(self) -> bytes | None:
        """Return the packet that was sent least often, the oldest first; None without packets."""
        if not self._counts:
            return None
        data = min(self._counts, key=self._counts.__getitem__)
        self._counts[data] += 1
        return data

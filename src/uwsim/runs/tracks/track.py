"""A track: the kinds of sensors whose topics an algorithm under test may receive."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Track:
    """A rule for topics: an algorithm receives those of some kinds of sensors and devices only."""

    name: str
    """The name of the track."""
    sources: tuple[str, ...]
    """The elements of the permitted sensors and devices in a scene file, such as virtualCamera."""

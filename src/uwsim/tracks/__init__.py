"""Motion tracks: where everything was during a trial, 30 times a second, in a small file.

`packing` is the law of the bytes, `motion_track` what they mean, `dug_sand` what a dredge took.
"""

from __future__ import annotations

from .dug_sand import GRAIN, DugSand, Spot
from .motion_track import (
    RATE,
    MotionTrack,
    Signal,
    TrackLevel,
    load_track,
    read_track,
    track_bytes,
)

__all__ = [
    "GRAIN",
    "RATE",
    "DugSand",
    "MotionTrack",
    "Signal",
    "Spot",
    "TrackLevel",
    "load_track",
    "read_track",
    "track_bytes",
]

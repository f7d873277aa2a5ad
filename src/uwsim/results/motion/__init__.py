"""Motion tracks: the poses of all bodies during a trial, 30 times a second, in a small file.

`packing` is the law of the bytes, `motion_track` what they mean, `dug_sand` what a dredge took,
`marker_log` what programs spawned.
"""

from __future__ import annotations

from .dug_sand import GRAIN, DugSand, Spot
from .marker_log import DrawnMarker, MarkerChange, markers_at
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
    "DrawnMarker",
    "DugSand",
    "MarkerChange",
    "MotionTrack",
    "Signal",
    "Spot",
    "TrackLevel",
    "load_track",
    "markers_at",
    "read_track",
    "track_bytes",
]

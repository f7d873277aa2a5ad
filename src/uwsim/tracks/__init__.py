"""Motion tracks: where everything was during a trial, 30 times a second, in a small file.

`packing` is the law of the bytes, `motion_track` what they mean.
"""

from __future__ import annotations

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
    "RATE",
    "MotionTrack",
    "Signal",
    "TrackLevel",
    "load_track",
    "read_track",
    "track_bytes",
]

"""Motion tracks: the poses of all bodies during a trial, 30 times a second, in a small file.

`motion_track` reads and writes the file, and `packing` encodes its numbers. `dug_sand` holds the
sand that dredges removed, `stirred_sediment` the clouds that thrusters stirred up, and
`marker_log` the markers that programs added.
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
from .stirred_sediment import StirredSediment

__all__ = [
    "GRAIN",
    "RATE",
    "DrawnMarker",
    "DugSand",
    "MarkerChange",
    "MotionTrack",
    "Signal",
    "Spot",
    "StirredSediment",
    "TrackLevel",
    "load_track",
    "markers_at",
    "read_track",
    "track_bytes",
]

"""The motion track of a trial: poses of bodies, and what else changes, frame by frame.

.. code-block:: text

    {"format":"uwsim-motion","version":1,"rate":30.0,"frames":3540,"bodies":["girona500/base", ...],
     "channels":[{"name":"fog","unit":"1/m","resolution":0.0001}, ...],"levels":[...]}
    <newline, then the numbers, as of `packing`>

Frame k is of time k/rate since the simulation began. A row holds seven numbers of every body, its
position in W [m] and its quaternion (wxyz), and then one of every channel; each is stored as a
whole number of its resolution.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ..errors import ResultError
from .packing import Table, packed, unpacked

Array = npt.NDArray[np.float64]

FORMAT, VERSION = "uwsim-motion", 1
RATE = 30.0
"""Frames in a second of simulation time [Hz]."""
LENGTH = 1e-4
"""Resolution of positions [m]."""
TURN = 1e-4
"""Resolution of the numbers of a quaternion [1]."""
NUMBERS = 7
"""Of a body."""
LIMIT = 2**31 - 1
NOTHING = -(2**31)
"""Stands for a value that is missing."""


@dataclass(frozen=True, kw_only=True)
class Channel:
    """A number, other than a pose, that may change."""

    name: str
    """As ``fog``, or ``current.x``."""
    unit: str = "1"
    """Its unit."""
    resolution: float = 1e-4
    """What is stored is a whole multiple of this."""


@dataclass(frozen=True, kw_only=True)
class TrackLevel:
    """When a level was measured."""

    values: Mapping[str, float]
    """Swept parameter -> value, outermost first."""
    began: float
    """Simulation time at which it began to be measured [s]."""
    duration: float
    """How long it was measured [s]."""
    status: str
    """``ok``, or what went wrong."""


@dataclass(frozen=True, kw_only=True, eq=False)
class MotionTrack:
    """Where everything was during a trial."""

    bodies: tuple[str, ...]
    """Names: ``vehicle/link``, or an object's."""
    poses: Array
    """Position in W [m] and unit quaternion wxyz of each, (frames, bodies, 7)."""
    channels: tuple[Channel, ...] = ()
    """What else is stored."""
    values: Array
    """Of each channel, (frames, channels); NaN: nothing."""
    levels: tuple[TrackLevel, ...] = ()
    """In order."""
    rate: float = RATE
    """Frames a second [Hz]."""

    @property
    def n_frames(self) -> int:
        """Number of frames."""
        return len(self.poses)

    @property
    def duration(self) -> float:
        """Time of the last frame [s]."""
        return max(0, self.n_frames - 1) / self.rate

    def channel(self, name: str) -> Array | None:
        """Return the values of a channel, (frames,); None if there is none of that name."""
        names = [channel.name for channel in self.channels]
        return self.values[:, names.index(name)] if name in names else None

    def level_at(self, time: float) -> int | None:
        """Return the number of the level measured at a time [s], or of the one before it."""
        begun = [i for i, level in enumerate(self.levels) if level.began <= time + 1e-9]
        return begun[-1] if begun else None


def quantised(values: Array, resolutions: Array) -> Table:
    """Return values (..., m) as whole multiples of resolutions (m,)."""
    whole = np.rint(np.nan_to_num(values, nan=0.0, posinf=0.0, neginf=0.0) / resolutions)
    table = np.clip(whole, -LIMIT, LIMIT).astype(np.int32)
    table[~np.isfinite(values)] = NOTHING
    return table


def resolutions_of(n_bodies: int, channels: Sequence[Channel]) -> Array:
    """Return the resolution of each number of a row, (7 bodies + channels,)."""
    pose = [LENGTH] * 3 + [TURN] * 4
    return np.array([*pose * n_bodies, *(channel.resolution for channel in channels)])


def track_bytes(
    bodies: Sequence[str],
    channels: Sequence[Channel],
    table: Table,
    levels: Sequence[TrackLevel],
    rate: float = RATE,
) -> bytes:
    """Return the file of a track.

    Args:
        bodies: their names.
        channels: what else is in a row.
        table: quantised rows, (frames, 7 bodies + channels).
        levels: in order.
        rate: frames a second [Hz].
    """
    head = {
        "format": FORMAT,
        "version": VERSION,
        "rate": rate,
        "frames": len(table),
        "bodies": list(bodies),
        "channels": [asdict(channel) for channel in channels],
        "levels": [{**asdict(level), "values": dict(level.values)} for level in levels],
    }
    text = json.dumps(head, allow_nan=False, ensure_ascii=True, separators=(",", ":"))
    return text.encode() + b"\n" + packed(table)


def read_track(data: bytes) -> MotionTrack:
    """Read the bytes of a track; raises ResultError where they are none."""
    line, _, rest = data.partition(b"\n")
    try:
        head = json.loads(line)
        if (head["format"], head["version"]) != (FORMAT, VERSION):
            raise ValueError(f"found format {head['format']!r}, version {head['version']!r}")
        return _track(head, rest)
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise ResultError(f"is no motion track of version {VERSION}: {error}") from None


def load_track(path: Path) -> MotionTrack:
    """Read the file of a track; raises ResultError where there is none, or it is damaged."""
    try:
        return read_track(path.read_bytes())
    except OSError as error:
        raise ResultError(f"{path}: cannot be read: {error.strerror}.") from None
    except ResultError as error:
        raise ResultError(f"{path}: {error}.") from None


def _track(head: dict[str, Any], rest: bytes) -> MotionTrack:
    bodies = tuple(map(str, head["bodies"]))
    channels = tuple(Channel(**each) for each in head["channels"])
    resolutions, n = resolutions_of(len(bodies), channels), int(head["frames"])
    table = unpacked(rest, n, len(resolutions))
    rows = table * resolutions
    rows[table == NOTHING] = np.nan
    poses = rows[:, : NUMBERS * len(bodies)].reshape(n, len(bodies), NUMBERS)
    poses[..., 3:] /= np.maximum(np.linalg.norm(poses[..., 3:], axis=-1, keepdims=True), TURN)
    return MotionTrack(
        bodies=bodies,
        poses=poses,
        channels=channels,
        values=rows[:, NUMBERS * len(bodies) :],
        levels=tuple(TrackLevel(**each) for each in head["levels"]),
        rate=float(head["rate"]),
    )

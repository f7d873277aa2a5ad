"""The motion track of a trial: poses of bodies and other signals, frame by frame.

.. code-block:: text

    {"uwsim_motion":1,"rate":30.0,"n":3540,"start":0.0,"bodies":["girona500/base_link", ...],
     "length":0.0001,"quaternion":0.0001,"signals":[{"name":"fog","unit":"1/m","step":0.0001}, ...],
     "levels":[{"values":{"fog":0.5},"began":4.0,"duration":8.0,"status":"ok"}, ...]}
    <line feed, then the numbers, as in `packing`; all of it gzipped without time or name>

Row k is the frame at the simulation time start + k/rate. It holds seven numbers for every body (the
position in the world frame W [m] and the quaternion wxyz), then one number for every signal. Each
number is stored as an integer multiple of its resolution: ``length``, ``quaternion`` or ``step``.
Equal tracks give equal bytes.

In a track of version 2, sand was removed (`dug_sand`) or markers were added (`marker_log`). With
sand the head has ``"sand":{"n":412,"grain":0.000001}``, and a second table of n rows, packed
separately, follows the first; with markers the head has
``"markers":{"shapes":[...],"changes":[...]}``. In a track of version 3, thrusters stirred up
sediment, too (`stirred_sediment`): the head has ``"sediment":{"n":90,"steps":[...]}`` with the
resolution of each column, and a table of n rows is the last one. A track with none of these is of
version 1.
"""

from __future__ import annotations

import gzip
import json
import math
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ...base.files.json_text import read_json
from ...errors import ResultError
from .dug_sand import COLUMNS, GRAIN, NO_VALUE, DugSand
from .marker_log import MarkerChange, as_json, from_json
from .packing import BYTES, Table, pack_table, unpack_table
from .stirred_sediment import STEPS, StirredSediment

Array = npt.NDArray[np.float64]

FORMAT, VERSIONS = "uwsim_motion", (1, 2, 3)
RATE = 30.0
"""The number of frames in a second of simulation time [Hz]."""
POSITION_STEP = 1e-4
"""The resolution of positions [m]."""
QUATERNION_STEP = 1e-4
"""The resolution of the components of a quaternion [1]."""
MAX_BYTES = 2**30
"""The greatest decompressed size of a track that is read [bytes]."""
NUMBERS_PER_BODY = 7
"""The number of values for a body: a position and a quaternion."""
MAX_NUMBER = 2**31 - 1
"""The greatest absolute value of a stored integer."""


@dataclass(frozen=True, kw_only=True)
class Signal:
    """A scalar value, other than those of poses, that may change during a trial."""

    name: str
    """The name, such as ``fog`` or ``current.x``."""
    unit: str = "1"
    """The unit of the value."""
    step: float = 1e-4
    """The resolution, in `unit`; stored values are integer multiples of it."""


@dataclass(frozen=True, kw_only=True)
class TrackLevel:
    """The time and outcome of a level."""

    values: Mapping[str, float]
    """The value of each swept parameter, outermost first."""
    start_time: float
    """The simulation time at which the measurement began [s]."""
    duration: float
    """The duration of the measurement [s of simulation time]."""
    status: str
    """The status of the level: ``ok``, ``lost``, ..."""


@dataclass(frozen=True, kw_only=True, eq=False)
class MotionTrack:
    """The motion of all bodies during a trial."""

    bodies: tuple[str, ...]
    """The names of the bodies: ``vehicle/link``, or the name of an object."""
    poses: Array
    """The position in the world frame W [m] and the unit quaternion wxyz of each body, (frames,
    bodies, 7)."""
    signals: tuple[Signal, ...] = ()
    """The signals, which follow the poses in a row."""
    values: Array
    """The values of the signals, (frames, signals); NaN for a missing value."""
    levels: tuple[TrackLevel, ...] = ()
    """The levels, in order."""
    rate: float = RATE
    """The number of frames in a second of simulation time [Hz]."""
    sand: DugSand = field(default_factory=DugSand)
    """The spots where sand was removed."""
    markers: tuple[MarkerChange, ...] = ()
    """The changes of the markers that programs added, in the order of their frames."""
    sediment: StirredSediment = field(default_factory=StirredSediment)
    """The puffs of sediment that thrusters stirred up."""

    @property
    def n_frames(self) -> int:
        """The number of frames."""
        return len(self.poses)

    @property
    def duration(self) -> float:
        """The time of the last frame after the first [s]."""
        return max(0, self.n_frames - 1) / self.rate

    def signal(self, name: str) -> Array | None:
        """Return the values of a signal, (frames,); None if no signal has that name."""
        names = [signal.name for signal in self.signals]
        return self.values[:, names.index(name)] if name in names else None


def quantise(values: Array, steps: Array) -> Table:
    """Return values (..., m) as integer multiples of their resolutions ``steps`` (m,).

    A value that is not finite becomes `NO_VALUE`.
    """
    multiples = np.rint(np.nan_to_num(values, nan=0.0, posinf=0.0, neginf=0.0) / steps)
    table = np.clip(multiples, -MAX_NUMBER, MAX_NUMBER).astype(np.int32)
    table[~np.isfinite(values)] = NO_VALUE
    return table


def steps_of(n_bodies: int, signals: Sequence[Signal]) -> Array:
    """Return the resolution of each number in a row, (7 bodies + signals,)."""
    pose = [POSITION_STEP] * 3 + [QUATERNION_STEP] * 4
    return np.array([*pose * n_bodies, *(signal.step for signal in signals)])


def track_bytes(
    bodies: Sequence[str],
    signals: Sequence[Signal],
    table: Table,
    levels: Sequence[TrackLevel],
    rate: float = RATE,
    *,
    sand: DugSand | None = None,
    markers: Sequence[MarkerChange] = (),
    sediment: StirredSediment | None = None,
) -> bytes:
    """Return the content of the file of a track.

    Args:
        bodies: the names of the bodies.
        signals: the signals, which follow the poses in a row.
        table: rows from `quantise`, (frames, 7 bodies + signals).
        levels: the levels, in order.
        rate: the number of frames in a second of simulation time [Hz].
        sand: the spots where sand was removed; None if no sand was removed.
        markers: the changes of markers, in the order of their frames.
        sediment: the puffs that thrusters stirred up; None if there are none.
    """
    digs, births = (sand or DugSand()).table, (sediment or StirredSediment()).table
    head: dict[str, Any] = {
        FORMAT: 3 if len(births) else 2 if len(digs) or markers else 1,
        "rate": rate,
        "n": len(table),
        "start": 0.0,
        "bodies": list(bodies),
        "length": POSITION_STEP,
        "quaternion": QUATERNION_STEP,
        "signals": [asdict(signal) for signal in signals],
        "levels": [_level_entry(level) for level in levels],
    }
    if len(digs):
        head["sand"] = {"n": len(digs), "grain": GRAIN}
    if markers:
        head["markers"] = as_json(markers)
    if len(births):
        head["sediment"] = {"n": len(births), "steps": list(STEPS)}
    text = json.dumps(head, allow_nan=False, ensure_ascii=True, separators=(",", ":"))
    tables = pack_table(table) + pack_table(digs) + pack_table(births)
    content = text.encode() + b"\n" + tables
    return gzip.compress(content, compresslevel=9, mtime=0)


def read_track(data: bytes) -> MotionTrack:
    """Read the content of the file of a track; raise ResultError if it is not a track."""
    try:
        line, _, rest = unpack_track(data).partition(b"\n")
        head = read_json(line)
        if head[FORMAT] not in VERSIONS:
            raise ValueError(f"found version {head[FORMAT]!r}")
        return _track(head, rest)
    except (
        ValueError,
        KeyError,
        TypeError,
        AttributeError,
        OverflowError,
    ) as error:
        raise ResultError(f"is no motion track of version 1 to 3: {error}") from None


def load_track(path: Path) -> MotionTrack:
    """Read the file of a track; raise ResultError if it does not exist or is damaged."""
    try:
        return read_track(path.read_bytes())
    except OSError as error:
        raise ResultError(f"{path}: cannot be read: {error.strerror}.") from None
    except ResultError as error:
        raise ResultError(f"{path}: {error}.") from None


def unpack_track(data: bytes) -> bytes:
    """Return the bytes in the file of a track without gzip; raise ValueError if it is damaged."""
    stream = zlib.decompressobj(wbits=31)
    try:
        content = stream.decompress(data, MAX_BYTES)
    except zlib.error as error:
        raise ValueError(f"cannot be unpacked: {error}") from None
    if not stream.eof:
        raise ValueError("it is cut off" if len(content) < MAX_BYTES else "it is too long")
    return content


def _track(head: dict[str, Any], rest: bytes) -> MotionTrack:
    bodies = tuple(map(str, head["bodies"]))
    signals = tuple(_signal(**entry) for entry in head["signals"])
    pose = [float(head["length"])] * 3 + [float(head["quaternion"])] * 4
    steps, n = np.array([*pose * len(bodies), *(signal.step for signal in signals)]), int(head["n"])
    rate = float(head["rate"])
    if not (0.0 < rate < math.inf and np.all((steps > 0.0) & (steps < math.inf))):
        raise ValueError("a rate or a resolution is not above 0")
    size = max(0, n) * len(steps) * BYTES
    table = unpack_table(rest[:size], n, len(steps))
    rows = table * steps
    rows[table == NO_VALUE] = np.nan
    poses = rows[:, : NUMBERS_PER_BODY * len(bodies)].reshape(n, len(bodies), NUMBERS_PER_BODY)
    norms = np.linalg.norm(poses[..., 3:], axis=-1, keepdims=True)
    if (norms < 0.5).any():
        raise ValueError("an orientation is not a unit quaternion")
    poses[..., 3:] /= norms
    return MotionTrack(
        bodies=bodies,
        poses=poses,
        signals=signals,
        values=rows[:, NUMBERS_PER_BODY * len(bodies) :],
        levels=tuple(_level(entry) for entry in head["levels"]),
        rate=rate,
        **_read_tables(head, rest[size:]),
        markers=from_json(head.get("markers", {"shapes": (), "changes": ()})),
    )


def _signal(name: object, unit: object = "1", step: object = 1e-4) -> Signal:
    return Signal(name=_text("name", name), unit=_text("unit", unit), step=_number("step", step))


def _level_entry(level: TrackLevel) -> dict[str, object]:
    """Return the entry of a level, with the keys of the file."""
    return {
        "values": dict(level.values),
        "began": level.start_time,
        "duration": level.duration,
        "status": level.status,
    }


def _level(entry: Mapping[str, object]) -> TrackLevel:
    if entry.keys() != {"values", "began", "duration", "status"}:
        raise ValueError(f"a level has the keys {', '.join(entry)[:60]}")
    values = entry["values"]
    if not isinstance(values, dict):
        raise ValueError(f"the values of a level are {str(values)[:60]}; expected an object")
    return TrackLevel(
        values={str(name): _number("values", value) for name, value in values.items()},
        start_time=_number("began", entry["began"]),
        duration=_number("duration", entry["duration"]),
        status=_text("status", entry["status"]),
    )


def _number(name: str, value: object) -> float:
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if not is_number or not math.isfinite(float(value)):  # type: ignore[arg-type]
        raise ValueError(f"{name} is {str(value)[:60]}; expected a number")
    return value  # type: ignore[return-value]


def _text(name: str, value: object) -> str:
    if not isinstance(value, str):
        raise ValueError(f"{name} is {str(value)[:60]}; expected a text")
    return value


def _read_tables(head: dict[str, Any], rest: bytes) -> dict[str, Any]:
    """Read the tables of sand and sediment, which follow that of the frames."""
    sand, sediment = head.get("sand", {"n": 0}), head.get("sediment", {"n": 0})
    n, n_births = int(sand["n"]), int(sediment["n"])
    if n and sand["grain"] != GRAIN:
        raise ValueError(f"sand was taken in steps of {sand['grain']!r} m, not {GRAIN}")
    if n_births and sediment["steps"] != list(STEPS):
        raise ValueError(f"sediment has the resolutions {sediment['steps']!r}, not {list(STEPS)}")
    size = max(0, n) * COLUMNS * BYTES
    births = unpack_table(rest[size:], n_births, len(STEPS))
    return {
        "sand": DugSand(table=unpack_table(rest[:size], n, COLUMNS)),
        "sediment": StirredSediment(table=births),
    }

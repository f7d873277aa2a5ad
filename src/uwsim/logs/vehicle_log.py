"""The log of one vehicle, as all commands that read logs use it.

Times are seconds from the beginning of the log. Poses are in the frame L of scene files and topics
(docs/conventions.md). Twists are over ground, in the base frame of the vehicle's URDF.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Literal

import numpy as np

from ..base.geometry import Array
from ..errors import BadSetting

CommandKind = Literal["thrusters", "fins", "wrench", "twist"]
"""The kind of commands: thrusters [-1 to 1], fins [rad], wrench [N, N m], twist [m/s, rad/s]."""

PLANAR_TOLERANCE = 1e-9
"""The change of a constant depth [m] or of the tilt of a quaternion by rounding."""


@dataclass(frozen=True, kw_only=True, eq=False)
class MotionSeries:
    """The measured motion of a vehicle."""

    times: Array
    """The times, strictly increasing, (n,) [s]."""
    positions: Array
    """The positions of the base in L, (n, 3) [m]; NaN where a log has none."""
    quaternions: Array
    """The orientations ``localized_from_base``, (n, 4), in the order w, x, y, z."""
    twists: Array | None = None
    """The twists over ground in the base frame, (n, 6) [m/s, rad/s]; None: not in the log."""
    twist_source: Literal["log", "smoothed"] = "log"
    """The source of the twists: the log, or the derivative of smoothed poses (`smoothing`)."""

    def __post_init__(self) -> None:
        _check_shapes(self.times, positions=(self.positions, 3), quaternions=(self.quaternions, 4))
        if self.twists is not None:
            _check_shapes(self.times, twists=(self.twists, 6))

    @property
    def is_planar(self) -> bool:
        """True if depth, roll and pitch are constants, as those of a surface craft without them."""
        depths, tilts = self.positions[:, 2], self.quaternions[:, 1:3]
        is_one_depth = bool((np.abs(depths - depths[:1]) < PLANAR_TOLERANCE).all())
        return is_one_depth and bool((np.abs(tilts) < PLANAR_TOLERANCE).all())


@dataclass(frozen=True, kw_only=True, eq=False)
class CommandSeries:
    """The commands that a vehicle received; each holds until the next."""

    kind: CommandKind
    """The kind of commands."""
    names: tuple[str, ...]
    """The names of the columns: thrusters or fins of the vehicle, or axes."""
    times: Array
    """The times at which the commands take effect, (n,) [s]."""
    values: Array
    """The commands, (n, columns)."""
    sample_interval: float | None = None
    """The interval of samples in the log if the commands are interpolated between them [s]."""
    source: str = ""
    """The topic of the commands, of a recording."""

    def __post_init__(self) -> None:
        _check_shapes(self.times, values=(self.values, len(self.names)))

    @property
    def interval(self) -> float:
        """The median interval of the samples in the log [s]; 0 with fewer than two."""
        if self.sample_interval is not None:
            return self.sample_interval
        return float(np.median(np.diff(self.times))) if len(self.times) > 1 else 0.0

    def name_in_order(self, names: tuple[str, ...]) -> CommandSeries:
        """Return the commands with the names of a vehicle, if the log has none of them.

        Names of the log that are numbers, or of which the vehicle has none, count in their order.

        Args:
            names: the vehicle's thrusters or fins, in their order.
        """
        if len(self.names) != len(names) or set(self.names) & set(names):
            return self
        return replace(self, names=names)


@dataclass(frozen=True, kw_only=True, eq=False)
class SensorSeries:
    """The readings of a sensor."""

    kind: str
    """The kind of the sensor: ``imu``, ``dvl``, ``pressure``, ``gps``, ``range``, ``battery``."""
    names: tuple[str, ...]
    """The names of the columns."""
    units: tuple[str, ...]
    """The units of the columns."""
    times: Array
    """The times of the readings, (n,) [s]."""
    values: Array
    """The readings, (n, columns)."""

    def __post_init__(self) -> None:
        _check_shapes(self.times, values=(self.values, len(self.names)))
        if len(self.units) != len(self.names):
            raise BadSetting(
                f"A sensor has {len(self.names)} columns, but {len(self.units)} units."
            )


@dataclass(frozen=True, kw_only=True, eq=False)
class VehicleLog:
    """The log of one vehicle."""

    path: str
    """The file from which the log was read."""
    format: str
    """The format of the file: ``mcap``, ``bag``, ``bin``, ``tlog``, ``csv``."""
    sha256: str
    """The hash of the file."""
    vehicle: str
    """The name of the vehicle in the log."""
    vehicle_place: str = ""
    """The file and the line of a mapping file that names the vehicle."""
    motion: MotionSeries | None = None
    """The measured motion; None: the log has none."""
    commands: tuple[CommandSeries, ...] = ()
    """The commands, at most one series of each kind."""
    sensors: Mapping[str, SensorSeries] = field(default_factory=lambda: MappingProxyType({}))
    """The readings of sensors, by name."""
    start: float = 0.0
    """The time of the beginning of the log since 1970, or on the clock of the log [s]."""
    remarks: tuple[str, ...] = ()
    """The defects that the reader found and repaired, one sentence each."""

    @property
    def duration(self) -> float:
        """The time from the beginning to the last sample [s]."""
        series = [self.motion, *self.commands, *self.sensors.values()]
        return max(
            (float(part.times[-1]) for part in series if part and len(part.times)), default=0.0
        )


def _check_shapes(times: Array, **columns: tuple[Array, int]) -> None:
    for name, (values, width) in columns.items():
        if times.ndim != 1 or values.shape != (len(times), width):
            raise BadSetting(
                f"{name} of a log has the shape {values.shape}; expected ({len(times)}, {width})."
            )

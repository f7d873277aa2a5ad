"""The mapping file of a log: which columns, topics or channels are what, in which unit and frame.

.. code-block:: toml

    vehicle = "bluerov2"
    [time]
    column = "Time"
    unit = "ms"
    [frames]
    world = "ned"
    body = "frd"
    [motion]
    position = ["n", "e", "d"]
    rpy = ["roll", "pitch", "yaw"]
    angle_unit = "deg"
    [commands.thrusters]
    columns = ["ch1", "ch2"]
    names = ["port", "starboard"]
    unit = "pwm"
    signs = [1, -1]
    [sensors.dvl]
    kind = "dvl"
    columns = ["vx", "vy", "vz"]
    names = ["u", "v", "w"]
    units = ["m/s", "m/s", "m/s"]
    [topics]
    odometry = "/bluerov2/odom"

A CSV file needs ``time`` and all columns. In a recording ``topics`` chooses topics by role. In an
autopilot's log ``commands.thrusters`` names channels (``C1``, ``servo3_raw``) as columns.

A number in place of a column of ``[motion]`` is a constant: ``position = ["n", "e", 0]`` of a boat.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from .frames import BodyFrame, WorldFrame
from .vehicle_log import CommandKind

SENSOR_KINDS = ("imu", "dvl", "pressure", "gps", "range", "battery")
"""The kinds of sensors of a log."""
TOPIC_ROLES = ("odometry", "pose", "thrusters", "fins", "wrench", "twist", "joints")
"""The roles of topics in a recording, besides sensors."""
VELOCITY_FRAMES = ("body", "world")
Column = str | float
"""The name of a column, or a constant in the unit of the column."""


@dataclass(frozen=True, kw_only=True)
class TimeMapping:
    """The column of times."""

    column: str = "time"
    """The name of the column."""
    unit: str = "s"
    """The unit of the column."""


@dataclass(frozen=True, kw_only=True)
class FrameMapping:
    """The frames of a log."""

    world: WorldFrame | None = None
    """The world frame of positions and orientations; None: the default of the format."""
    body: BodyFrame | None = None
    """The body frame of orientations, twists and sensors; None: the default of the format."""
    origin: tuple[float, ...] = (0.0, 0.0, 0.0)
    """The position of the log's origin in L [m]."""


@dataclass(frozen=True, kw_only=True)
class MotionMapping:
    """The columns of the motion; an empty name: the log lacks it; a number: a constant."""

    position: tuple[Column, ...] = ()
    """The columns of x, y and z."""
    position_unit: str = "m"
    quaternion: tuple[str, ...] = ()
    """The columns of w, x, y and z."""
    rpy: tuple[Column, ...] = ()
    """The columns of roll, pitch and yaw."""
    angle_unit: str = "rad"
    velocity: tuple[Column, ...] = ()
    """The columns of the velocity over ground."""
    velocity_unit: str = "m/s"
    velocity_frame: str = "body"
    """The frame of the velocity: ``body`` or ``world``."""
    angular_velocity: tuple[Column, ...] = ()
    """The columns of the angular velocity in body axes."""
    angular_velocity_unit: str = "rad/s"


@dataclass(frozen=True, kw_only=True)
class CommandMapping:
    """The columns or channels of commands of one kind."""

    columns: tuple[str, ...]
    """The names of columns, or of channels of an autopilot."""
    names: tuple[str, ...] = ()
    """The names of thrusters, fins or axes; empty: the names of the columns."""
    unit: str = ""
    """The unit of all columns; empty: the unit of the kind."""
    signs: tuple[float, ...] = ()
    """The sign of each column: -1 for a reversed propeller; empty: 1."""
    delay: float = 0.0
    """The time from the stamp of a command to its effect [s]."""
    clock_offset: float = 0.0
    """The time that is added to stamps of another clock than that of the motion [s]."""


@dataclass(frozen=True, kw_only=True)
class SensorMapping:
    """The columns of a sensor."""

    kind: str
    """The kind of the sensor."""
    columns: tuple[str, ...]
    """The names of the columns."""
    names: tuple[str, ...] = ()
    """The names of the quantities; empty: the names of the columns."""
    units: tuple[str, ...] = ()
    """The unit of each column; empty: SI units."""


@dataclass(frozen=True, kw_only=True)
class LogMapping:
    """A mapping file."""

    path: str = ""
    """The path of the file."""
    vehicle: str = ""
    """The name of the vehicle; empty: the reader chooses."""
    vehicle_line: int | None = None
    """The line of the name of the vehicle."""
    time: TimeMapping = field(default_factory=TimeMapping)
    frames: FrameMapping = field(default_factory=FrameMapping)
    motion: MotionMapping = field(default_factory=MotionMapping)
    commands: Mapping[CommandKind, CommandMapping] = field(
        default_factory=lambda: MappingProxyType({})
    )
    sensors: Mapping[str, SensorMapping] = field(default_factory=lambda: MappingProxyType({}))
    topics: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    """The topic of each role or sensor kind in a recording."""

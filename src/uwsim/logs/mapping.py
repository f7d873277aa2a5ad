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
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any, get_args

from ..base.files.input_files import read_document
from ..errors import BadSetting, Diagnostic, FileError, choices
from .frames import BODY_FRAMES, WORLD_FRAMES, BodyFrame, WorldFrame
from .limits import MAX_COLUMNS, MAX_DIAGNOSTICS, MAX_NAME
from .units import UNITS, find_unit
from .vehicle_log import CommandKind

MAX_BYTES = 2**20
"""The greatest size of a mapping file [bytes]."""
SENSOR_KINDS = ("imu", "dvl", "pressure", "gps", "range", "battery")
"""The kinds of sensors of a log."""
TOPIC_ROLES = ("odometry", "pose", "thrusters", "fins", "wrench", "twist", "joints")
"""The roles of topics in a recording, besides sensors."""
VELOCITY_FRAMES = ("body", "world")
MAX_DIGITS = 4000
"""The number of digits of an integer up to which Python certainly reads it."""


class MappingError(FileError):
    """An invalid mapping file."""


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
    """The columns of the motion; an empty name: the log has no such column."""

    position: tuple[str, ...] = ()
    """The columns of x, y and z."""
    position_unit: str = "m"
    quaternion: tuple[str, ...] = ()
    """The columns of w, x, y and z."""
    rpy: tuple[str, ...] = ()
    """The columns of roll, pitch and yaw."""
    angle_unit: str = "rad"
    velocity: tuple[str, ...] = ()
    """The columns of the velocity over ground."""
    velocity_unit: str = "m/s"
    velocity_frame: str = "body"
    """The frame of the velocity: ``body`` or ``world``."""
    angular_velocity: tuple[str, ...] = ()
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
    """The factor of each column, such as -1 for a reversed propeller; empty: 1."""
    delay: float = 0.0
    """The time from the stamp of a command to its effect [s]."""


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
    time: TimeMapping = field(default_factory=TimeMapping)
    frames: FrameMapping = field(default_factory=FrameMapping)
    motion: MotionMapping = field(default_factory=MotionMapping)
    commands: Mapping[CommandKind, CommandMapping] = field(
        default_factory=lambda: MappingProxyType({})
    )
    sensors: Mapping[str, SensorMapping] = field(default_factory=lambda: MappingProxyType({}))
    topics: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    """The topic of each role or sensor kind in a recording."""


def read_mapping(path: Path) -> LogMapping:
    """Read a mapping file.

    Raises:
        MappingError: the file is invalid; the error has every mistake, with its line.
    """
    try:
        text = read_document(path, at_most=MAX_BYTES).decode("utf-8-sig")
    except FileError as error:
        raise MappingError(error.diagnostics) from None
    except UnicodeDecodeError as error:
        message = f"byte {error.start} is not UTF-8 text"
        raise MappingError([Diagnostic(file=str(path), line=None, message=message)]) from None
    try:
        table = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        match = re.search(r"at line (\d+)", str(error))
        line = int(match[1]) if match else None
        raise MappingError(
            [Diagnostic(file=str(path), line=line, message=f"not TOML: {error}")]
        ) from None
    except RecursionError:
        message = "not TOML: lists or tables are nested too deeply"
        raise MappingError([Diagnostic(file=str(path), line=None, message=message)]) from None
    except ValueError:  # of Python's limit for the digits of an integer
        line = _find_long_number(text)
        message = f"a number has more than {MAX_DIGITS} digits"
        raise MappingError([Diagnostic(file=str(path), line=line, message=message)]) from None
    reader = _Reader(path, text)
    mapping = reader.read(table)
    if reader.diagnostics:
        raise MappingError(reader.diagnostics)
    return mapping


class _Reader:
    """The reader of one mapping file, with all of its errors."""

    def __init__(self, path: Path, text: str) -> None:
        self._path, self._lines = path, text.splitlines()
        self.diagnostics: list[Diagnostic] = []

    def read(self, table: dict[str, Any]) -> LogMapping:
        sections = ("vehicle", "time", "frames", "motion", "commands", "sensors", "topics")
        self._check_keys(table, sections, "the file")
        commands: dict[CommandKind, CommandMapping] = {}
        kinds = get_args(CommandKind)
        command_tables = self._section(table, "commands")
        self._check_keys(command_tables, kinds, "[commands]")
        for kind in kinds:
            if kind in command_tables:
                read = self._read_commands(f"commands.{kind}", command_tables[kind])
                if read is not None:
                    commands[kind] = read
        sensors = {}
        for name, sensor_table in self._section(table, "sensors").items():
            sensor = self._read_sensor(f"sensors.{name}", sensor_table)
            if sensor is not None:
                sensors[name] = sensor
        return LogMapping(
            path=str(self._path),
            vehicle=self._text(table, "vehicle", "", "the file"),
            time=self._read_time(self._section(table, "time")),
            frames=self._read_frames(self._section(table, "frames")),
            motion=self._read_motion(self._section(table, "motion")),
            commands=MappingProxyType(commands),
            sensors=MappingProxyType(sensors),
            topics=MappingProxyType(self._read_topics(self._section(table, "topics"))),
        )

    def _read_time(self, table: dict[str, Any]) -> TimeMapping:
        self._check_keys(table, ("column", "unit"), "[time]")
        return TimeMapping(
            column=self._text(table, "column", "time", "[time]"),
            unit=self._unit(table, "unit", "s", "time"),
        )

    def _read_frames(self, table: dict[str, Any]) -> FrameMapping:
        self._check_keys(table, ("world", "body", "origin"), "[frames]")
        world, body = (
            self._choice(table, key, names)
            for key, names in (("world", WORLD_FRAMES), ("body", BODY_FRAMES))
        )
        origin = self._numbers(table, "origin", "[frames]") or (0.0, 0.0, 0.0)
        if len(origin) != 3:
            self._report("origin", "origin of [frames]: expected three numbers [m]")
            origin = (0.0, 0.0, 0.0)
        return FrameMapping(
            world=next((frame for frame in WORLD_FRAMES if frame == world), None),
            body=next((frame for frame in BODY_FRAMES if frame == body), None),
            origin=origin,
        )

    def _read_motion(self, table: dict[str, Any]) -> MotionMapping:
        counts = {"position": 3, "quaternion": 4, "rpy": 3, "velocity": 3, "angular_velocity": 3}
        units = {
            "position_unit": "length",
            "angle_unit": "angle",
            "velocity_unit": "velocity",
            "angular_velocity_unit": "angular velocity",
        }
        self._check_keys(table, (*counts, *units, "velocity_frame"), "[motion]")
        columns = {key: self._names(table, key, "[motion]") for key in counts}
        for key, names in columns.items():
            if names and len(names) != counts[key]:
                self._report(
                    key, f"{key} of [motion] has {len(names)} columns; expected {counts[key]}"
                )
        if columns["quaternion"] and columns["rpy"]:
            self._report("rpy", "[motion] has a quaternion and rpy; expected one of them")
        defaults = MotionMapping()
        fields: dict[str, Any] = dict(columns)
        for key, quantity in units.items():
            fields[key] = self._unit(table, key, getattr(defaults, key), quantity)
        return MotionMapping(
            **fields,
            velocity_frame=self._choice(table, "velocity_frame", VELOCITY_FRAMES) or "body",
        )

    def _read_commands(self, section: str, table: object) -> CommandMapping | None:
        label = f"[{section}]"
        if not isinstance(table, dict):
            self._report(section.split(".")[1], f"{label} is not a table")
            return None
        self._check_keys(table, ("columns", "names", "unit", "signs", "delay"), label)
        columns = self._names(table, "columns", label)
        names, signs = self._names(table, "names", label), self._numbers(table, "signs", label)
        if not columns:
            self._report(section, f"columns of {label} is missing")
            return None
        for key, values in (("names", names), ("signs", signs)):
            if values and len(values) != len(columns):
                self._report(
                    key, f"{label} has {len(columns)} columns, but {len(values)} {key}", section
                )
        self._check_commands(names, signs, section)
        delay = self._number(table, "delay", label)
        return CommandMapping(
            columns=columns,
            names=names,
            unit=self._unit(table, "unit", "", None),
            signs=signs,
            delay=delay,
        )

    def _check_commands(
        self, names: tuple[str, ...], signs: tuple[float, ...], section: str
    ) -> None:
        """Report names that are there twice, and factors of zero."""
        for name in dict.fromkeys(name for name in names if names.count(name) > 1):
            self._report("names", f"names of [{section}] has {name!r:.60} twice", section)
        if 0.0 in signs:
            message = f"signs of [{section}] has 0, which removes a command; expected such as -1"
            self._report("signs", message, section)

    def _read_sensor(self, section: str, table: object) -> SensorMapping | None:
        label = f"[{section}]"
        if not isinstance(table, dict):
            self._report(section.split(".")[1], f"{label} is not a table")
            return None
        self._check_keys(table, ("kind", "columns", "names", "units"), label)
        kind = self._choice(table, "kind", SENSOR_KINDS)
        columns = self._names(table, "columns", label)
        names, units = self._names(table, "names", label), self._names(table, "units", label)
        if kind is None and "kind" not in table:
            self._report(section, f"kind of {label} is missing.{choices('', SENSOR_KINDS)}")
        if not columns:
            self._report(section, f"columns of {label} is missing")
        for key, values in (("names", names), ("units", units)):
            if values and len(values) != len(columns):
                self._report(
                    key, f"{label} has {len(columns)} columns, but {len(values)} {key}", section
                )
        for unit in units:
            if unit not in UNITS:
                self._report("units", f"{unit!r:.40} is not a unit.{choices(unit, UNITS)}", section)
        if kind is None or not columns:
            return None
        return SensorMapping(kind=kind, columns=columns, names=names, units=units)

    def _read_topics(self, table: dict[str, Any]) -> dict[str, str]:
        self._check_keys(table, (*TOPIC_ROLES, *SENSOR_KINDS), "[topics]")
        topics = {key: self._text(table, key, "", "[topics]") for key in table}
        return {key: f"/{topic.strip('/')}" for key, topic in topics.items() if topic}

    def _section(self, table: dict[str, Any], key: str) -> dict[str, Any]:
        section = table.get(key, {})
        if isinstance(section, dict):
            return section
        self._report(key, f"{key} is not a table; expected [{key}]")
        return {}

    def _check_keys(self, table: dict[str, Any], keys: tuple[str, ...], label: str) -> None:
        for key in table:
            if key not in keys:
                self._report(key, f"{key!r:.60} is not a key of {label}.{choices(key, keys)}")

    def _text(self, table: dict[str, Any], key: str, default: str, label: str) -> str:
        value = table.get(key, default)
        if isinstance(value, str) and len(value) <= MAX_NAME:
            return value
        self._report(key, f"{key} of {label} is {_quote(value)}; expected a text")
        return default

    def _choice(self, table: dict[str, Any], key: str, names: tuple[str, ...]) -> str | None:
        value = table.get(key)
        if value is None or value in names:
            return value
        self._report(key, f"{key} is {_quote(value)}.{choices(str(value), names)}")
        return None

    def _names(self, table: dict[str, Any], key: str, label: str) -> tuple[str, ...]:
        value = table.get(key, [])
        is_valid = isinstance(value, list) and len(value) <= MAX_COLUMNS
        if is_valid and all(isinstance(name, str) and len(name) <= MAX_NAME for name in value):
            return tuple(value)
        self._report(key, f"{key} of {label} is {_quote(value)}; expected a list of texts")
        return ()

    def _numbers(self, table: dict[str, Any], key: str, label: str) -> tuple[float, ...]:
        value = table.get(key, [])
        is_valid = isinstance(value, list) and len(value) <= MAX_COLUMNS
        if is_valid and all(_is_number(number) for number in value):
            return tuple(float(number) for number in value)
        self._report(key, f"{key} of {label} is {_quote(value)}; expected a list of numbers")
        return ()

    def _number(self, table: dict[str, Any], key: str, label: str) -> float:
        value = table.get(key, 0.0)
        if _is_number(value):
            return float(value)
        self._report(key, f"{key} of {label} is {_quote(value)}; expected a number")
        return 0.0

    def _unit(self, table: dict[str, Any], key: str, default: str, quantity: str | None) -> str:
        value = table.get(key, default)
        if value == "" and quantity is None:
            return ""
        try:
            find_unit(str(value), quantity)
        except BadSetting as error:
            self._report(key, f"{key}: {error}")
            return default
        return str(value)

    def _report(self, key: str, message: str, section: str = "") -> None:
        if len(self.diagnostics) < MAX_DIAGNOSTICS:
            line = self._find_line(key, section)
            self.diagnostics.append(Diagnostic(file=str(self._path), line=line, message=message))

    def _find_line(self, key: str, section: str) -> int | None:
        """Return the line of a section, or of the first such key (in the section, if given)."""
        start = 0
        for number, line in enumerate(self._lines):
            if section and line.strip() == f"[{section}]":
                start = number
        patterns = (rf"\s*\[{re.escape(key)}\]", rf"""\s*["']?{re.escape(key)}["']?\s*=""")
        for pattern in patterns:
            for number, line in enumerate(self._lines[start:], start=start + 1):
                if re.match(pattern, line):
                    return number
        return None


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < 1e6


def _quote(value: object) -> str:
    """Return at most 60 letters of a value as text."""
    try:
        return f"{value!r:.60}"
    except RecursionError:
        return "a table of many levels"
    except ValueError:
        return "a number of thousands of digits"


def _find_long_number(text: str) -> int | None:
    """Return the line of the first number with more than `MAX_DIGITS` digits."""
    pattern = re.compile(rf"[0-9_]{{{MAX_DIGITS + 1},}}")
    lines = text.splitlines()
    return next((row for row, line in enumerate(lines, start=1) if pattern.search(line)), None)

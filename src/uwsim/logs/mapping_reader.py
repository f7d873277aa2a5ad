"""The reader of mapping files, with all of their mistakes."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any, get_args

from ..base.files.input_files import read_document
from ..errors import BadSetting, Diagnostic, FileError, choices
from .frames import BODY_FRAMES, WORLD_FRAMES
from .limits import MAX_COLUMNS, MAX_DIAGNOSTICS, MAX_NAME
from .mapping import (
    SENSOR_KINDS,
    TOPIC_ROLES,
    VELOCITY_FRAMES,
    CommandMapping,
    FrameMapping,
    LogMapping,
    MotionMapping,
    SensorMapping,
    TimeMapping,
)
from .units import UNITS, find_unit
from .vehicle_log import CommandKind

MAX_BYTES = 2**20
"""The greatest size of a mapping file [bytes]."""
MAX_DIGITS = 4000
"""The number of digits of an integer up to which Python certainly reads it."""
MAX_DELAY = 10.0
"""The longest delay of commands [s]."""
MAX_OFFSET = 1e6
"""The greatest offset of the clock of commands [s]."""


class MappingError(FileError):
    """An invalid mapping file."""


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
        motion = self._read_motion(self._section(table, "motion"))
        time = self._read_time(self._section(table, "time"))
        self._check_columns(time, motion, commands, sensors)
        return LogMapping(
            path=str(self._path),
            vehicle=self._text(table, "vehicle", "", "the file"),
            vehicle_line=self._find_line("vehicle", ""),
            time=time,
            frames=self._read_frames(self._section(table, "frames")),
            motion=motion,
            commands=MappingProxyType(commands),
            sensors=MappingProxyType(sensors),
            topics=MappingProxyType(self._read_topics(self._section(table, "topics"))),
        )

    def _check_columns(
        self,
        time: TimeMapping,
        motion: MotionMapping,
        commands: Mapping[CommandKind, CommandMapping],
        sensors: Mapping[str, SensorMapping],
    ) -> None:
        """Report each column that has two places in time, motion and commands, or in a sensor."""
        places = [(time.column, "column", "time")]
        for key in ("position", "quaternion", "rpy", "velocity", "angular_velocity"):
            columns = getattr(motion, key)
            places += [(name, key, "motion") for name in columns if isinstance(name, str)]
        for kind, command in commands.items():
            places += [(name, "columns", f"commands.{kind}") for name in command.columns]
        self._report_repeats(places)
        for name, sensor in sensors.items():
            section = f"sensors.{name}"
            self._report_repeats([(column, "columns", section) for column in sensor.columns])

    def _report_repeats(self, places: list[tuple[str, str, str]]) -> None:
        first_places: dict[str, str] = {}
        repeated_names: set[str] = set()
        for name, key, section in places:
            place = f"{key} of [{section}]"
            if name and name in first_places and name not in repeated_names:
                repeated_names.add(name)
                first = first_places[name]
                text = "twice" if first == place else f"as {first} has"
                self._report(key, f"{place} has {name!r:.60} {text}", section)
            first_places.setdefault(name, place)

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
        columns = {
            key: self._names(table, key, "[motion]", has_constants=key != "quaternion")
            for key in counts
        }
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
        keys = ("columns", "names", "unit", "signs", "delay", "clock_offset")
        self._check_keys(table, keys, label)
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
        delay = self._number(table, "delay", section, 0.0, MAX_DELAY)
        clock_offset = self._number(table, "clock_offset", section, -MAX_OFFSET, MAX_OFFSET)
        return CommandMapping(
            columns=columns,
            names=names,
            unit=self._unit(table, "unit", "", None),
            signs=signs,
            delay=delay,
            clock_offset=clock_offset,
        )

    def _check_commands(
        self, names: tuple[str, ...], signs: tuple[float, ...], section: str
    ) -> None:
        """Report names that are there twice, and factors that are no sign."""
        for name in dict.fromkeys(name for name in names if names.count(name) > 1):
            self._report("names", f"names of [{section}] has {name!r:.60} twice", section)
        for sign in dict.fromkeys(sign for sign in signs if abs(sign) != 1.0):
            message = f"signs of [{section}] has {sign:g}; expected -1 or 1"
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

    def _names(
        self, table: dict[str, Any], key: str, label: str, *, has_constants: bool = False
    ) -> tuple[Any, ...]:
        """Return names of columns; if `has_constants`, a number is a constant."""
        value = table.get(key, [])
        is_valid = isinstance(value, list) and len(value) <= MAX_COLUMNS
        if is_valid and all(
            (isinstance(name, str) and len(name) <= MAX_NAME)
            or (has_constants and _is_number(name))
            for name in value
        ):
            return tuple(name if isinstance(name, str) else float(name) for name in value)
        kind = "texts, or numbers for constants" if has_constants else "texts"
        self._report(key, f"{key} of {label} is {_quote(value)}; expected a list of {kind}")
        return ()

    def _numbers(self, table: dict[str, Any], key: str, label: str) -> tuple[float, ...]:
        value = table.get(key, [])
        is_valid = isinstance(value, list) and len(value) <= MAX_COLUMNS
        if is_valid and all(_is_number(number) for number in value):
            return tuple(float(number) for number in value)
        self._report(key, f"{key} of {label} is {_quote(value)}; expected a list of numbers")
        return ()

    def _number(
        self, table: dict[str, Any], key: str, section: str, low: float, high: float
    ) -> float:
        value = table.get(key, 0.0)
        if _is_number(value) and low <= value <= high:
            return float(value)
        message = f"{key} of [{section}] is {_quote(value)}; expected {low:g} to {high:g} s"
        self._report(key, message, section)
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

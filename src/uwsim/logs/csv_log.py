"""Logs as CSV files: reader and writer.

The first line names the columns. An empty field is a quantity without a sample at that time, so
that one file has series of different rates. `csv_columns` has the names without a mapping file.
"""

from __future__ import annotations

import csv
import io
import math
from array import array
from collections.abc import Iterator, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Protocol

import numpy as np
import numpy.typing as npt

from ..base.files.input_files import compute_hash, read_document
from ..base.geometry import Array
from ..errors import AssetError, Diagnostic, FileError, choices
from .assemble import check_content, make_motion
from .csv_columns import COMMAND_UNITS, SENSOR_UNITS, derive_mapping, list_columns, name_columns
from .frames import convert_body_vectors, quaternions_from_rpy
from .limits import (
    MAX_COLUMNS,
    MAX_COMMAND,
    MAX_DIAGNOSTICS,
    MAX_LINE,
    MAX_SAMPLES,
    MAX_TEXT_BYTES,
    MAX_VALUE,
)
from .mapping import Column, CommandMapping, LogMapping, SensorMapping
from .samples import ClockReset, Samples
from .units import SI_UNITS, UNITS, find_unit
from .vehicle_log import CommandKind, CommandSeries, MotionSeries, SensorSeries, VehicleLog


class Rows(Protocol):
    """The rows of a CSV file."""

    @property
    def line_num(self) -> int:
        """The number of lines read so far."""

    def __iter__(self) -> Iterator[list[str]]:
        """Iterate over the rows."""


class LogError(FileError):
    """An invalid log file."""


def read_csv_log(path: Path, mapping: LogMapping | None = None, vehicle: str = "") -> VehicleLog:
    """Read a log from a CSV file.

    Args:
        path: the file.
        mapping: the columns; None: the names of `csv_columns`.
        vehicle: the name of the vehicle; empty: that of the mapping.

    Raises:
        LogError: the file is invalid; the error has every mistake, with its line and column.
    """
    _check_first_line(path)
    try:
        text = read_document(path, at_most=MAX_TEXT_BYTES).decode("utf-8-sig")
    except FileError as error:
        raise LogError(error.diagnostics) from None
    except UnicodeDecodeError as error:
        raise _error(path, None, f"byte {error.start} is not UTF-8 text") from None
    table = _Table(path, mapping)
    table.read(text)
    try:
        return _Builder(table).build(vehicle)
    except (AssetError, ClockReset) as error:
        raise _error(path, None, str(error)) from None


def _check_first_line(path: Path) -> None:
    """Raise LogError if the first line is too long, before the file is read."""
    if not path.is_file():
        return  # `read_document` reports it
    try:
        with path.open("rb") as stream:
            line = stream.readline(MAX_LINE + 1)
    except OSError:
        return
    if len(line) > MAX_LINE:
        raise _error(path, 1, f"has more than {MAX_LINE} bytes; expected names of columns")
    if line.count(b",") >= MAX_COLUMNS:
        raise _error(path, 1, f"more than {MAX_COLUMNS} columns")


def _limit_lines(text: str) -> Iterator[str]:
    """Yield the lines of a text; raise csv.Error for one that is longer than a row can be."""
    for line in io.StringIO(text):
        if len(line) > MAX_LINE:
            raise csv.Error(f"a line has more than {MAX_LINE} characters")
        yield line


def read_header(path: Path) -> list[str]:
    """Return the columns of a CSV file; raise LogError if it has none."""
    try:
        with path.open(encoding="utf-8-sig", newline="") as stream:
            header = next(csv.reader([stream.readline(2**16)]), [])
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise _error(path, 1, f"cannot be read: {error}") from None
    names = [name.strip() for name in header]
    if not any(names) or len(names) > MAX_COLUMNS:
        raise _error(path, 1, f"expected a line with 1 to {MAX_COLUMNS} names of columns")
    return names


def write_csv_log(log: VehicleLog) -> str:
    """Return the text of a CSV file from which `read_csv_log` reads the same log."""
    header = name_columns(log)
    rows: dict[float, list[float]] = {}

    def add(times: Array, values: Array, column: int) -> None:
        for time, row in zip(times.tolist(), values.tolist(), strict=True):
            cells = rows.setdefault(time, [math.nan] * (len(header) - 1))
            cells[column : column + len(row)] = row

    column = 0
    if log.motion is not None:
        motion = log.motion
        parts = [motion.positions, motion.quaternions]
        parts += [] if motion.twists is None else [motion.twists]
        add(motion.times, np.hstack(parts), column)
        column += sum(part.shape[1] for part in parts)
    all_series: list[CommandSeries | SensorSeries] = [*log.commands, *log.sensors.values()]
    for series in all_series:
        add(series.times, series.values, column)
        column += len(series.names)
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(header)
    for time in sorted(rows):
        cells = ["" if math.isnan(cell) else repr(cell) for cell in rows[time]]
        writer.writerow([repr(time), *cells])
    return stream.getvalue()


class _Table:
    """The numbers of the columns that a mapping names, with all errors of the file."""

    def __init__(self, path: Path, mapping: LogMapping | None) -> None:
        self.path = path
        self._given_mapping = mapping
        self.mapping = mapping or LogMapping()
        self.columns: dict[str, Array] = {}
        self.lines: Array = np.zeros(0)
        self.time_unit = find_unit(self.mapping.time.unit, "time")
        self._diagnostics: list[Diagnostic] = []

    def read(self, text: str) -> None:
        """Read all rows; raise LogError with all errors."""
        rows = csv.reader(_limit_lines(text), strict=True)
        try:
            header = [name.strip() for name in next(rows, [])]
            self._check_header(header)
            self._read_rows(rows, header)
        except csv.Error as error:
            self._report(rows.line_num, f"not CSV: {error}")
        if self._diagnostics:
            raise LogError(self._diagnostics)

    def _check_header(self, header: list[str]) -> None:
        if not any(header):
            raise _error(self.path, 1, "there is no line with the names of columns")
        if len(header) > MAX_COLUMNS:
            raise _error(self.path, 1, f"more than {MAX_COLUMNS} columns")
        if self._given_mapping is None:
            self.mapping = derive_mapping(header)
            if "time" not in header or not (self.mapping.motion.position or self.mapping.commands):
                raise _error(
                    self.path,
                    1,
                    "has no column 'time', or none of the names of uwsim's logs (x, y, z, ..., "
                    "thrusters.NAME). Name its columns in a mapping file: uwsim gap "
                    f"{self.path.name} --write-mapping mapping.toml writes one to edit",
                )
        for column in list_columns(self.mapping):
            if column not in header:
                place = self.mapping.path or "the mapping"
                self._report(
                    1,
                    f"no column is called {column!r} ({place} names it).{choices(column, header)}",
                )
            elif header.count(column) > 1:
                self._report(1, f"{header.count(column)} columns are called {column!r}")
        if self._diagnostics:
            raise LogError(self._diagnostics)

    def _read_rows(self, rows: Rows, header: list[str]) -> None:
        names = list_columns(self.mapping)
        indices = [header.index(name) for name in names]
        numbers = [array("d") for _ in names]
        lines = array("d")
        for count, row in enumerate(rows, start=1):
            if count > MAX_SAMPLES:
                self._report(rows.line_num, f"more than {MAX_SAMPLES} rows")
                return
            if not row:
                continue
            if len(row) != len(header):
                self._report(rows.line_num, f"{len(row)} fields; expected {len(header)}")
                continue
            lines.append(rows.line_num)
            for name, index, column in zip(names, indices, numbers, strict=True):
                column.append(self._read_number(rows.line_num, name, row[index]))
        self.columns = {
            name: np.array(column, dtype=np.float64)
            for name, column in zip(names, numbers, strict=True)
        }
        self.lines = np.array(lines, dtype=np.float64)
        if not len(numbers[0]):
            self._report(None, "there is no row")

    def _read_number(self, line: int, name: str, text: str) -> float:
        try:
            number = float(text)
        except ValueError:
            if not text.strip():
                return math.nan
            self._report(line, f"{name} is {text.strip()!r:.40}; expected a number")
            return math.nan
        if math.isinf(number) or (abs(number) > MAX_VALUE and name != self.mapping.time.column):
            self._report(line, f"{name} is {text.strip()!r:.40}; expected at most {MAX_VALUE:g}")
        return number

    def _report(self, line: int | None, message: str) -> None:
        if len(self._diagnostics) < MAX_DIAGNOSTICS:
            self._diagnostics.append(Diagnostic(file=str(self.path), line=line, message=message))


class _Builder:
    """The assembly of a log from the columns of a table."""

    def __init__(self, table: _Table) -> None:
        self._table, self._mapping = table, table.mapping
        times = table.time_unit.apply(table.columns[self._mapping.time.column])
        finite_times = times[np.isfinite(times)]
        self._start = float(finite_times[0]) if len(finite_times) else 0.0
        self._times = times - self._start
        self._remarks: list[str] = []

    def build(self, vehicle: str) -> VehicleLog:
        mapping, path = self._mapping, self._table.path
        motion = self._make_motion()
        commands = tuple(
            self._make_commands(kind, command) for kind, command in mapping.commands.items()
        )
        sensors = {name: self._make_sensor(name, spec) for name, spec in mapping.sensors.items()}
        check_content(motion, len(commands), path.name)
        return VehicleLog(
            path=str(path),
            format="csv",
            sha256=compute_hash(path),
            vehicle=vehicle or mapping.vehicle,
            motion=motion,
            commands=commands,
            sensors=MappingProxyType(sensors),
            start=self._start,
            remarks=tuple(self._remarks),
        )

    def _stack(self, names: Sequence[Column], unit: str) -> Array:
        conversion = UNITS[unit]
        columns = [self._column(name) for name in names]
        return conversion.apply(np.array(columns, dtype=np.float64).T)

    def _column(self, name: Column) -> Array:
        if not isinstance(name, str):
            return np.full(len(self._times), name)
        if not name:
            return np.full(len(self._times), np.nan)
        return self._table.columns[name]

    def _select(
        self, values: Array, label: str, *, is_motion: bool = False, lines: Array | None = None
    ) -> tuple[Array, Array]:
        """Return the samples with a number in any column, with their times repaired.

        The lines of the samples, if given, are one more column.
        """
        has_sample = np.isfinite(values).any(axis=1)
        if lines is not None:
            values = np.hstack([values, lines[:, None]])
        samples = Samples(values.shape[1], label)
        for time, row in zip(
            self._times[has_sample].tolist(), values[has_sample].tolist(), strict=True
        ):
            samples.append(time, row)
        return samples.finish(self._remarks, is_motion=is_motion)

    def _make_motion(self) -> MotionSeries | None:
        motion, frames = self._mapping.motion, self._mapping.frames
        if motion.quaternion:
            quaternions = self._stack(motion.quaternion, "1")
        elif motion.rpy:
            angles = self._stack(motion.rpy, motion.angle_unit)
            if "" in motion.rpy:  # the log of a surface craft may have the heading alone
                angles[:, [name == "" for name in motion.rpy]] = 0.0
                self._remarks.append("motion: an angle has no column; it counts as 0.")
            quaternions = quaternions_from_rpy(angles)
        else:
            return None
        no_columns = ("", "", "")
        parts = [self._stack(motion.position or no_columns, motion.position_unit), quaternions]
        has_twists = bool(motion.velocity or motion.angular_velocity)
        if has_twists:
            parts.append(self._stack(motion.velocity or no_columns, motion.velocity_unit))
            parts.append(
                self._stack(motion.angular_velocity or no_columns, motion.angular_velocity_unit)
            )
        values = np.hstack(parts)
        # rows of other series have no orientation, which is no defect
        values[~np.isfinite(values[:, 3:7]).all(axis=1)] = np.nan
        if all(not isinstance(name, str) for name in (*motion.quaternion, *motion.rpy)):
            values[~self._has_position()] = np.nan
        times, values = self._select(values, "motion", is_motion=True, lines=self._table.lines)
        return make_motion(
            times,
            values[:, :3],
            values[:, 3:7],
            values[:, 7:-1] if has_twists else None,
            world=frames.world or "local",
            body=frames.body or "base",
            remarks=self._remarks,
            is_world_velocity=motion.velocity_frame == "world",
            origin=frames.origin,
            lines=values[:, -1],
        )

    def _has_position(self) -> npt.NDArray[np.bool_]:
        """Return whether each row has a number in a column of the position, (n,)."""
        has_position = np.zeros(len(self._times), dtype=np.bool_)
        for name in self._mapping.motion.position:
            if isinstance(name, str) and name:
                has_position |= np.isfinite(self._table.columns[name])
        return has_position

    def _make_commands(self, kind: CommandKind, spec: CommandMapping) -> CommandSeries:
        values = self._stack(spec.columns, spec.unit or COMMAND_UNITS[kind] or "1")
        if spec.unit == "pwm" and not (np.abs(self._stack(spec.columns, "1")) > MAX_COMMAND).any():
            self._remarks.append(
                f'commands.{kind}: unit = "pwm", but all values are from -1 to 1; set unit = "1".'
            )
        if spec.signs:
            values = values * np.array(spec.signs)
        times, values = self._select(values, f"commands.{kind}")
        is_complete = np.isfinite(values).all(axis=1)
        if not is_complete.all():
            count = int((~is_complete).sum())
            self._remarks.append(f"commands.{kind}: {count} incomplete samples; removed.")
        return CommandSeries(
            kind=kind,
            names=spec.names or spec.columns,
            times=times[is_complete] + spec.delay + spec.clock_offset,
            values=values[is_complete],
        )

    def _make_sensor(self, name: str, spec: SensorMapping) -> SensorSeries:
        names = spec.names or spec.columns
        units = list(spec.units or (SENSOR_UNITS.get(column, "") for column in names))
        columns = []
        for column, unit in zip(spec.columns, units, strict=True):
            values = self._table.columns[column]
            columns.append(UNITS[unit].apply(values) if spec.units else values)
        table = np.array(columns, dtype=np.float64).T
        table = _convert_triples(table, names, self._mapping)
        times, table = self._select(table, f"sensors.{name}")
        if spec.units:
            units = [SI_UNITS[UNITS[unit].quantity] for unit in units]
        return SensorSeries(
            kind=spec.kind, names=names, units=tuple(units), times=times, values=table
        )


def _convert_triples(table: Array, names: Sequence[str], mapping: LogMapping) -> Array:
    """Return the readings with vectors in base axes: specific force, velocity, angular velocity."""
    frame = mapping.frames.body or "base"
    for triple in (("ax", "ay", "az"), ("u", "v", "w"), ("p", "q", "r")):
        if all(name in names for name in triple):
            indices = [names.index(name) for name in triple]
            table[:, indices] = convert_body_vectors(table[:, indices], frame)
    return table


def _error(path: Path, line: int | None, message: str) -> LogError:
    return LogError([Diagnostic(file=str(path), line=line, message=message)])

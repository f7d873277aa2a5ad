"""Readings as a CSV file, which is written beside a calibration and replaces pictures.

The columns are those of `COLUMNS`. An LED has ``half_angle_deg``; a board has ``square_m``,
``lamp_range_m`` and ``lamp_half_angle_deg``. ``reference``, ``dose``, ``noise``, ``incidence`` may
be empty. Signals are linear in the light, of any unit that is the same for a source. A row without
both sizes is the lamp's veil in open water: ``lamp_range_m`` is the distance from the lamp to the
camera, beside it, and ``signal`` its ratio (`measurements.OpenWaterReading`).
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from ..base.files.input_files import read_document
from ..errors import Diagnostic, FileError, choices
from ..optics.spectral.spectrum_table import find_separator_error
from .measurements import OpenWaterReading, WaterReadings
from .readings import BoardReading, LedReading, Reading

COLUMNS = (
    *("water", "dose", "channel", "source", "range_m", "half_angle_deg", "square_m"),
    *("lamp_range_m", "lamp_half_angle_deg", "incidence", "signal", "reference", "noise"),
)
REQUIRED_COLUMNS = ("water", "channel", "source", "range_m", "signal")
MAX_BYTES = 16 * 2**20
MAX_ROWS = 100_000
MAX_TEXT = 200
OPEN_WATER = "open-water"


class ReadingsError(FileError):
    """An invalid file of readings."""


def write_readings(waters: Iterable[WaterReadings]) -> str:
    """Return the text of a file of readings."""
    stream = io.StringIO()
    writer = csv.DictWriter(stream, COLUMNS, lineterminator="\n", restval="")
    writer.writeheader()
    for water in waters:
        head = {"water": water.name, "dose": "" if water.dose is None else _format(water.dose)}
        for reading in water.readings:
            writer.writerow({**head, **_describe(reading)})
        for veil in water.open_water:
            writer.writerow(
                {
                    **head,
                    "channel": veil.channel,
                    "source": OPEN_WATER,
                    "range_m": "0",
                    "lamp_range_m": _format(math.hypot(*veil.lamp_position[:2])),
                    "lamp_half_angle_deg": _format(math.degrees(veil.lamp_half_angle)),
                    "signal": _format(veil.ratio),
                }
            )
    return stream.getvalue()


def read_readings(
    path: Path, channels: Sequence[str], waters: Sequence[str] = ()
) -> tuple[WaterReadings, ...]:
    """Read a file of readings.

    Args:
        path: the file.
        channels: the channels of the set-up.
        waters: the waters of the set-up; empty: any name is valid.

    Raises:
        ReadingsError: the file is invalid; the error has every mistake, with its line.
    """
    try:
        text = read_document(path, at_most=MAX_BYTES).decode("utf-8-sig")
    except FileError as error:
        raise ReadingsError(error.diagnostics) from None
    except UnicodeDecodeError as error:
        raise _error(path, None, f"byte {error.start} is not UTF-8 text") from None
    table = _Table(path, channels, waters)
    table.read(text)
    return table.make_waters()


def _describe(reading: Reading) -> dict[str, str]:
    row = {
        "channel": reading.channel,
        "source": reading.source,
        "range_m": _format(reading.distance),
        "signal": _format(reading.signal),
        "reference": "" if reading.reference is None else _format(reading.reference),
        "noise": _format(reading.noise),
    }
    if isinstance(reading, LedReading):
        row["half_angle_deg"] = _format(math.degrees(reading.half_angle))
    elif isinstance(reading, BoardReading):
        row["square_m"] = _format(reading.side)
        row["lamp_range_m"] = _format(reading.lamp_distance)
        row["lamp_half_angle_deg"] = _format(math.degrees(reading.lamp_half_angle))
        row["incidence"] = _format(reading.incidence)
    return row


def _format(number: float) -> str:
    return f"{number:.10g}"


def _error(path: Path, line: int | None, message: str) -> ReadingsError:
    return ReadingsError([Diagnostic(file=str(path), line=line, message=message)])


class _Table:
    """The rows of a file, with all of its errors."""

    def __init__(self, path: Path, channels: Sequence[str], waters: Sequence[str]) -> None:
        self._path = path
        self._channels = channels
        self._waters = waters
        self._unknown_waters: set[str] = set()
        self._diagnostics: list[Diagnostic] = []
        self._doses: dict[str, float | None] = {}
        self._readings: dict[str, list[Reading]] = {}
        self._veils: dict[str, list[OpenWaterReading]] = {}

    def read(self, text: str) -> None:
        """Read all rows; raise ReadingsError with all errors."""
        rows = csv.DictReader(io.StringIO(text), strict=True)
        try:
            self._check_header(rows.fieldnames or [])
            for number, row in enumerate(rows, start=1):
                if number > MAX_ROWS:
                    self._report(rows.line_num, f"more than {MAX_ROWS} rows")
                    break
                self._read_row(rows.line_num, row)
        except csv.Error as error:
            self._report(rows.line_num, f"not CSV: {error}")
        if not self._diagnostics and not self._readings:
            self._report(None, "there is no row")
        if self._diagnostics:
            raise ReadingsError(self._diagnostics)

    def make_waters(self) -> tuple[WaterReadings, ...]:
        """Return the waters in the order of their first rows."""
        return tuple(
            WaterReadings(
                name=name,
                dose=self._doses[name],
                readings=tuple(readings),
                open_water=tuple(self._veils.get(name, [])),
            )
            for name, readings in self._readings.items()
        )

    def _check_header(self, columns: Sequence[str]) -> None:
        if error := find_separator_error(columns):
            raise _error(self._path, 1, error)
        for column in columns:
            if column not in COLUMNS:
                self._report(
                    1, f"{column!r:.60} is not a column of readings.{choices(column, COLUMNS)}"
                )
        for column in REQUIRED_COLUMNS:
            if column not in columns:
                self._report(1, f"the column {column!r} is missing")
        if self._diagnostics:
            raise ReadingsError(self._diagnostics)

    def _read_row(self, line: int, row: Mapping[str, str | None]) -> None:
        numbers = {
            column: self._read_number(line, column, row.get(column) or "")
            for column in COLUMNS
            if column not in ("water", "channel", "source")
        }
        texts = {column: (row.get(column) or "").strip() for column in ("water", "source")}
        channel = (row.get("channel") or "").strip()
        count = len(self._diagnostics)
        for column, text in texts.items():
            if not 1 <= len(text) <= MAX_TEXT:
                self._report(line, f"{column} is empty, or longer than {MAX_TEXT} characters")
        if channel not in self._channels:
            suggestion = choices(channel, self._channels)
            self._report(line, f"no channel is called {channel!r:.60}.{suggestion}")
        name = texts["water"]
        if self._waters and name not in (*self._waters, *self._unknown_waters):
            self._unknown_waters.add(name)
            suggestion = choices(name, self._waters)
            self._report(line, f"no water of the set-up is called {name!r:.60}.{suggestion}")
        signal, distance = numbers["signal"], numbers["range_m"]
        if signal is None or not signal > 0.0:
            self._report(line, "signal is not a positive number")
        if distance is None or distance < 0.0:
            self._report(line, "range_m is not a positive number")
        if len(self._diagnostics) > count or signal is None or distance is None:
            return
        self._doses.setdefault(name, numbers["dose"])
        shared_fields = {
            "channel": channel,
            "source": texts["source"],
            "distance": distance,
            "signal": signal,
            "reference": numbers["reference"],
            "noise": numbers["noise"] or 0.0,
        }
        self._add_reading(line, name, shared_fields, numbers)

    def _add_reading(
        self,
        line: int,
        name: str,
        shared_fields: dict[str, object],
        numbers: dict[str, float | None],
    ) -> None:
        readings = self._readings.setdefault(name, [])
        half_angle, side = numbers["half_angle_deg"], numbers["square_m"]
        lamp_distance = numbers["lamp_range_m"]
        lamp_angle = math.radians(numbers["lamp_half_angle_deg"] or 30.0)
        fields: dict[str, Any] = dict(shared_fields)
        if shared_fields["source"] == OPEN_WATER and lamp_distance is not None:
            veil = OpenWaterReading(
                channel=str(shared_fields["channel"]),
                ratio=float(numbers["signal"] or 0.0),
                lamp_position=(lamp_distance, 0.0, 0.0),
                lamp_half_angle=lamp_angle,
            )
            self._veils.setdefault(name, []).append(veil)
        elif not numbers["range_m"]:
            self._report(line, "range_m is not a positive number")
        elif half_angle is not None and side is None and 0.0 < half_angle <= 30.0:
            fields["half_angle"] = math.radians(half_angle)
            readings.append(LedReading(**fields))
        elif side is not None and half_angle is None and side > 0.0 and lamp_distance:
            fields |= {
                "side": side,
                "lamp_distance": lamp_distance,
                "lamp_half_angle": lamp_angle,
                "incidence": numbers["incidence"] or 1.0,
            }
            readings.append(BoardReading(**fields))
        else:
            self._report(
                line,
                "expected half_angle_deg of an LED (up to 30), or square_m and lamp_range_m of a "
                "board",
            )

    def _read_number(self, line: int, column: str, text: str) -> float | None:
        if not text.strip():
            return None
        try:
            number = float(text)
        except ValueError:
            number = math.nan
        if not math.isfinite(number) or abs(number) > 1e12:
            self._report(line, f"{column} is {text.strip()!r:.40}; expected a number")
            return None
        return number

    def _report(self, line: int | None, message: str) -> None:
        if len(self._diagnostics) < 100:
            self._diagnostics.append(Diagnostic(file=str(self._path), line=line, message=message))

"""Result: the rows of a run with its inputs, columns and constants.

A result is a pure function of inputs, seed and versions: the same run gives the same bytes. Other
facts (wall time, host, date) are in ``provenance.json``. `result_file` reads and writes results.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Literal, get_args

from ..base.deprecation import deprecated_name
from ..errors import ResultError, UnknownName
from .inputs import Inputs
from .run_info import RunInfo
from .stored.checked_values import checked_values

MAX_VALUE = 1e60
"""The largest absolute value in a row; powers and sums of such values still fit in a float64."""

Kind = Literal["run", "level", "measure", "detail", "score", "status", "time"]
Cell = float | int | str | None
Json = Mapping[str, object]

ERROR_FLOOR_PREFIX = "floor_"
"""The prefix of the facts with the error floor of a measure."""


@dataclass(frozen=True, kw_only=True)
class Column:
    """A column of the rows: its name, kind and unit."""

    name: str
    """``fog``, ``corners``, ``corners.mean``, ``total``, ``status``, ``ended_at``, ``seed``."""
    kind: Kind
    """``run`` is repeat or seed; a ``detail`` belongs to the measure before its first dot."""
    unit: str | None = None
    """The unit, such as ``px`` or ``1/m``; None if there is none."""
    expression: str | None = None
    """The function that computes a score from the measures; None for other columns."""

    @property
    def label(self) -> str:
        """The name and unit for people: ``corners [px]``."""
        return f"{self.name} [{self.unit}]" if self.unit else self.name


@dataclass(frozen=True, kw_only=True)
class MissingValue:
    """A missing value (a null cell), with the reason."""

    row: int
    """The index of the row, from 0."""
    column: str
    """The name of the column."""
    reason: str
    """The reason, with the time at which it arose, as text; ``why`` in the file."""

    @property
    @deprecated_name("reason")
    def why(self) -> str:
        """The old name of `reason`."""
        return self.reason


@dataclass(frozen=True, kw_only=True)
class Variation:
    """A value of the scene or the benchmark that differs from seed to seed."""

    path: str
    """The path of the value, as ``--set`` names it."""
    unit: str
    """The unit; ``1`` if the value has no unit, or its unit is unknown."""
    drawn_from: str
    """The distribution in words: ``uniform 1.95 to 2.05``."""
    values: tuple[tuple[int, float], ...]
    """The seed and value of each repeat, in the order of the repeats."""

    def __post_init__(self) -> None:
        if isinstance(self.values, tuple):  # JSON has lists for pairs
            pairs = tuple(tuple(pair) if isinstance(pair, list) else pair for pair in self.values)
            object.__setattr__(self, "values", pairs)


@dataclass(frozen=True, kw_only=True)
class ImageStream:
    """The hash of all images that one trial published on a topic."""

    seed: int
    """The seed of the trial."""
    level: tuple[float, ...] | None
    """The values of the trial's level, outermost first; None if the trial runs all levels."""
    topic: str
    """The topic of the images."""
    frames: int
    """The number of images."""
    sha256: str
    """The SHA-256 of the bytes of all images, in order."""


@dataclass(frozen=True, kw_only=True)
class SavedImage:
    """A camera's image at the end of a level, kept for the report."""

    row: int
    """The index of the row that the image belongs to, from 0."""
    camera: str
    """The name of the camera."""
    file: str
    """The path of the PNG file, relative to the result directory."""
    truth: tuple[float, ...] | None = None
    """The true corners of the target, x, y, x, y, ... [px], from the centre of the top left pixel;
    None if no measure compares corners."""
    estimate: tuple[float, ...] | None = None
    """The corners in the algorithm's last estimate, in this order [px]; None without one."""


@dataclass(frozen=True, kw_only=True)
class RefusedMessages:
    """Messages, calls or answers of a program that does not take part, which were refused."""

    row: int
    """The index of the row in whose level they arrived, from 0."""
    sender: str
    """The sender, as the transport names it; ``by`` in the file."""
    topic_or_service: str
    """The topic or service, with a leading slash; ``what`` in the file."""
    n: int
    """The number of messages, calls or answers."""

    @property
    @deprecated_name("sender")
    def by(self) -> str:
        """The old name of `sender`."""
        return self.sender

    @property
    @deprecated_name("topic_or_service")
    def what(self) -> str:
        """The old name of `topic_or_service`."""
        return self.topic_or_service


@dataclass(frozen=True, kw_only=True)
class Remark:
    """A note on a row, which does not affect its status."""

    row: int
    """The index of the row, from 0."""
    text: str
    """The measures and the notes on them."""


@dataclass(frozen=True, kw_only=True)
class Result:
    """The rows of a run with its inputs, columns and constants.

    All numbers are finite, numbers in rows are at most `MAX_VALUE`, and every row has one cell for
    each column; otherwise the constructor raises ResultError.
    """

    inputs: Inputs
    """The names and hashes of the files read."""
    run: RunInfo
    """The seed, mode, algorithm, parameters, timestep and versions."""
    columns: tuple[Column, ...]
    """The name, kind and unit of each cell of a row."""
    rows: tuple[tuple[Cell, ...], ...]
    """A row for each level (and repeat), in the order of execution."""
    missing_values: tuple[MissingValue, ...] = ()
    """The null cells with their reasons; ``missing`` in the file."""
    facts: Json = field(default_factory=dict)
    """The values measured for the whole run as (value, unit), such as ``S``, ``sigma``, ``d`` and
    ``f_star``: from the first trial, and for ``floor_...`` the largest of all trials."""
    variations: tuple[Variation, ...] = ()
    """The values that were drawn for each seed."""
    image_streams: tuple[ImageStream, ...] = ()
    """Fingerprints of the images that the algorithm received."""
    images: tuple[SavedImage, ...] = ()
    """Images kept for the report."""
    refused_messages: tuple[RefusedMessages, ...] = ()
    """The messages of programs that do not take part; ``refused`` in the file."""
    remarks: tuple[Remark, ...] = ()
    """The notes on rows that do not affect their status."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "facts", checked_values(self.facts, "facts"))
        notes_of_rows = "missing_values", "images", "refused_messages", "remarks"
        for name in ("columns", "variations", "image_streams", *notes_of_rows):
            object.__setattr__(self, name, tuple(getattr(self, name)))
        object.__setattr__(self, "rows", checked_values(self.rows, "rows"))
        _check_columns(self)
        _check_rows(self)
        _check_notes(self)

    def index(self, name: str) -> int:
        """Return the index of a column in every row; raise UnknownName if there is none."""
        names = [column.name for column in self.columns]
        if name not in names:
            raise UnknownName("column", name, names)
        return names.index(name)

    def values(self, name: str) -> tuple[Cell, ...]:
        """Return the cells of a column, in the order of the rows."""
        index = self.index(name)
        return tuple(row[index] for row in self.rows)

    def numbers(self, name: str) -> tuple[float | None, ...]:
        """Return the cells of a column as floats; None for a missing value or a text."""
        return tuple(float(v) if isinstance(v, int | float) else None for v in self.values(name))

    def columns_of_kind(self, *kinds: Kind) -> tuple[Column, ...]:
        """Return the columns of these kinds, in their order."""
        return tuple(column for column in self.columns if column.kind in kinds)

    def reason(self, row: int, column: str) -> str | None:
        """Return the reason why a cell is null; a detail has the reason of its measure."""
        reasons = self._reasons.get(row, {})
        return reasons.get(column) or reasons.get(column.split(".")[0])

    def reasons(self, row: int) -> tuple[str, ...]:
        """Return the reasons of a row's missing values, each once, without reasons of details."""
        reasons = self._reasons.get(row, {})
        return tuple(
            dict.fromkeys(reason for column, reason in reasons.items() if "." not in column)
        )

    def remarks_of(self, row: int) -> tuple[str, ...]:
        """Return the remarks on a row."""
        return tuple(remark.text for remark in self.remarks if remark.row == row)

    @cached_property
    def _reasons(self) -> dict[int, dict[str, str]]:
        reasons: dict[int, dict[str, str]] = {}
        for note in self.missing_values:
            reasons.setdefault(note.row, {})[note.column] = note.reason
        return reasons

    @property
    @deprecated_name("missing_values")
    def missing(self) -> tuple[MissingValue, ...]:
        """The old name of `missing_values`."""
        return self.missing_values

    @property
    @deprecated_name("refused_messages")
    def refused(self) -> tuple[RefusedMessages, ...]:
        """The old name of `refused_messages`."""
        return self.refused_messages

    @deprecated_name("columns_of_kind")
    def of_kind(self, *kinds: Kind) -> tuple[Column, ...]:
        """Return `columns_of_kind`, whose old name this is."""
        return self.columns_of_kind(*kinds)

    @deprecated_name("reason")
    def why(self, row: int, column: str) -> str | None:
        """Return `reason`, whose old name this is."""
        return self.reason(row, column)

    def fact(self, name: str) -> tuple[float, str] | None:
        """Return a measured constant as (value, unit); None if it was not measured."""
        entry = self.facts.get(name)
        if not isinstance(entry, tuple) or len(entry) != 2 or not isinstance(entry[0], int | float):
            return None
        return float(entry[0]), str(entry[1])


def _check_columns(result: Result) -> None:
    names = [column.name for column in result.columns]
    for i, column in enumerate(result.columns):
        _expect(isinstance(column.name, str) and column.name != "", f"columns[{i}] has no name")
        _expect(
            column.kind in get_args(Kind),
            f"columns[{i}] ({column.name}) is of kind {column.kind!r}; "
            f"expected one of {', '.join(get_args(Kind))}",
        )
        _expect(names.index(column.name) == i, f"two columns are called {column.name!r}")


def _check_rows(result: Result) -> None:
    n = len(result.columns)
    for i, row in enumerate(result.rows):
        _expect(isinstance(row, tuple), f"rows[{i}] is no list of cells")
        _expect(len(row) == n, f"rows[{i}] has {len(row)} cells, there are {n} columns")
        for column, cell in zip(result.columns, row, strict=True):
            is_valid = isinstance(cell, str) if column.kind == "status" else _is_number(cell)
            _expect(
                is_valid or (cell is None and column.kind not in ("run", "level")),
                f"rows[{i}], column {column.name!r}: {repr(cell)[:60]} cannot be a {column.kind}"
                + f"; expected a number up to {MAX_VALUE:g}" * (column.kind != "status"),
            )


def _check_notes(result: Result) -> None:
    n, names = len(result.rows), {column.name: i for i, column in enumerate(result.columns)}
    for i, note in enumerate(result.missing_values):
        position = f"missing[{i}]"
        _expect(_is_row(note.row, n), f"{position} is about row {note.row!r}, which is not there")
        _expect(note.column in names, f"{position} is about {note.column!r}, which is no column")
        cell = result.rows[note.row][names[note.column]]
        _expect(
            cell is None, f"{position}: row {note.row} has a value for {note.column!r}: {cell!r}"
        )
        _expect(isinstance(note.reason, str) and note.reason != "", f"{position} gives no reason")
    n_levels = len(result.columns_of_kind("level"))
    for i, stream in enumerate(result.image_streams):
        is_valid = isinstance(stream.sha256, str) and isinstance(stream.frames, int)
        _expect(is_valid, f"image_streams[{i}] has no hash or no number of frames")
        has_all_levels = isinstance(stream.level, tuple) and len(stream.level) == n_levels
        message = f"image_streams[{i}] is of the level {stream.level!r}; expected {n_levels} values"
        _expect(stream.level is None or has_all_levels, message)
    for i, variation in enumerate(result.variations):
        position = f"variations[{i}]"
        texts = (variation.path, variation.unit, variation.drawn_from)
        _expect(all(isinstance(text, str) and text for text in texts), f"{position} lacks words")
        is_valid = isinstance(variation.values, tuple) and all(map(_is_draw, variation.values))
        _expect(
            is_valid,
            f"{position} ({variation.path}) has something else than pairs of seed and value",
        )
    for i, image in enumerate(result.images):
        position = f"pictures[{i}]"
        _expect(_is_row(image.row, n), f"{position} is of row {image.row!r}, which is not there")
        _expect(_is_inside(image.file), f"{position} is outside the result: {image.file!r}")
        for quad in (image.truth, image.estimate):
            is_valid = quad is None or (len(quad) == 8 and all(_is_number(v) for v in quad))
            _expect(is_valid, f"{position} has a quadrangle of other than 8 numbers: {quad!r}")
    notes: dict[str, Sequence[RefusedMessages | Remark]]
    notes = {"refused": result.refused_messages, "remarks": result.remarks}
    for name, entries in notes.items():
        for i, entry in enumerate(entries):
            is_there = _is_row(entry.row, n)
            _expect(is_there, f"{name}[{i}] is about row {entry.row!r}, which is not there")


def _is_number(cell: object) -> bool:
    return isinstance(cell, int | float) and not isinstance(cell, bool) and abs(cell) <= MAX_VALUE


def _is_draw(pair: object) -> bool:
    return (
        isinstance(pair, tuple)
        and len(pair) == 2
        and isinstance(pair[0], int)
        and all(map(_is_number, pair))
    )


def _is_row(row: object, n: int) -> bool:
    return isinstance(row, int) and not isinstance(row, bool) and 0 <= row < n


def _is_inside(file: object) -> bool:
    return isinstance(file, str) and not Path(file).is_absolute() and ".." not in Path(file).parts


def _expect(condition: bool, message: str) -> None:
    if not condition:
        raise ResultError(message + ".")

"""The content of the lines of a journal: a row for a finished level, and the end of a trial."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any

Record = dict[str, Any]
ValueWithUnit = tuple[float | None, str]
"""A value and its unit."""
StoredFact = tuple[Any, str]
"""A quantity measured for the whole trial, and its unit."""
Sample = Sequence[Any]
"""A sample of a log: the time in the level [s], then the columns of `StoredRow.log_headers`."""


@dataclass(frozen=True, kw_only=True)
class StoredImage:
    """The last image of a camera in a level."""

    camera: str
    """The name of the camera."""
    file: str
    """The path of the PNG file, relative to the result directory."""
    truth: tuple[float, ...] | None
    """x, y of the target's four corners [px]; None if no measure compares corners."""
    estimate: tuple[float, ...] | None
    """x, y of the four corners in the algorithm's last estimate [px]; None without an estimate."""


@dataclass(frozen=True, kw_only=True)
class StoredRow:
    """The result of one level."""

    values: tuple[float, ...]
    """The values of the swept parameters, outermost first."""
    measures: Mapping[str, ValueWithUnit]
    """The value and unit of each measure."""
    details: Mapping[str, ValueWithUnit]
    """The value and unit of each ``measure.detail``."""
    total: float | None
    """The score of the level; None if it is missing."""
    status: str
    """``ok``, or the first status of docs/levels.md that applies."""
    missing: Mapping[str, str]
    """The reason of each missing (null) value, by column."""
    ended_at: float | None
    """The simulation time at the end of the level [s]; None in files of early versions."""
    duration: float
    """The duration of the measurement [s of simulation time]."""
    logs: Mapping[str, Sequence[Sample]]
    """The samples of each measure that has a log."""
    log_headers: Mapping[str, tuple[str, ...]]
    """The columns of each measure's samples after the time, with units."""
    pictures: tuple[StoredImage, ...]
    """The cameras' last images."""
    fingerprint: str | None
    """The fingerprint of every body's motion and of every image since the trial began."""
    refused: tuple[tuple[str, str, int], ...] = ()
    """The refused messages of programs that do not take part: sender, topic or service, number."""
    remarks: tuple[str, ...] = ()
    """Notes on the level that do not affect its status, each with the names of its measures."""

    @classmethod
    def from_dict(cls, record: Record) -> StoredRow:
        """Return the row of a record whose shape was checked (`stored_shapes.ROW`)."""
        return cls(
            values=tuple(record["values"]),
            measures=_values_with_units(record["measures"]),
            details=_values_with_units(record["details"]),
            total=record["total"],
            status=record["status"],
            missing=record["missing"],
            ended_at=record.get("ended_at"),
            duration=record["duration"],
            logs=record["logs"],
            log_headers={name: tuple(header) for name, header in record["log_headers"].items()},
            pictures=tuple(
                StoredImage(
                    camera=picture["camera"],
                    file=picture["file"],
                    truth=_corners(picture["truth"]),
                    estimate=_corners(picture["estimate"]),
                )
                for picture in record["pictures"]
            ),
            fingerprint=record.get("fingerprint"),
            refused=tuple((sender, topic, n) for sender, topic, n in record.get("refused", ())),
            remarks=tuple(record.get("remarks", ())),
        )

    def record(self) -> Record:
        """Return the record to write, without optional keys that have no value."""
        record = {field.name: getattr(self, field.name) for field in fields(self)}
        record["pictures"] = [vars(picture) for picture in self.pictures]
        for name in ("refused", "remarks"):
            if not record[name]:
                del record[name]
        for name in ("ended_at", "fingerprint"):
            if record[name] is None:
                del record[name]
        return record


@dataclass(frozen=True, kw_only=True)
class StoredEnd:
    """The end of a trial: all that is stored of the trial besides its rows."""

    facts: Mapping[str, StoredFact]
    """The value and unit of each quantity measured for the whole trial."""
    parameters: Mapping[str, float | str]
    """The parameters of the algorithm, including defaults."""
    streams: tuple[tuple[str, int, str], ...]
    """The topic, the number of images and the SHA-256 of all pixels of each stream of images."""
    notes: tuple[str, ...]
    """Notes for the reader of the result."""
    trace: Record | None
    """The checkpoints (`uwsim.runs.trial.fingerprint`); None in files of early versions."""

    @classmethod
    def from_dict(cls, record: Record) -> StoredEnd:
        """Return the end of a record whose shape was checked (`stored_shapes.END`)."""
        return cls(
            facts={name: (value, unit) for name, (value, unit) in record["facts"].items()},
            parameters=record["parameters"],
            streams=tuple((topic, n, sha256) for topic, n, sha256 in record["streams"]),
            notes=tuple(record["notes"]),
            trace=record.get("trace"),
        )

    def record(self) -> Record:
        """Return the record to write."""
        record = {field.name: getattr(self, field.name) for field in fields(self)}
        if self.trace is None:
            del record["trace"]
        return record


def _values_with_units(record: Record) -> dict[str, ValueWithUnit]:
    return {name: (value, unit) for name, (value, unit) in record.items()}


def _corners(numbers: Sequence[float] | None) -> tuple[float, ...] | None:
    return None if numbers is None else tuple(numbers)

"""The lines of a journal, with their values by name: a finished level, and the end of a trial."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any

Record = dict[str, Any]
ValueWithUnit = tuple[float | None, str]
"""A value and its unit."""
StoredFact = tuple[Any, str]
"""A constant of the scene and its unit."""
Sample = Sequence[Any]
"""A line of a log: the time in the level [s], and the values of `StoredRow.log_headers`."""


@dataclass(frozen=True, kw_only=True)
class StoredPicture:
    """The last image of a camera in a level."""

    camera: str
    """The camera."""
    file: str
    """The file, from the directory of the result."""
    truth: tuple[float, ...] | None
    """The corners of the target, x and y of each [px]."""
    estimate: tuple[float, ...] | None
    """The same as the algorithm published them last."""


@dataclass(frozen=True, kw_only=True)
class StoredRow:
    """The result of one level."""

    values: tuple[float, ...]
    """The values of the level, the outermost first."""
    measures: Mapping[str, ValueWithUnit]
    """The value and unit of each measure."""
    details: Mapping[str, ValueWithUnit]
    """The value and unit of each ``measure.detail``."""
    total: float | None
    """The score."""
    status: str
    """``ok``, or the first status of docs/levels.md that applies."""
    missing: Mapping[str, str]
    """The reason of each null column."""
    ended_at: float | None
    """The simulation time at the end of the level [s]; None in files of early versions."""
    duration: float
    """The duration of the measurement [s]."""
    logs: Mapping[str, Sequence[Sample]]
    """The samples of each measure."""
    log_headers: Mapping[str, tuple[str, ...]]
    """The columns of each measure's samples after the time, with units."""
    pictures: tuple[StoredPicture, ...]
    """The cameras' last images."""
    fingerprint: str | None
    """The fingerprint of every body's motion and of every image since the trial began."""
    refused: tuple[tuple[str, str, int], ...] = ()
    """The refused messages of programs that do not take part: sender, topic or service, number."""
    remarks: tuple[str, ...] = ()
    """Notes beside its status, each with the measure that it is about."""

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
                StoredPicture(
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
        """Return the record to write, without unknown or empty values that may be absent."""
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
    """The end of a trial: everything that it stores besides its rows."""

    facts: Mapping[str, StoredFact]
    """The constants of the scene: name -> value and unit."""
    parameters: Mapping[str, float | str]
    """The parameters of the algorithm, defaults included."""
    streams: tuple[tuple[str, int, str], ...]
    """The topic, number of images and SHA-256 over their pixels of each stream."""
    notes: tuple[str, ...]
    """Notes for the reader of the result."""
    trace: Record | None
    """The fingerprints on the way (`uwsim.runs.trial.fingerprint`); None in early versions."""

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

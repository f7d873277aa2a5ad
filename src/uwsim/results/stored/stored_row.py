"""The lines of a journal, with their values by name: a finished level, and the end of a trial."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any

Record = dict[str, Any]
Measured = tuple[float | None, str]
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
    measures: Mapping[str, Measured]
    """Measure -> value and unit."""
    details: Mapping[str, Measured]
    """``measure.detail`` -> value and unit."""
    total: float | None
    """The score."""
    status: str
    """``ok``, or the first status of docs/levels.md that applies."""
    missing: Mapping[str, str]
    """Column -> why it is null."""
    ended_at: float | None
    """The simulation time at the end of the level [s]; None in files of early versions."""
    duration: float
    """How long the level was measured [s]."""
    logs: Mapping[str, Sequence[Sample]]
    """Measure -> samples."""
    log_headers: Mapping[str, tuple[str, ...]]
    """Measure -> columns of its samples after the time, with units."""
    pictures: tuple[StoredPicture, ...]
    """The cameras' last images."""
    fingerprint: str | None
    """The fingerprint of every body's motion and of every image since the trial began."""
    refused: tuple[tuple[str, str, int], ...] = ()
    """What came from programs that do not take part: sender, topic or service, how often."""
    remarks: tuple[str, ...] = ()
    """What belongs beside its status, with the measure it is about."""

    @classmethod
    def of(cls, record: Record) -> StoredRow:
        """Return the row of a record whose shape was checked (`stored_shapes.ROW`)."""
        return cls(
            values=tuple(record["values"]),
            measures=_measured(record["measures"]),
            details=_measured(record["details"]),
            total=record["total"],
            status=record["status"],
            missing=record["missing"],
            ended_at=record.get("ended_at"),
            duration=record["duration"],
            logs=record["logs"],
            log_headers={name: tuple(header) for name, header in record["log_headers"].items()},
            pictures=tuple(
                StoredPicture(
                    camera=each["camera"],
                    file=each["file"],
                    truth=_corners(each["truth"]),
                    estimate=_corners(each["estimate"]),
                )
                for each in record["pictures"]
            ),
            fingerprint=record.get("fingerprint"),
            refused=tuple((by, what, n) for by, what, n in record.get("refused", ())),
            remarks=tuple(record.get("remarks", ())),
        )

    def record(self) -> Record:
        """Return what is written, without what is not known or empty and may be left out."""
        found = {each.name: getattr(self, each.name) for each in fields(self)}
        found["pictures"] = [vars(picture) for picture in self.pictures]
        for name in ("refused", "remarks"):
            if not found[name]:
                del found[name]
        for name in ("ended_at", "fingerprint"):
            if found[name] is None:
                del found[name]
        return found


@dataclass(frozen=True, kw_only=True)
class StoredEnd:
    """What a trial leaves besides its rows."""

    facts: Mapping[str, StoredFact]
    """Constants of the scene: name -> value and unit."""
    parameters: Mapping[str, float | str]
    """The parameters of the algorithm, defaults included."""
    streams: tuple[tuple[str, int, str], ...]
    """Topic, number of images, SHA-256 over their pixels."""
    notes: tuple[str, ...]
    """What the reader of the result should know, besides the values."""
    trace: Record | None
    """The fingerprints on the way (`uwsim.runs.trial.fingerprint`); None in early versions."""

    @classmethod
    def of(cls, record: Record) -> StoredEnd:
        """Return the end of a record whose shape was checked (`stored_shapes.END`)."""
        return cls(
            facts={name: (value, unit) for name, (value, unit) in record["facts"].items()},
            parameters=record["parameters"],
            streams=tuple((topic, n, sha256) for topic, n, sha256 in record["streams"]),
            notes=tuple(record["notes"]),
            trace=record.get("trace"),
        )

    def record(self) -> Record:
        """Return what is written."""
        found = {each.name: getattr(self, each.name) for each in fields(self)}
        if self.trace is None:
            del found["trace"]
        return found


def _measured(record: Record) -> dict[str, Measured]:
    return {name: (value, unit) for name, (value, unit) in record.items()}


def _corners(stored: Sequence[float] | None) -> tuple[float, ...] | None:
    return None if stored is None else tuple(stored)

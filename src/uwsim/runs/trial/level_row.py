"""What the levels of a trial leave behind: a row each, and at its end a record of the whole."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from .fingerprint import Checkpoints
from .snapshots import Snapshot
from .status import SIMULATION_ERROR
from .triggered_measure import Sample, TriggeredMeasure, finite
from .visibility import Fact


@dataclass(frozen=True, kw_only=True)
class LevelRow:
    """The result of one level."""

    values: tuple[tuple[str, float], ...]
    """The level: swept parameters and values, outermost first."""
    measures: dict[str, tuple[float | None, str]]
    """Measure -> value and unit."""
    details: dict[str, tuple[float | None, str]]
    """``measure.detail`` -> value and unit."""
    total: float | None
    """The score."""
    status: str
    """``ok``, or the first status of docs/levels.md that applies."""
    missing: dict[str, str]
    """Column -> why it is null."""
    ended_at: float
    """Simulation time at the end of the level [s]."""
    duration: float
    """How long the level was measured [s]."""
    logs: dict[str, list[Sample]]
    """Measure -> samples: time in the level [s], then `log_headers`."""
    log_headers: dict[str, tuple[str, ...]]
    """Measure -> columns of its samples after the time, with units."""
    fingerprint: str
    """Of every body's motion and of every image, since the trial began (`fingerprint`)."""
    snapshots: tuple[Snapshot, ...]
    """The cameras' last images."""
    refused: tuple[tuple[str, str, int], ...] = ()
    """What came from programs that do not take part: sender, topic or service, how often."""
    remarks: tuple[str, ...] = ()
    """What belongs beside its status, with the measure it is about."""


@dataclass(frozen=True, kw_only=True)
class TrialEnd:
    """The end of a trial: its constants, notes and fingerprints."""

    facts: dict[str, Fact]
    """Constants of the scene, and how far the target moved in the image."""
    parameters: dict[str, float | str]
    """Parameters of the algorithm, defaults included."""
    streams: tuple[tuple[str, int, str], ...]
    """Topic, number of images, SHA-256 over their pixels."""
    notes: tuple[str, ...]
    """What the reader of the result should know, besides the values."""
    checkpoints: Checkpoints
    """Fingerprints on the way."""
    motion: bytes
    """The motion track (`uwsim.results.motion`)."""
    inputs: bytes = b""
    """What a pilot did (`pilot_inputs`); empty where nobody pilots."""


@dataclass(frozen=True)
class Cells:
    """The values of the measures at the end of a level."""

    values: dict[str, float | None] = field(default_factory=dict)
    """Measure -> value."""
    units: dict[str, str] = field(default_factory=dict)
    """Measure -> unit."""
    details: dict[str, tuple[float | None, str]] = field(default_factory=dict)
    """``measure.detail`` -> value and unit."""
    missing: dict[str, str] = field(default_factory=dict)
    """Column -> why it is null."""


def cells_of(measures: Sequence[TriggeredMeasure], status: str, why: str | None) -> Cells:
    """Return the values of measures.

    Those that the algorithm feeds are null if the row is not ok. In a ``timeout`` they keep what
    they have: a measure that waited for estimates has no value by itself, the others do.
    """
    cells = Cells()
    for triggered in measures:
        name, measure = triggered.spec.name, triggered.measure
        blank = status == SIMULATION_ERROR or (status != "ok" and measure.fed_by_algorithm)
        if status == "timeout" and finite(triggered.value)[0] is not None:
            blank = False
        cells.units[name] = measure.unit
        cells.values[name], reason = (None, why) if blank else finite(triggered.value)
        if cells.values[name] is None:
            cells.missing[name] = reason or measure.why or "nothing to measure"
        for detail, value in measure.details.items():
            unit = "1" if detail.split(".")[-1] == "n" else measure.unit
            unit = measure.detail_units.get(detail.partition(".")[0], unit)
            unit = measure.detail_units.get(detail, unit)
            number, reason = (None, None) if blank else finite(value)
            cells.details[f"{name}.{detail}"] = (number, unit)
            if number is None and triggered.has_start_value:
                reason = measure.why
            if reason is not None:
                cells.missing[f"{name}.{detail}"] = reason
        if not blank:
            cells.missing.update(
                {f"{name}.{detail}": message for detail, message in measure.reasons.items()}
            )
    return cells

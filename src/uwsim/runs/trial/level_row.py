"""The values of a trial to store: a row for each level, and a record of the whole at the end."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from ...base.expression import Expression
from ...benchmark.updaters import Level
from ...simulation import Simulation
from .fingerprint import Checkpoints
from .images.snapshots import Snapshot
from .log_columns import log_columns
from .status import SIMULATION_ERROR
from .triggered_measure import Sample, TriggeredMeasure, find_outcome, finite_value
from .visibility import Fact


@dataclass(frozen=True, kw_only=True)
class LevelRow:
    """The result of one level."""

    values: tuple[tuple[str, float], ...]
    """The level: swept parameters and values, outermost first."""
    measures: dict[str, tuple[float | None, str]]
    """The value and unit of each measure."""
    details: dict[str, tuple[float | None, str]]
    """The value and unit of each ``measure.detail``."""
    total: float | None
    """The score of the level; None without one (`has_score`)."""
    status: str
    """``ok``, or the first status of docs/levels.md that applies."""
    missing_reasons: dict[str, str]
    """The reason of each missing (null) value, by column."""
    ended_at: float
    """The simulation time at the end of the level [s]."""
    duration: float
    """The duration of the measurement [s of simulation time]."""
    logs: dict[str, list[Sample]]
    """The samples of each measure: time in the level [s], then the columns of `log_headers`."""
    log_headers: dict[str, tuple[str, ...]]
    """The columns of each measure's samples after the time, with units."""
    fingerprint: str
    """The fingerprint of all motion and images since the trial began (`fingerprint`)."""
    snapshots: tuple[Snapshot, ...]
    """The cameras' last images."""
    refused_messages: tuple[tuple[str, str, int], ...] = ()
    """The refused messages of programs that do not take part: sender, topic or service, number."""
    remarks: tuple[str, ...] = ()
    """Notes on the level that do not affect its status, each with the names of its measures."""


@dataclass(frozen=True, kw_only=True)
class TrialEnd:
    """The end of a trial: its constants, notes and fingerprints."""

    facts: dict[str, Fact]
    """Values that hold for the whole trial, with units: image statistics and error floors."""
    parameters: dict[str, float | str]
    """The parameters of the algorithm, including defaults."""
    streams: tuple[tuple[str, int, str], ...]
    """The topic, the number of images and the SHA-256 of all pixels of each stream of images."""
    notes: tuple[str, ...]
    """Notes for the reader of the result."""
    checkpoints: Checkpoints
    """The fingerprints during the trial."""
    motion: bytes
    """The file of the motion track (`uwsim.results.motion`)."""
    inputs: bytes = b""
    """The file of a pilot's inputs (`pilot_inputs`); empty without a pilot."""


@dataclass(frozen=True)
class Cells:
    """The values of the measures at the end of a level."""

    values: dict[str, float | None] = field(default_factory=dict)
    """The value of each measure."""
    units: dict[str, str] = field(default_factory=dict)
    """The unit of each measure."""
    details: dict[str, tuple[float | None, str]] = field(default_factory=dict)
    """The value and unit of each ``measure.detail``."""
    missing_reasons: dict[str, str] = field(default_factory=dict)
    """The reason of each missing (null) value, by column."""


def has_score(measures: Sequence[TriggeredMeasure], status: str) -> bool:
    """Return whether a level has a score: its status is ``ok``, or it ended as it should.

    An outcome judges complete levels, whose measures stay comparable. Only a failure that ends a
    level before its time leaves no score.
    """
    outcome = find_outcome(measures)
    if status == "ok" or outcome is None:
        return status == "ok"
    return outcome.is_complete and outcome.task_status[0] == status


def cells_of(measures: Sequence[TriggeredMeasure], status: str, status_reason: str | None) -> Cells:
    """Return the values of measures at the end of a level.

    Without a score (`has_score`), a measure that the algorithm feeds has no value; with ``timeout``
    it keeps a value that it has. After a simulation error no measure has a value.
    """
    cells, is_scored = Cells(), has_score(measures, status)
    for triggered_measure in measures:
        name, measure = triggered_measure.spec.name, triggered_measure.measure
        is_blank = status == SIMULATION_ERROR or (not is_scored and measure.fed_by_algorithm)
        if status == "timeout" and finite_value(triggered_measure.value)[0] is not None:
            is_blank = False
        cells.units[name] = measure.unit
        cells.values[name], reason = (
            (None, status_reason) if is_blank else finite_value(triggered_measure.value)
        )
        if cells.values[name] is None:
            cells.missing_reasons[name] = reason or measure.missing_reason or "nothing to measure"
        for detail, value in measure.details.items():
            unit = "1" if detail.split(".")[-1] == "n" else measure.unit
            unit = measure.detail_units.get(detail.partition(".")[0], unit)
            unit = measure.detail_units.get(detail, unit)
            number, reason = (None, None) if is_blank else finite_value(value)
            cells.details[f"{name}.{detail}"] = (number, unit)
            if number is None and triggered_measure.has_start_value:
                reason = measure.missing_reason
            if reason is not None:
                cells.missing_reasons[f"{name}.{detail}"] = reason
        if not is_blank:
            cells.missing_reasons.update(
                {f"{name}.{detail}": message for detail, message in measure.reasons.items()}
            )
    return cells


def collect_remarks(measures: Sequence[TriggeredMeasure]) -> tuple[str, ...]:
    """Return the remarks of measures on a level, each once, with the names of its measures."""
    names: dict[str, list[str]] = {}
    for measure in measures:
        for remark in measure.measure.remarks:
            names.setdefault(remark, []).append(measure.spec.name)
    return tuple(f"{', '.join(measure_names)}: {remark}" for remark, measure_names in names.items())


def row_of(
    level: Level,
    measures: Sequence[TriggeredMeasure],
    status: tuple[str, str | None],
    *,
    expression: Expression,
    simulation: Simulation,
    start_step: int,
    fingerprint: str,
    snapshots: tuple[Snapshot, ...],
) -> LevelRow:
    """Return the row of a level that has ended.

    Args:
        level: the level.
        measures: its measures.
        status: the status, and its reason.
        expression: the score.
        simulation: the simulation at the end of the level.
        start_step: the step at which the level began.
        fingerprint: the fingerprint of the trial so far.
        snapshots: the last images of the cameras.
    """
    cells = cells_of(measures, *status)
    score = expression.score(cells.values)
    total, reason = finite_value(score.value if has_score(measures, status[0]) else None)
    if total is None:
        cells.missing_reasons["total"] = status[1] or score.reason or f"the function: {reason}"
    logged_measures = [measure for measure in measures if measure.spec.log is not None]
    return LevelRow(
        values=level.values,
        measures={name: (value, cells.units[name]) for name, value in cells.values.items()},
        details=cells.details,
        total=total,
        status=status[0],
        missing_reasons=cells.missing_reasons,
        ended_at=simulation.time,
        duration=(simulation.step - start_step) * simulation.timestep,
        logs={measure.spec.name: measure.log for measure in logged_measures},
        log_headers={
            measure.spec.name: log_columns(measure.measure) for measure in logged_measures
        },
        fingerprint=fingerprint,
        remarks=collect_remarks(measures),
        snapshots=snapshots,
    )

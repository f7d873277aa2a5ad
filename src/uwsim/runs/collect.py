"""The collection of the rows on disk into one result and its logs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from ..benchmark.updaters import chain, swept_parameters
from ..results.inputs import Inputs
from ..results.journal import StoredTrial
from ..results.log import TIME, Log
from ..results.result import (
    Cell,
    Column,
    ImageStream,
    MissingValue,
    RefusedMessages,
    Remark,
    Result,
    SavedImage,
    Variation,
)
from ..results.run_info import RunInfo
from ..results.stored.stored_row import StoredEnd, StoredImage, StoredRow, ValueWithUnit
from .planning.plan import Plan, Trial
from .trial.error_floor import largest_error_floors


def collect(
    plan: Plan, inputs: Inputs, info: RunInfo, stored_trials: Sequence[tuple[Trial, StoredTrial]]
) -> tuple[Result, list[Log], float]:
    """Collect the rows on disk, in the order of the plan.

    The facts of the result are values measured for the whole run, such as the contrast of the
    image. They are taken from the first finished trial; error floors are the largest of all trials.

    Args:
        plan: the plan of the run.
        inputs: the names and hashes of the files read.
        info: the description of the run that is known before its execution.
        stored_trials: each trial of the plan, with its rows and end on disk.

    Returns:
        The result, its logs, and the simulation time of all levels together [s].
    """
    rows = [(trial, row) for trial, content in stored_trials for row in content.rows]
    columns = _columns(plan, [row for _, row in rows])
    start_times, simulated_s = _times(rows)
    end_times = [
        row.duration + (0.0 if trial.is_independent else start)
        for (trial, row), start in zip(rows, start_times, strict=True)
    ]
    ends = [(trial, content.end) for trial, content in stored_trials if content.end is not None]
    facts = ends[0][1].facts if ends else {}
    parameters = ends[0][1].parameters if ends else dict(plan.algorithm.parameters)
    result = Result(
        inputs=inputs,
        run=replace(
            info,
            parameters=parameters,
            trial_counts=(len(ends), len(stored_trials)),
            notes=tuple(dict.fromkeys(note for _, end in ends for note in end.notes)),
        ),
        columns=tuple(columns),
        rows=tuple(
            _row(_leading_cells(plan, trial, row), row, end_time, columns)
            for (trial, row), end_time in zip(rows, end_times, strict=True)
        ),
        missing_values=tuple(
            MissingValue(row=index, column=name, reason=reason)
            for index, (_, row) in enumerate(rows)
            for name, reason in row.missing.items()
        ),
        facts={**facts, **largest_error_floors(end.facts for _, end in ends)},
        variations=variations_of(plan),
        image_streams=tuple(stream for trial, end in ends for stream in _streams(trial, end)),
        images=tuple(
            _image(index, stored_image)
            for index, (_, row) in enumerate(rows)
            for stored_image in row.pictures
        ),
        refused_messages=tuple(
            RefusedMessages(row=index, sender=sender, topic_or_service=name, n=n)
            for index, (_, row) in enumerate(rows)
            for sender, name, n in row.refused
        ),
        remarks=tuple(
            Remark(row=index, text=text)
            for index, (_, row) in enumerate(rows)
            for text in row.remarks
        ),
    )
    return result, _logs(plan, columns, rows, start_times), simulated_s


def _times(rows: Sequence[tuple[Trial, StoredRow]]) -> tuple[list[float], float]:
    """Return the start time of each level within its repeat, and the sum of durations [s]."""
    durations: dict[int, float] = {}
    start_times = []
    for trial, row in rows:
        start_times.append(durations.get(trial.repeat, 0.0))
        durations[trial.repeat] = start_times[-1] + row.duration
    return start_times, sum(durations.values())


def _leading_cells(plan: Plan, trial: Trial, row: StoredRow) -> list[float | int]:
    """Return the cells with which a row or a sample of a log begins.

    These are repeat and seed, if there are several repeats, and the values of the level.
    """
    return [*([trial.repeat, trial.seed] if plan.repeats > 1 else []), *row.values]


def _row(
    leading_cells: Sequence[float | int],
    row: StoredRow,
    end_time: float,
    columns: Sequence[Column],
) -> tuple[Cell, ...]:
    cells: dict[str, Cell] = {
        **{name: value for name, (value, _) in row.measures.items()},
        **{name: value for name, (value, _) in row.details.items()},
        "total": row.total,
        "status": row.status,
        "ended_at": end_time,
    }
    last_columns = columns[len(leading_cells) :]
    return (*leading_cells, *(cells.get(column.name) for column in last_columns))


def _logs(
    plan: Plan,
    columns: Sequence[Column],
    rows: Sequence[tuple[Trial, StoredRow]],
    start_times: Sequence[float],
) -> list[Log]:
    if not rows:
        return []
    levels = [column.label for column in columns if column.kind in ("run", "level")]
    headers = rows[0][1].log_headers
    return [
        Log(
            measure=spec.name,
            header=(*levels, TIME, *headers[spec.name]),
            samples=tuple(
                (*_leading_cells(plan, trial, row), start + sample[0], *sample[1:])
                for (trial, row), start in zip(rows, start_times, strict=True)
                for sample in row.logs.get(spec.name, ())
            ),
        )
        for spec in plan.benchmark.measures
        if spec.log is not None
    ]


def _streams(trial: Trial, end: StoredEnd) -> list[ImageStream]:
    level = trial.values[0] if trial.is_independent else None
    return [
        ImageStream(seed=trial.seed, level=level, topic=topic, frames=frames, sha256=sha256)
        for topic, frames, sha256 in end.streams
    ]


def variations_of(plan: Plan) -> tuple[Variation, ...]:
    """Return every random variation of the plan, with its value for each seed."""
    seeds = [plan.seed + repeat for repeat in range(plan.repeats)]
    by_seed = [plan.draws(seed) for seed in seeds]
    return tuple(
        Variation(
            path=draws[0].path,
            unit=draws[0].unit or "1",
            drawn_from=draws[0].drawn_from,
            values=tuple((seed, draw.value) for seed, draw in zip(seeds, draws, strict=True)),
        )
        for draws in zip(*by_seed, strict=True)
    )


def _columns(plan: Plan, rows: Sequence[StoredRow]) -> list[Column]:
    """Return the columns of the result; before the first row, those that the plan determines.

    A measure has a column for each detail in any row. The unit of a column is taken from the first
    row with a value, because the unit of a topic may be unknown before its first message.
    """
    updater = plan.benchmark.scene_updater
    columns = [Column(name=name, kind="run") for name in ("repeat", "seed") if plan.repeats > 1]
    columns += [
        Column(name=name, kind="level", unit=_unit(spec.parameter_unit))
        for name, spec in zip(swept_parameters(updater), chain(updater), strict=True)
    ]
    measures = _units(row.measures for row in rows)
    details = _units(row.details for row in rows)
    for measure, unit in measures.items():
        columns.append(Column(name=measure, kind="measure", unit=_unit(unit)))
        columns += [
            Column(name=name, kind="detail", unit=_unit(detail_unit))
            for name, detail_unit in details.items()
            if name.startswith(f"{measure}.")
        ]
    return [
        *columns,
        Column(name="total", kind="score", expression=plan.benchmark.function.text),
        Column(name="status", kind="status"),
        Column(name="ended_at", kind="time", unit="s"),
    ]


def _units(rows: Iterable[Mapping[str, ValueWithUnit]]) -> dict[str, str]:
    """Return the unit of each name in any row, in the order in which the names first appear."""
    units: dict[str, tuple[bool, str]] = {}
    for row in rows:
        for name, (value, unit) in row.items():
            if name not in units or (value is not None and not units[name][0]):
                units[name] = (value is not None, unit)
    return {name: unit for name, (_, unit) in units.items()}


def _image(row: int, stored_image: StoredImage) -> SavedImage:
    return SavedImage(
        row=row,
        camera=stored_image.camera,
        file=stored_image.file,
        truth=stored_image.truth,
        estimate=stored_image.estimate,
    )


def _unit(unit: str) -> str | None:
    return None if unit == "1" else unit

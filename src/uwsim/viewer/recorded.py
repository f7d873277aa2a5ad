"""A trial of a stored result, for playback: its scene, its motion, its levels and curves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..base.geometry import Array
from ..benchmark.updater_settings import set_number
from ..errors import ResultError, UwsimError
from ..results import journal
from ..results.motion import MotionTrack, TrackLevel, load_track
from ..results.result import Result
from ..results.result_file import load
from ..results.stored.stored_row import StoredRow
from ..runs.planning.make_plan import ALGORITHM_PREFIX
from ..scene.reader import read_scene
from ..scene.settings import apply_setting, xacro_arguments
from ..scene.spec import SceneSpec
from ..verify.recorded_plan import (
    FileOverrides,
    command_words,
    find_input,
    find_level_settings,
    find_scene_name,
    recorded_input,
)
from ..world import TIMESTEP

PHASE_COLUMN = "phase"
"""The heading of the column of a log that contains the numbers of phases."""
TIME_PREFIX = "time."
"""The prefix of the names of details that contain the time in a phase."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Curve:
    """The samples of a measure in one level."""

    measure: str
    """The name of the measure, or ``MEASURE.COLUMN``, such as ``success.height``, for another
    column of the measure's log."""
    unit: str
    """The unit of the values; empty if the log does not state it."""
    times: Array
    """The simulation times of the samples, (n,) [s]."""
    values: Array
    """The values, (n,); NaN: nothing was measured."""
    names: tuple[str, ...] = ()
    """The names of the values 1, 2, ..., if they are numbers of phases; else empty."""

    @property
    def is_share(self) -> bool:
        """True if the unit of the values is 1 and all values are from 0 to 1."""
        values = self.values[np.isfinite(self.values)]
        has_unit = self.unit == "1" and not self.names
        return has_unit and bool(((values >= 0.0) & (values <= 1.0)).all())


@dataclass(frozen=True, kw_only=True, eq=False)
class RecordedLevel:
    """A level of a trial."""

    label: str
    """The swept values, as ``fog 0.5``."""
    status: str
    """The status: ``ok``, or the kind of failure."""
    reason: str
    """The reason of a status other than ok; else empty."""
    start_time: float
    """The simulation time of the beginning [s]."""
    end_time: float
    """The simulation time of the end [s]."""
    values: dict[str, float | None]
    """The final value of each measure."""
    curves: tuple[Curve, ...]
    """The curves of all measures that have a log, in the file's order."""
    swept_values: Mapping[str, float] = field(default_factory=dict)
    """The value of each swept parameter, outermost first."""
    details: tuple[Curve, ...] = ()
    """The curves of the other columns of the measures' logs."""


@dataclass(frozen=True, kw_only=True, eq=False)
class RecordedTrial:
    """A finished trial."""

    directory: Path
    """The result directory."""
    index: int
    """The index of the trial, from 0."""
    title: str
    """The title, as ``currents, pi, seed 7``."""
    seed: int
    """The seed of the trial's random streams."""
    scene: SceneSpec
    """The scene with the settings of ``--set`` and of the level, before the seed varies it."""
    timestep: float
    """The timestep of the run [s]."""
    compatibility: frozenset[str]
    """The active compatibility options."""
    data_path: tuple[Path, ...]
    """The folders in which files are searched."""
    track: MotionTrack
    """The recorded motion."""
    levels: tuple[RecordedLevel, ...]
    """The levels in order."""
    level_settings: tuple[tuple[str, float], ...] = ()
    """The paths and values of the numbers of the scene that its level sets
    (``<u:settingUpdater>``)."""

    @staticmethod
    def open(
        directory: Path, index: int = 0, overrides: FileOverrides | None = None
    ) -> RecordedTrial:
        """Read a trial of a result.

        Args:
            directory: the result directory.
            index: the index of the trial, from 0.
            overrides: the present paths of the files, if they have moved.

        Raises:
            ResultError: there is no such trial, it is not finished, or its motion is missing.
            AssetNotFound: the scene of the trial is not found.
        """
        sources = overrides or FileOverrides()
        result = load(directory)
        head, trial = journal.read_any(_journal_path(directory, index))
        if head is None or trial.end is None:
            raise ResultError(f"{directory}: trial {index} is not finished; --resume runs it.")
        track = load_track(journal.track_path(directory, index))
        run = result.run
        name = Path(recorded_input(result, "benchmark")[0]).stem
        scene, paths = scene_of(result, directory, sources)
        settings = _level_settings(track, paths)
        for path, value in settings:
            scene = set_number(scene, path, value)
        return RecordedTrial(
            directory=directory,
            index=index,
            title=f"{name}, {run.algorithm_label}, seed {head['seed']}",
            seed=int(head["seed"]),
            scene=scene,
            timestep=run.timestep[0] if run.timestep else TIMESTEP,
            compatibility=frozenset(run.compatibility or ()),
            data_path=sources.data_path,
            track=track,
            levels=tuple(
                _level(row, track_level)
                for row, track_level in zip(trial.rows, track.levels, strict=False)
            ),
            level_settings=settings,
        )


def trials_of_first_seed(directory: Path) -> tuple[int, ...]:
    """Return the numbers of the recorded trials that have the seed of the first one.

    If the levels of a benchmark are independent, each level is a trial: these trials are then all
    levels of one seed.

    Raises:
        ResultError: no trial has recorded motion.
    """
    numbers = journal.recorded_trials(directory)
    if not numbers:
        _journal_path(directory, 0)
    seeds = [journal.head_of(journal.path_of(directory, i)).get("seed") for i in numbers]
    return tuple(i for i, seed in zip(numbers, seeds, strict=True) if seed == seeds[0])


def scene_of(
    result: Result, directory: Path, overrides: FileOverrides
) -> tuple[SceneSpec, dict[str, str]]:
    """Find the scene of a result by name and hash, and apply its settings (``--set``).

    Returns:
        The scene, and the paths of its numbers that levels set, by the names of their columns;
        none if the benchmark file is not found.
    """
    words, paths = command_words(directory), dict[str, str]()
    with suppress(UwsimError):  # a missing benchmark names no scene; the record may be enough
        record = recorded_input(result, "benchmark")
        file = find_input("benchmark", record, overrides.benchmark, directory, overrides, words)
        words += [str(file.parent / name) for name in find_scene_name(file)]
        paths = find_level_settings(file)
    record = recorded_input(result, "scene")
    path = find_input("scene", record, overrides.scene, directory, overrides, words)
    arguments = xacro_arguments(result.run.settings or ())
    scene = read_scene(path, data_path=overrides.data_path, arguments=arguments)
    for name, value in result.run.settings or ():
        if not name.startswith(ALGORITHM_PREFIX):
            with suppress(UwsimError):  # it was valid in the run: it belongs to an updater
                scene = apply_setting(scene, name, value)
    return scene, paths


def _level_settings(track: MotionTrack, paths: Mapping[str, str]) -> tuple[tuple[str, float], ...]:
    """Return the paths and values that the level of a trial sets; such a trial has one level."""
    values = track.levels[0].values if track.levels else {}
    return tuple((path, values[column]) for column, path in paths.items() if column in values)


def levels_without_motion(
    directory: Path, index: int, names: Sequence[str]
) -> tuple[RecordedLevel, ...]:
    """Return the levels of a finished trial without recorded motion, from its journal.

    Args:
        directory: the result directory.
        index: the index of the trial.
        names: the swept parameters, outermost first.
    """
    _, trial = journal.read_any(journal.path_of(directory, index))
    return tuple(
        _level(
            row,
            TrackLevel(
                values=dict(zip(names, row.values, strict=False)),
                start_time=(row.ended_at or 0.0) - row.duration,
                duration=row.duration,
                status=row.status,
            ),
        )
        for row in trial.rows
    )


def _journal_path(directory: Path, index: int) -> Path:
    """Return the journal of a trial with recorded motion; raise ResultError."""
    numbers = journal.recorded_trials(directory)
    if not numbers:
        raise ResultError(
            f"{directory} has no motion (units/*{journal.TRACK}): an earlier version wrote it, "
            "or none of its trials is finished. Run it again to record the motion."
        )
    if index not in numbers:
        raise ResultError(
            f"{directory} has no motion of trial {index}; expected one of {_ranges(numbers)}."
        )
    return journal.path_of(directory, index)


def _ranges(numbers: tuple[int, ...]) -> str:
    if len(numbers) > 1 and numbers == tuple(range(numbers[0], numbers[-1] + 1)):
        return f"{numbers[0]} to {numbers[-1]}"
    return ", ".join(map(str, numbers))


def _level(row: StoredRow, track_level: TrackLevel) -> RecordedLevel:
    label = ", ".join(f"{name} {value:g}" for name, value in track_level.values.items())
    return RecordedLevel(
        label=label,
        status=row.status,
        reason=row.missing.get("total", ""),
        start_time=track_level.start_time,
        end_time=track_level.start_time + track_level.duration,
        swept_values=track_level.values,
        values={name: value for name, (value, _) in row.measures.items()},
        curves=tuple(
            _curve(name, row.measures[name][1], samples, track_level.start_time)
            for name, samples in row.logs.items()
            if samples
        ),
        details=tuple(
            _detail(row, name, column, heading, track_level.start_time)
            for name, headings in row.log_headers.items()
            for column, heading in enumerate(headings[1:], start=2)
            if row.logs.get(name)
        ),
    )


def _detail(row: StoredRow, measure: str, column: int, heading: str, start_time: float) -> Curve:
    """Return the curve of a further column of a log; a heading is as ``height [m]``."""
    name, _, unit = heading.partition(" [")
    curve = _curve(f"{measure}.{name}", unit.rstrip("]"), row.logs[measure], start_time, column)
    return replace(curve, names=_phases(row, measure)) if name == PHASE_COLUMN else curve


def _phases(row: StoredRow, measure: str) -> tuple[str, ...]:
    """Return the names of a measure's phases in order: the row has the time in each phase."""
    start = f"{measure}.{TIME_PREFIX}"
    return tuple(name.removeprefix(start) for name in row.details if name.startswith(start))


def _curve(
    name: str, unit: str, samples: Sequence[Sequence[Any]], start_time: float, column: int = 1
) -> Curve:
    """Return the curve of one column of the samples; column 0 is the time in the level [s]."""
    pairs = [(sample[0], sample[column]) for sample in samples]
    values = np.array([[np.nan if v is None else v for v in pair] for pair in pairs])
    return Curve(measure=name, unit=unit, times=start_time + values[:, 0], values=values[:, 1])

"""A trial of a stored result, as it is seen again: its scene, its motion, its levels and curves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..base.geometry import Array
from ..errors import ResultError, UwsimError
from ..results import journal
from ..results.motion import MotionTrack, TrackLevel, load_track
from ..results.result import Result
from ..results.result_file import load
from ..results.stored.stored_row import StoredRow
from ..runs.planning.make_plan import OF_ALGORITHM
from ..scene.reader import read_scene
from ..scene.settings import apply_setting, xacro_arguments
from ..scene.spec import SceneSpec
from ..verify.recorded_plan import (
    FileOverrides,
    find_input,
    named_input,
    scene_named_by,
    typed_words,
)
from ..world import TIMESTEP

PHASE, TIME_IN = "phase", "time."
"""Column of a log with the number of a phase, and how the details with the time in each begin."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Curve:
    """The samples of a measure in one level."""

    measure: str
    """Its name; of a further column of its log also the column's, as ``success.height``."""
    unit: str
    """Of its value; empty where the log says none."""
    times: Array
    """Since the simulation began, (n,) [s]."""
    values: Array
    """(n,); NaN: there was nothing to measure."""
    names: tuple[str, ...] = ()
    """Of the values 1, 2, ..., where they number something, as phases; else empty."""

    @property
    def is_share(self) -> bool:
        """Whether its values have the unit 1 and lie between 0 and 1, as those of a share."""
        seen = self.values[np.isfinite(self.values)]
        has_unit = self.unit == "1" and not self.names
        return has_unit and bool(((seen >= 0.0) & (seen <= 1.0)).all())


@dataclass(frozen=True, kw_only=True, eq=False)
class RecordedLevel:
    """A level of a trial."""

    label: str
    """As ``fog 0.5``."""
    status: str
    """``ok``, or what went wrong."""
    why: str
    """Why it is not ok; empty if it is."""
    began: float
    """Simulation time at which it began [s]."""
    ended: float
    """Simulation time at which it ended [s]."""
    values: dict[str, float | None]
    """Measure -> its value at the end."""
    curves: tuple[Curve, ...]
    """Of all measures that have a log, in the file's order."""
    swept: Mapping[str, float] = field(default_factory=dict)
    """Swept parameter -> value, outermost first."""
    details: tuple[Curve, ...] = ()
    """Of the further columns of their logs."""


@dataclass(frozen=True, kw_only=True, eq=False)
class RecordedTrial:
    """A trial that was run."""

    directory: Path
    """The result."""
    index: int
    """Its number."""
    title: str
    """As ``currents, pi, seed 7``."""
    seed: int
    """Of its random streams."""
    scene: SceneSpec
    """As it was run, with ``--set``; what varies is drawn for the seed when it is opened."""
    timestep: float
    """Of the run [s]."""
    compatibility: frozenset[str]
    """Quirks that were on."""
    data_path: tuple[Path, ...]
    """Folders in which files are looked for."""
    track: MotionTrack
    """Where everything was."""
    levels: tuple[RecordedLevel, ...]
    """In order."""

    @staticmethod
    def open(
        directory: Path, index: int = 0, overrides: FileOverrides | None = None
    ) -> RecordedTrial:
        """Read a trial of a result.

        Args:
            directory: of the result.
            index: number of the trial, from 0.
            overrides: where the files are, if not where they were.

        Raises:
            ResultError: there is no such trial, it was not finished, or its motion was not kept.
            AssetNotFound: its scene is nowhere.
        """
        where = overrides or FileOverrides()
        result = load(directory)
        head, stored = journal.read_any(_finished(directory, index))
        if head is None or stored.end is None:
            raise ResultError(f"{directory}: trial {index} is not finished; --resume runs it.")
        track = load_track(journal.track_path(directory, index))
        run = result.run
        name = Path(named_input(result, "benchmark")[0]).stem
        return RecordedTrial(
            directory=directory,
            index=index,
            title=f"{name}, {run.algorithm}, seed {head['seed']}",
            seed=int(head["seed"]),
            scene=scene_of(result, directory, where),
            timestep=run.timestep[0] if run.timestep else TIMESTEP,
            compatibility=frozenset(run.compatibility or ()),
            data_path=where.data_path,
            track=track,
            levels=tuple(
                _level(row, began) for row, began in zip(stored.rows, track.levels, strict=False)
            ),
        )


def trials_of_first_seed(directory: Path) -> tuple[int, ...]:
    """Return the numbers of the trials whose motion is there and whose seed is that of the first.

    Where a benchmark's levels are independent they are a trial each, and these are all levels.

    Raises:
        ResultError: there is no motion.
    """
    there = journal.recorded_trials(directory)
    if not there:
        _finished(directory, 0)
    seeds = [journal.head_of(journal.path_of(directory, i)).get("seed") for i in there]
    return tuple(i for i, seed in zip(there, seeds, strict=True) if seed == seeds[0])


def scene_of(result: Result, directory: Path, overrides: FileOverrides) -> SceneSpec:
    """Find the scene of a result by name and hash, and change it as it was (``--set``)."""
    typed = typed_words(directory)
    with suppress(UwsimError):  # a benchmark that is gone leads to no scene, and needs not
        named = named_input(result, "benchmark")
        file = find_input("benchmark", named, overrides.benchmark, directory, overrides, typed)
        typed += [str(file.parent / name) for name in scene_named_by(file)]
    named = named_input(result, "scene")
    path = find_input("scene", named, overrides.scene, directory, overrides, typed)
    arguments = xacro_arguments(result.run.settings or ())
    scene = read_scene(path, data_path=overrides.data_path, arguments=arguments)
    for name, value in result.run.settings or ():
        if not name.startswith(OF_ALGORITHM):
            with suppress(UwsimError):  # it was right when it was run: it is of an updater
                scene = apply_setting(scene, name, value)
    return scene


def levels_without_motion(
    directory: Path, index: int, names: Sequence[str]
) -> tuple[RecordedLevel, ...]:
    """Return the levels of a finished trial whose motion is not there, from its journal alone.

    Args:
        directory: of the result.
        index: number of the trial.
        names: of what changes with the levels, outermost first.
    """
    _, stored = journal.read_any(journal.path_of(directory, index))
    return tuple(
        _level(
            row,
            TrackLevel(
                values=dict(zip(names, row.values, strict=False)),
                began=(row.ended_at or 0.0) - row.duration,
                duration=row.duration,
                status=row.status,
            ),
        )
        for row in stored.rows
    )


def _finished(directory: Path, index: int) -> Path:
    """Return the journal of a trial whose motion is there; raises ResultError."""
    there = journal.recorded_trials(directory)
    if not there:
        raise ResultError(
            f"{directory}: holds no motion (units/*{journal.TRACK}): it was made by an earlier "
            "version, or no trial of it is finished. Run it again to see it."
        )
    if index not in there:
        raise ResultError(
            f"{directory}: no motion of trial {index}; expected one of {_ranges(there)}."
        )
    return journal.path_of(directory, index)


def _ranges(numbers: tuple[int, ...]) -> str:
    if len(numbers) > 1 and numbers == tuple(range(numbers[0], numbers[-1] + 1)):
        return f"{numbers[0]} to {numbers[-1]}"
    return ", ".join(map(str, numbers))


def _level(row: StoredRow, began: TrackLevel) -> RecordedLevel:
    label = ", ".join(f"{name} {value:g}" for name, value in began.values.items())
    return RecordedLevel(
        label=label,
        status=row.status,
        why=row.missing.get("total", ""),
        began=began.began,
        ended=began.began + began.duration,
        swept=began.values,
        values={name: value for name, (value, _) in row.measures.items()},
        curves=tuple(
            _curve(name, row.measures[name][1], samples, began.began)
            for name, samples in row.logs.items()
            if samples
        ),
        details=tuple(
            _detail(row, name, (column, place), began.began)
            for name, columns in row.log_headers.items()
            for place, column in enumerate(columns[1:], start=2)
            if row.logs.get(name)
        ),
    )


def _detail(row: StoredRow, measure: str, column: tuple[str, int], began: float) -> Curve:
    """The curve of a further column of a log: its heading, as ``height [m]``, and its place."""
    name, _, unit = column[0].partition(" [")
    curve = _curve(f"{measure}.{name}", unit.rstrip("]"), row.logs[measure], began, column[1])
    return replace(curve, names=_phases(row, measure)) if name == PHASE else curve


def _phases(row: StoredRow, measure: str) -> tuple[str, ...]:
    """Names of the phases of a measure, in order: it has the time in each of them."""
    start = f"{measure}.{TIME_IN}"
    return tuple(name.removeprefix(start) for name in row.details if name.startswith(start))


def _curve(
    name: str, unit: str, samples: Sequence[Sequence[Any]], began: float, place: int = 1
) -> Curve:
    """The curve of one place in the samples; place 0 is the time in the level [s]."""
    chosen = [(sample[0], sample[place]) for sample in samples]
    values = np.array([[np.nan if v is None else v for v in pair] for pair in chosen])
    return Curve(measure=name, unit=unit, times=began + values[:, 0], values=values[:, 1])

"""A whole benchmark: what is to be played, and one result out of what was.

Rows go to disk as levels end (`unit_file`); when the run is over, or breaks, they are put together
in the order of the plan. Whoever executeed them (`executor`), killed and resumed or not: the same
bytes.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

import numpy as np

from .. import __version__
from ..benchmark.updaters import chain, swept_parameters
from ..files.file_names import file_names
from ..files.input_files import InputFile
from ..results import journal
from ..results.log import TIME, Log, save_log
from ..results.result import (
    Cell,
    Column,
    ImageStream,
    Json,
    Missing,
    Result,
    SavedImage,
    Variation,
)
from ..results.result_file import save
from ..results.summary import save_summary
from .plan import Plan, Trial
from .trial.floor import largest
from .trial.status import ended_its_process, was_stopped
from .uwsim_files import save_dat, save_data


@dataclass(kw_only=True)
class Run:
    """A plan and the directory its result goes to."""

    plan: Plan
    """What to play."""
    out: Path
    """The result directory."""
    inputs: Json
    """Names and hashes of the files read (`prepare`)."""
    renderer: str
    """What draws the images (`prepare`)."""
    files: tuple[InputFile, ...] = ()
    """Files that must not change while it is played (`watchable`)."""
    n_resumed: int = 0
    """Levels that were on disk already when the run began."""
    n_lost: int = 0
    """How often a trial lost its worker and was played again."""
    simulated_s: float = 0.0
    """Length of all levels of the result together [s]."""

    def begin(self) -> list[Trial]:
        """Make the directory, and return the units that are not finished."""
        self.out.mkdir(parents=True, exist_ok=True)
        self._forget_what_was_stopped()
        self.n_resumed = self.n_finished()
        return self.unfinished()

    def _forget_what_was_stopped(self) -> None:
        """Have units played again whose algorithm took its process with it.

        The levels before stay, and are held against those that are played again. Where it did not
        come back from a call, that is final; but a trial without an end is played again anyhow, and
        may go better.
        """
        name = self.plan.algorithm_name
        for unit in self.plan.units():
            stored = self.stored(unit)
            is_to_go = ended_its_process if stored.end is not None else was_stopped
            for n, row in enumerate(stored.rows):
                if is_to_go(name, row["missing"].get("total")):
                    journal.cut_back(self.out, unit.index, n)
                    break

    def unfinished(self) -> list[Trial]:
        """Return the units whose end is not on disk."""
        return [unit for unit in self.plan.units() if self.stored(unit).end is None]

    def n_finished(self) -> int:
        """Count the levels that are on disk."""
        return sum(self.n_rows(unit) for unit in self.plan.units())

    def n_rows(self, unit: Trial) -> int:
        """Count the levels of one unit that are on disk."""
        return len(self.stored(unit).rows)

    def head(self, unit: Trial) -> journal.Record:
        """Say what a trial is: equal heads mean that its rows must be equal."""
        return {
            "inputs": _as_stored(self.inputs),
            "run": _as_stored(_run(self.plan, self.renderer)),
            "seed": unit.seed,
            "levels": [[value for _, value in level.values] for level in unit.levels],
        }

    def write(self) -> Result:
        """Put together what is on disk, and write it: result, summary of repeats, logs."""
        result, logs, self.simulated_s = collect(self)
        save(result, self.out)
        save_dat(
            result,
            self.out,
            compatibility=self.plan.compatibility,
            measures=self.plan.benchmark.measures,
        )
        if self.plan.repeats > 1:
            save_summary(result, self.out)
        measures = {spec.name: spec for spec in self.plan.benchmark.measures}
        files = file_names(measures)
        for log in logs:
            save_log(log, self.out, files[log.measure])
            save_data(log, measures[log.measure], self.out, files[log.measure])
        return result

    def stored(self, unit: Trial) -> journal.Stored:
        """Return what is on disk of a trial; raises ResultError if it is another run's."""
        if not journal.path_of(self.out, unit.index).exists():
            return journal.NOTHING
        return journal.read(self.out, unit.index, self.head(unit))


def collect(run: Run) -> tuple[Result, list[Log], float]:
    """Put together the rows on disk, in the order of the plan.

    Returns:
        The result, its logs, and the length of all levels together [s].
    """
    plan = run.plan
    several = plan.repeats > 1
    units = plan.units()
    stored = [(unit, run.stored(unit)) for unit in units]
    records = [(unit, record) for unit, found in stored for record in found.rows]
    columns = _columns(plan, [record for _, record in records])
    rows: list[tuple[Cell, ...]] = []
    missing: list[Missing] = []
    images: list[SavedImage] = []
    samples: dict[str, list[tuple[float | int | None, ...]]] = {
        spec.name: [] for spec in plan.benchmark.measures if spec.log is not None
    }
    elapsed: dict[int, float] = {}
    for unit, record in records:
        values = record["values"]
        led = [unit.repeat, unit.seed] if several else []
        cells: dict[str, Cell] = {
            **{name: value for name, (value, _) in record["measures"].items()},
            **{name: value for name, (value, _) in record["details"].items()},
            "total": record["total"],
            "status": record["status"],
        }
        before = elapsed.get(unit.repeat, 0.0)
        elapsed[unit.repeat] = before + record["duration"]
        cells["ended_at"] = elapsed[unit.repeat]
        n_led = len(led) + len(values)
        rows.append((*led, *values, *(cells.get(column.name) for column in columns[n_led:])))
        index = len(rows) - 1
        missing += [
            Missing(row=index, column=name, why=why) for name, why in record["missing"].items()
        ]
        for name, taken in record["logs"].items():
            samples[name] += [(*led, *values, before + sample[0], *sample[1:]) for sample in taken]
        images += [_image(index, image) for image in record["pictures"]]
    ends = [(unit, found.end) for unit, found in stored if found.end is not None]
    first = ends[0][1] if ends else {"facts": {}, "parameters": dict(plan.parameters)}
    about = {
        **_run(plan, run.renderer),
        "parameters": first["parameters"],
        "units": [len(ends), len(units)],
        "notes": list(dict.fromkeys(note for _, end in ends for note in end["notes"])),
    }
    result = Result(
        inputs=run.inputs,
        run=about,
        columns=tuple(columns),
        rows=tuple(rows),
        missing=tuple(missing),
        facts={**first["facts"], **largest(end["facts"] for _, end in ends)},
        variations=variations_of(plan),
        image_streams=tuple(
            ImageStream(
                seed=unit.seed,
                level=tuple(v for _, v in unit.levels[0].values) if unit.is_alone else None,
                topic=topic,
                frames=frames,
                sha256=sha256,
            )
            for unit, end in ends
            for topic, frames, sha256 in end["streams"]
        ),
        images=tuple(images),
    )
    simulated_s = sum(elapsed.values())
    if not records:
        return result, [], simulated_s
    levels = [column.label for column in columns if column.kind in ("run", "level")]
    logs = [
        Log(
            measure=name,
            header=(*levels, TIME, *records[0][1]["log_headers"][name]),
            samples=tuple(taken),
        )
        for name, taken in samples.items()
    ]
    return result, logs, simulated_s


def variations_of(plan: Plan) -> tuple[Variation, ...]:
    """Gather what varies, over the seeds of the plan."""
    seeds = [plan.seed + repeat for repeat in range(plan.repeats)]
    by_seed = [plan.draws(seed) for seed in seeds]
    return tuple(
        Variation(
            path=same[0].path,
            unit=same[0].unit or "1",
            drawn_from=same[0].drawn_from,
            values=tuple((seed, draw.value) for seed, draw in zip(seeds, same, strict=True)),
        )
        for same in zip(*by_seed, strict=True)
    )


def _columns(plan: Plan, records: list[journal.Record]) -> list[Column]:
    """Name the columns; before the first row only those that are known without playing.

    A measure's details are those of all rows together, and units those of the first row that has a
    value: what a topic carries may not be known before something came.
    """
    updater = plan.benchmark.scene_updater
    columns = [Column(name=name, kind="run") for name in ("repeat", "seed") if plan.repeats > 1]
    columns += [
        Column(name=name, kind="level", unit=_unit(spec.parameter_unit))
        for name, spec in zip(swept_parameters(updater), chain(updater), strict=True)
    ]
    measures = _units(records, "measures")
    details = _units(records, "details")
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


def _units(records: list[journal.Record], kind: str) -> dict[str, str]:
    """Name -> unit of what all rows have of a kind, in the order of its first row."""
    first: dict[str, tuple[bool, str]] = {}
    for record in records:
        for name, (value, unit) in record[kind].items():
            if name not in first or (value is not None and not first[name][0]):
                first[name] = (value is not None, unit)
    return {name: unit for name, (_, unit) in first.items()}


def _image(row: int, stored: journal.Record) -> SavedImage:
    """An image of a row as the result has it."""
    return SavedImage(
        row=row,
        camera=stored["camera"],
        file=stored["file"],
        truth=_corners(stored["truth"]),
        estimate=_corners(stored["estimate"]),
    )


def _corners(stored: Sequence[float] | None) -> tuple[float, ...] | None:
    return None if stored is None else tuple(stored)


def _unit(unit: str) -> str | None:
    return None if unit == "1" else unit


def _run(plan: Plan, renderer: str) -> dict[str, object]:
    """Say what is played, as far as it is known before it is."""
    return {
        "seed": plan.seed,
        "repeats": plan.repeats,
        "mode": plan.mode,
        "algorithm": plan.algorithm_name,
        "parameters": dict(sorted(plan.parameters.items())),
        "settings": [list(setting) for setting in plan.settings],
        "levels": [list(chosen) for chosen in plan.chosen],
        "compatibility": sorted(plan.compatibility),
        "timestep": [plan.timestep, "s"],
        "version": __version__,
        "physics": f"mujoco {version('mujoco')}",
        "renderer": renderer,
        "numpy": np.__version__,
    }


def _as_stored(value: object) -> object:
    """Return a value as it will be read back from JSON."""
    return json.loads(json.dumps(value))

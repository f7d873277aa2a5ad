"""A whole benchmark: its units played, here or on several processes, and one result written.

Rows go to disk as levels end (`unit_file`); when the run is over, or breaks, they are put together
in the order of the plan. One worker or several, killed and resumed or not: the same bytes.
"""

from __future__ import annotations

import hashlib
import json
import multiprocessing
import os
import threading
import time
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import mujoco
import numpy as np

from .. import __version__
from ..errors import RunFailed
from ..simulation import Simulation
from . import unit_file
from .logs import TIME, Log, save_log
from .original_format import save_dat, save_data
from .plan import Plan, Unit
from .play import Row, UnitEnd, bind_all, play
from .plugin import blamed, check_bound, hashes
from .result import Cell, Column, ImageStream, Json, Missing, Result, TakenPicture, save
from .updaters import chain, references

OnLevel = Callable[[], None]
PICTURES = "pictures"


@dataclass(kw_only=True)
class Bench:
    """A plan and the directory its result goes to."""

    plan: Plan
    """What to play."""
    out: Path
    """The result directory."""
    inputs: Json
    """Names and hashes of the files read (`open_once`)."""
    renderer: str
    """What draws the pictures (`open_once`)."""
    n_resumed: int = 0
    """Levels that were on disk already when `run` began."""
    simulated_s: float = 0.0
    """Length of all levels of the result together [s]."""

    def run(self, *, workers: int = 1, on_level: OnLevel = lambda: None) -> Result:
        """Play what is not finished yet, and write the result.

        Args:
            workers: number of processes; 1 plays in this one.
            on_level: called whenever a level has ended.

        Raises:
            NeverStarted: the start trigger never went on; what was finished is kept.
            ResultError: what is stored belongs to another run, or cannot be reproduced.
        """
        self.out.mkdir(parents=True, exist_ok=True)
        self.n_resumed = self.n_finished()
        units = [unit for unit in self.plan.units() if self._stored(unit).end is None]
        try:
            if workers > 1 and len(units) > 1:
                self._run_on_processes(units, min(workers, len(units)), on_level)
            else:
                for unit in units:
                    play_unit(self, unit, on_level)
        finally:
            result = self.write()
        return result

    def n_finished(self) -> int:
        """Count the levels that are on disk."""
        return sum(len(self._stored(unit).rows) for unit in self.plan.units())

    def head(self, unit: Unit) -> unit_file.Record:
        """Say what a unit is: equal heads mean that its rows must be equal."""
        return {
            "inputs": _plain(self.inputs),
            "run": _plain(_run(self.plan, self.renderer)),
            "seed": unit.seed,
            "levels": [[value for _, value in level.values] for level in unit.levels],
        }

    def write(self) -> Result:
        """Put together what is on disk, and write ``result.json``, ``result.dat`` and the logs."""
        result, logs, self.simulated_s = collect(self)
        save(result, self.out)
        save_dat(result, self.out, compatibility=self.plan.compatibility)
        measures = {spec.name: spec for spec in self.plan.benchmark.measures}
        for log in logs:
            save_log(log, self.out)
            save_data(log, measures[log.measure], self.out)
        return result

    def _stored(self, unit: Unit) -> unit_file.Stored:
        return unit_file.read(self.out, unit.index, self.head(unit))

    def _run_on_processes(self, units: list[Unit], workers: int, on_level: OnLevel) -> None:
        os.environ.setdefault("LP_NUM_THREADS", "1")
        seen = self.n_finished()
        context = multiprocessing.get_context("spawn")
        with ProcessPoolExecutor(
            workers, mp_context=context, initializer=_leave_with, initargs=(os.getpid(),)
        ) as pool:
            pending = {pool.submit(play_unit, self, unit) for unit in units}
            try:
                while pending:
                    done, pending = wait(pending, timeout=0.3, return_when=FIRST_COMPLETED)
                    for future in done:
                        future.result()
                    for _ in range(seen, now := self.n_finished()):
                        on_level()
                    seen = now
            except BrokenProcessPool:
                raise RunFailed(
                    "A worker process died. Finished rows are kept; go on with --resume."
                ) from None
            finally:
                for future in pending:
                    future.cancel()


def _leave_with(parent: int) -> None:
    """Have this worker end when its parent is gone, however that came to its end."""

    def watch() -> None:
        while os.getppid() == parent:
            time.sleep(1.0)
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def play_unit(bench: Bench, unit: Unit, on_level: OnLevel = lambda: None) -> None:
    """Play one unit and store its rows as they come."""
    n_levels = len(unit.levels)
    file = unit_file.UnitFile(bench.out, unit.index, bench.head(unit))
    try:
        for n, played in enumerate(play(bench.plan, unit)):
            if isinstance(played, UnitEnd):
                file.finish(
                    {
                        "facts": {k: list(v) for k, v in played.facts.items()},
                        "parameters": played.parameters,
                        "streams": [list(stream) for stream in played.streams],
                        "notes": list(played.notes),
                    }
                )
            else:
                row = unit.index * n_levels + n
                file.add(_record(played, _save_pictures(bench.out, row, played)))
                on_level()
    finally:
        file.close()


def _save_pictures(out: Path, row: int, played: Row) -> list[dict[str, object]]:
    pictures: list[dict[str, object]] = []
    for shot in played.shots:
        name = f"{PICTURES}/{row:05d}-{shot.camera}.png"
        (out / PICTURES).mkdir(exist_ok=True)
        _, png = cv2.imencode(".png", np.ascontiguousarray(shot.pixels[..., ::-1]))
        draft = out / f"{name}.part"
        draft.write_bytes(png.tobytes())
        draft.replace(out / name)
        pictures.append(
            {"camera": shot.camera, "file": name, "truth": shot.truth, "estimate": shot.estimate}
        )
    return pictures


def _record(played: Row, pictures: list[dict[str, object]]) -> unit_file.Record:
    return {
        "values": [value for _, value in played.values],
        "measures": played.measures,
        "details": played.details,
        "total": played.total,
        "status": played.status,
        "missing": played.missing,
        "ended_at": played.ended_at,
        "duration": played.duration,
        "logs": played.logs,
        "log_headers": played.log_headers,
        "pictures": pictures,
    }


def collect(bench: Bench) -> tuple[Result, list[Log], float]:
    """Put together the rows on disk, in the order of the plan.

    Returns:
        The result, its logs, and the length of all levels together [s].
    """
    plan = bench.plan
    several = plan.repeats > 1
    units = plan.units()
    stored = [(unit, unit_file.read(bench.out, unit.index, bench.head(unit))) for unit in units]
    records = [(unit, record) for unit, found in stored for record in found.rows]
    columns = _columns(plan, records[0][1] if records else None)
    rows: list[tuple[Cell, ...]] = []
    missing: list[Missing] = []
    pictures: list[TakenPicture] = []
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
        pictures += [
            TakenPicture(row=index, **{k: _tuple(v) for k, v in picture.items()})
            for picture in record["pictures"]
        ]
    ends = [(unit, found.end) for unit, found in stored if found.end is not None]
    first = ends[0][1] if ends else {"facts": {}, "parameters": dict(plan.parameters)}
    run = {
        **_run(plan, bench.renderer),
        "parameters": first["parameters"],
        "units": [len(ends), len(units)],
        "notes": list(dict.fromkeys(note for _, end in ends for note in end["notes"])),
    }
    result = Result(
        inputs=bench.inputs,
        run=run,
        columns=tuple(columns),
        rows=tuple(rows),
        missing=tuple(missing),
        facts=first["facts"],
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
        pictures=tuple(pictures),
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


def _columns(plan: Plan, record: unit_file.Record | None) -> list[Column]:
    """Name the columns; before the first row only those that are known without playing."""
    updater = plan.benchmark.scene_updater
    columns = [Column(name=name, kind="run") for name in ("repeat", "seed") if plan.repeats > 1]
    columns += [
        Column(name=name, kind="level", unit=_unit(spec.unit))
        for name, spec in zip(references(updater), chain(updater), strict=True)
    ]
    if record is not None:
        for measure, (_, unit) in record["measures"].items():
            columns.append(Column(name=measure, kind="measure", unit=_unit(unit)))
            columns += [
                Column(name=name, kind="detail", unit=_unit(detail_unit))
                for name, (_, detail_unit) in record["details"].items()
                if name.startswith(f"{measure}.")
            ]
    return [
        *columns,
        Column(name="total", kind="score", expression=plan.benchmark.function.text),
        Column(name="status", kind="status"),
        Column(name="ended_at", kind="time", unit="s"),
    ]


def _tuple(value: Any) -> Any:
    return tuple(value) if isinstance(value, list) else value


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
        "physics": f"mujoco {mujoco.__version__}",
        "renderer": renderer,
        "numpy": np.__version__,
    }


def open_once(plan: Plan) -> tuple[dict[str, object], str]:
    """Open the scene once: hash every file and model it needs, and name the renderer.

    Every name of the benchmark is looked up on the way, so that no name can fail later.

    Returns:
        The ``inputs`` of the result, and what draws the pictures.

    Raises:
        UwsimError: a file, a body, a camera or a service that is not there.
    """
    simulation = Simulation(
        plan.scene,
        timestep=plan.timestep,
        data_path=plan.data_path,
        compatibility=plan.compatibility,
    )
    try:
        with blamed(plan.plugins):
            check_bound(plan.plugins, plan.benchmark.parts, simulation)
            bind_all(plan, simulation)
        robots = {
            vehicle.file: _file_hash(Path(simulation.robots[i].path))
            for i, vehicle in enumerate(plan.scene.vehicles)
        }
        assets = {name: f"sha256:{digest}" for name, digest in simulation.asset_hashes.items()}
        renderer = simulation.renderer_name
    finally:
        simulation.close()
    benchmark, scene = Path(plan.benchmark.path), Path(plan.scene.path)
    plugins = {"plugins": hashes(plan.plugins)} if plan.plugins else {}
    return {
        "benchmark": [benchmark.name, _file_hash(benchmark)],
        "scene": [scene.name, _file_hash(scene)],
        "assets": {**robots, **assets},
        **plugins,
    }, renderer


def _file_hash(path: Path) -> str:
    return "sha256:" + hashlib.sha256(path.read_bytes()).hexdigest()


def _plain(value: object) -> object:
    """Return a value as it will be read back from JSON."""
    return json.loads(json.dumps(value))

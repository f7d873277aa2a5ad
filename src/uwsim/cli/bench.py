"""``uwsim bench``: play a benchmark and write its result."""

from __future__ import annotations

import shutil
import signal
import sys
import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console

from ..errors import AllErrors, BadSetting, RunFailed
from .crew import WorkersOption, crew_of
from .options import CompatOption, DataPathOption
from .plan import make_plan
from .plugins import PluginOption
from .progress import progress
from .took import Took

if TYPE_CHECKING:
    from ..benchmark.bench import Bench
    from ..benchmark.beside import Beside
    from ..benchmark.crew import Crew, Outcome
    from ..benchmark.plan import Plan
    from ..benchmark.result import Result

CONTROL = "frozen"
ALGORITHM_ERROR = "algorithm error"
UNWRAPPED = 1000
"""Columns for a reader that is a program: wide enough to leave every line whole."""


def bench(
    context: typer.Context,
    benchmark: Annotated[
        str, typer.Argument(metavar="BENCHMARK", help="A benchmark file, or a bundled name.")
    ],
    scene: Annotated[
        str | None,
        typer.Option(help="The scene; without it the one that the benchmark names (u:scene)."),
    ] = None,
    algorithm: Annotated[
        list[str] | None,
        typer.Option(
            help="What is tested: a name of `uwsim list algorithms`, or module:Class of your own; "
            "without it the one that the benchmark names (u:algorithm). May be repeated: each has "
            "its result in a folder of --out."
        ),
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Seed of every random stream.")] = 0,
    repeat: Annotated[
        int, typer.Option(min=1, help="Play K times, with seeds SEED ... SEED+K-1.")
    ] = 1,
    mode: Annotated[
        str | None,
        typer.Option(
            help="sequential or independent; without it what the benchmark says (u:mode)."
        ),
    ] = None,
    level: Annotated[
        list[str] | None,
        typer.Option(help="Only this level of the sweep, as fog=0.5; may be repeated."),
    ] = None,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="PATH=VALUE",
            help="Change the scene or the algorithm, as oceanState.fog.density=0.4, "
            "vehicle[girona500].virtualCamera[bowtech1].std=0.016 or algorithm.kp=0.4; "
            "may be repeated.",
        ),
    ] = None,
    compat: CompatOption = None,
    workers: WorkersOption = "1",
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Result directory [./NAME.result].")
    ] = None,
    resume: Annotated[
        bool, typer.Option("--resume", help="Go on with an interrupted run in --out.")
    ] = False,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace an earlier result in --out.")
    ] = False,
    plugin: PluginOption = None,
    data_path: DataPathOption = None,
) -> None:
    """Play a benchmark: every level, scored; a table, logs, plots and a report come out."""
    from ..benchmark.directory import check, prepared

    wrong, crew, folders = AllErrors(), None, []
    with wrong.kept():
        crew = crew_of(workers)
    plans: list[Plan] = []
    for name in algorithm or (None,):
        with wrong.kept():
            plans.append(
                make_plan(
                    benchmark,
                    scene=scene,
                    algorithm=name,
                    seed=seed,
                    repeat=repeat,
                    mode=mode,
                    levels=level or [],
                    settings=settings or [],
                    compat=compat or [],
                    data_path=tuple(data_path or ()),
                    plugins=plugin or [],
                )
            )
    with wrong.kept():
        folders = folders_of(algorithm or ())
    directory = out or Path(f"{Path(benchmark).stem}.result")
    with wrong.kept():
        check(directory, resume=resume, overwrite=overwrite, results=folders)
    wrong.check()
    assert crew is not None

    from ..benchmark.bench import Bench, open_once

    began = time.time()
    inputs, renderer = open_once(plans[0])
    signal.signal(signal.SIGTERM, interrupt)
    runs = [
        Bench(plan=plan, out=directory / folder, inputs=inputs, renderer=renderer)
        for plan, folder in zip(plans, folders or [""], strict=True)
    ]
    with prepared(directory, resume=resume, overwrite=overwrite, results=folders):
        play_and_finish(runs, crew, workers, began, context.obj)


def play_and_finish(
    runs: Sequence[Bench],
    crew: Crew,
    workers: str,
    began: float,
    command: Sequence[str],
) -> None:
    """Play one benchmark with an algorithm each, and write and show all there is to it.

    Args:
        runs: an algorithm each.
        crew: who plays.
        workers: the same, as it was said.
        began: when the command did [s since 1970].
        command: what was typed behind ``uwsim``.

    Raises:
        UwsimError: what was the first to go wrong; the other algorithms are played and written.
        RunFailed: an algorithm broke in every row.
    """
    from ..benchmark.beside import Beside
    from ..benchmark.provenance import save_beginning

    for run in runs:
        save_beginning(command, run.out)
    with Beside() as beside:
        controls = [control_of(run) for run in runs if wants_control(run)]
        if controls:
            beside.ask(controls[0])
        outcome = play_with_progress(runs, crew)
        failed = {id(run) for run, _ in outcome.failures}
        if controls and len(failed) < len(runs):
            beside.wait()
            for other in controls[1:]:  # the control looks at nothing: it is the same for all
                shutil.copytree(controls[0].out, other.out, dirs_exist_ok=True)
        wall = time.time() - began
        took = Took(began=began, wall=wall, workers=workers, command=command, runs=runs)
        for run, result in zip(runs, outcome.results, strict=True):
            if id(run) not in failed:
                if len(runs) > 1:
                    print(f"{run.plan.algorithm_name}:")
                finish(run, result, beside, took)
    if len(runs) > 1 and not failed:
        print("compare: uwsim compare " + " ".join(str(run.out) for run in runs))
    for _, error in outcome.failures:
        raise error
    refuse_if_all_broke(runs, outcome.results)


def folders_of(algorithms: Sequence[str]) -> list[str]:
    """Name the folder of each algorithm's result; none where there is one algorithm.

    Raises:
        BadSetting: an algorithm is given twice.
    """
    if len(algorithms) < 2:
        return []
    names = [name.replace(":", ".") for name in algorithms]
    for i, name in enumerate(names):
        if name in names[:i]:
            raise BadSetting(f"--algorithm {algorithms[i]}: is given twice.")
    return names


def wants_control(run: Bench) -> bool:
    """Whether `frozen` is played beside it."""
    return run.plan.wants_control and run.plan.algorithm_name != CONTROL


def refuse_if_all_broke(runs: Sequence[Bench], results: Sequence[Result]) -> None:
    """Fail if an algorithm broke in every row; all is written by then.

    Raises:
        RunFailed: names the algorithms, and why the first row of each is as it is.
    """
    broke = [
        f"{run.plan.algorithm_name} ({result.why(0, 'total')})"
        for run, result in zip(runs, results, strict=True)
        if result.rows and set(result.values("status")) == {ALGORITHM_ERROR}
    ]
    if broke:
        raise RunFailed(f"Every row ended in {ALGORITHM_ERROR!r}: {'; '.join(broke)}.")


def interrupt(number: int, frame: object) -> None:
    """Stop as for Ctrl-C: what is finished is kept, and workers are told."""
    raise KeyboardInterrupt


def play_with_progress(runs: Sequence[Bench], crew: Crew) -> Outcome:
    """Play one benchmark, with an algorithm each, and show how far it is."""
    from ..benchmark.crew import play_each

    names = ", ".join(run.plan.algorithm_name for run in runs)
    title = f"{Path(runs[0].plan.benchmark.path).stem} ({names})"
    total = sum(len(unit.levels) for run in runs for unit in run.plan.units())
    done = sum(run.n_finished() for run in runs)
    with progress(title, total, done=done, of="levels") as on_level:
        return play_each(runs, crew, on_level=on_level)


def control_of(run: Bench) -> Bench:
    """Return the same with `frozen`, which looks at no image, into ``control/``."""
    from ..algorithms import load_algorithm
    from ..benchmark.bench import Bench
    from ..benchmark.directory import CONTROL as FOLDER_OF_CONTROL

    plan = replace(
        run.plan,
        algorithm=load_algorithm(CONTROL),
        algorithm_name=CONTROL,
        parameters={},
        is_blind=True,
    )
    out = run.out / FOLDER_OF_CONTROL
    return Bench(plan=plan, out=out, inputs=run.inputs, renderer="none")


def finish(run: Bench, result: Result, beside: Beside, took: Took) -> None:
    """Write provenance, plots and report, and print the table."""
    from ..benchmark.directory import REPORT
    from ..benchmark.provenance import save_provenance
    from ..benchmark.table import table

    save_provenance(took.provenance(run), run.out)
    beside.ask(run.out)
    console = Console(width=None if sys.stdout.isatty() else UNWRAPPED)
    console.print(table(result, width=console.width))
    beside.wait()
    report = run.out / REPORT
    print(f"written: {run.out}/result.json, result.dat, logs, plots; report: {report}")

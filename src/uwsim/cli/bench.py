"""``uwsim bench``: play a benchmark and write its result."""

from __future__ import annotations

import shutil
import signal
import sys
import time
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console

from ..errors import BadSetting, BenchmarkError, Fault, FileError, RunFailed, UwsimError
from .crew import WorkersOption, crew_of
from .files import benchmark_file, scene_file
from .options import CompatOption, DataPathOption
from .plugins import PluginOption, read_plugins
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
MAX_REPEATS = 10_000
LONGEST = 1e8
"""A benchmark that would simulate longer than this is a slip of the pen [s]."""


def bench(
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
    crew = crew_of(workers)
    algorithms: Sequence[str | None] = algorithm or (None,)
    plans = [
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
        for name in algorithms
    ]
    directory = out or Path(f"{Path(plans[0].benchmark.path).stem}.result")
    folders = folders_of(plans)

    from ..benchmark.bench import Bench, open_once
    from ..benchmark.directory import prepare

    began = time.time()
    inputs, renderer = open_once(plans[0])
    signal.signal(signal.SIGTERM, interrupt)
    prepare(directory, resume=resume, overwrite=overwrite, results=folders)
    runs = [
        Bench(plan=plan, out=directory / folder, inputs=inputs, renderer=renderer)
        for plan, folder in zip(plans, folders or [""], strict=True)
    ]
    play_and_finish(runs, directory, crew, workers, began)


def play_and_finish(
    runs: Sequence[Bench], directory: Path, crew: Crew, workers: str, began: float
) -> None:
    """Play one benchmark with an algorithm each, and write and show all there is to it.

    Raises:
        UwsimError: what was the first to go wrong; the other algorithms are played and written.
        RunFailed: an algorithm broke in every row.
    """
    from ..benchmark.beside import Beside
    from ..benchmark.directory import alone_in

    with ExitStack() as stack:
        for place in dict.fromkeys([directory, *(run.out for run in runs)]):
            stack.enter_context(alone_in(place))
        beside = stack.enter_context(Beside())
        controls = [control_of(run) for run in runs if wants_control(run)]
        if controls:
            beside.ask(controls[0])
        outcome = play_with_progress(runs, crew)
        failed = {id(run) for run, _ in outcome.failures}
        if controls and len(failed) < len(runs):
            beside.wait()
            for other in controls[1:]:  # the control looks at nothing: it is the same for all
                shutil.copytree(controls[0].out, other.out, dirs_exist_ok=True)
        took = Took(began=began, wall=time.time() - began, workers=workers, runs=runs)
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


def folders_of(plans: Sequence[Plan]) -> list[str]:
    """Name the folder of each algorithm's result; none where there is one algorithm.

    Raises:
        BadSetting: an algorithm is given twice.
    """
    if len(plans) == 1:
        return []
    names = [plan.algorithm_name.replace(":", ".") for plan in plans]
    for i, name in enumerate(names):
        if name in names[:i]:
            raise BadSetting(f"--algorithm {plans[i].algorithm_name}: is given twice.")
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


def make_plan(
    benchmark: str,
    *,
    scene: str | None,
    algorithm: str | None,
    seed: int,
    repeat: int,
    mode: str | None,
    levels: list[str],
    settings: list[str],
    compat: list[str],
    data_path: tuple[Path, ...],
    plugins: Sequence[Path] = (),
) -> Plan:
    """Read the files and put together what is to be played.

    Raises:
        UwsimError: a file, a name or a setting that is wrong.
    """
    from ..algorithms import check_parameters, load_algorithm
    from ..benchmark.plan import Plan
    from ..benchmark.plugin import blamed
    from ..benchmark.reader import read_benchmark
    from ..compatibility import compatibility
    from ..scene.reader import read_scene
    from ..scene.settings import apply_setting
    from ..simulation import latency_of

    own, tables = read_plugins(plugins)
    path = benchmark_file(benchmark, data_path)
    try:
        with blamed(own):
            spec = read_benchmark(
                path, measures=tables.measures, triggers=tables.triggers, updaters=tables.updaters
            )
    except BenchmarkError as error:
        raise BenchmarkError([*error.faults, *faults_of_scene(scene, path, data_path)]) from None
    if scene is None and spec.scene is None:
        raise BadSetting(
            f"{path}: the benchmark does not name its scene (u:scene); give it with --scene."
        )
    beside = (path.parent, *data_path)
    scene_spec = read_scene(scene_file(scene or str(spec.scene), beside))
    parameters: dict[str, float | str] = {}
    pairs = [split(setting, "--set") for setting in settings]
    for name, value in pairs:
        if name.startswith("algorithm."):
            parameters[name.removeprefix("algorithm.")] = number_or_text(value)
        else:
            scene_spec = apply_setting(scene_spec, name, value)
    wanted = algorithm or spec.algorithm
    if wanted is None:
        raise BadSetting(
            f"{path}: the benchmark does not name an algorithm (u:algorithm); "
            "give one with --algorithm."
        )
    if ":" in wanted and "" not in sys.path and str(Path.cwd()) not in sys.path:
        sys.path.insert(0, str(Path.cwd()))  # module:Class may lie where the user stands
    chosen_mode = mode or spec.mode or "sequential"
    if chosen_mode not in ("sequential", "independent"):
        raise BadSetting(f"--mode is {chosen_mode!r}; expected sequential or independent.")
    asked = [word for words in compat for word in words.replace(",", " ").split()]
    plan = Plan(
        benchmark=spec,
        scene=scene_spec,
        algorithm=load_algorithm(wanted, tables.algorithms),
        algorithm_name=wanted,
        parameters=parameters,
        settings=tuple(pairs),
        mode="independent" if chosen_mode == "independent" else "sequential",
        seed=seed,
        repeats=repeat,
        chosen=tuple(chosen_level(text) for text in levels),
        compatibility=compatibility([*spec.compatibility, *asked]),
        data_path=data_path,
        plugins=own,
    )
    check_length(plan)
    check_parameters(plan.algorithm, plan.parameters)
    latency_of(parameters)
    return plan


def faults_of_scene(
    scene: str | None, benchmark: Path, data_path: tuple[Path, ...]
) -> Sequence[Fault]:
    """Return what is wrong with a scene that was given, to be said with the benchmark's faults."""
    from ..scene.reader import read_scene

    try:
        if scene is not None:
            read_scene(scene_file(scene, (benchmark.parent, *data_path)))
    except FileError as error:
        return error.faults
    except UwsimError:
        pass  # not found: it is said when the benchmark is right
    return ()


def check_length(plan: Plan) -> None:
    """Refuse what nobody can mean to wait for; raises BadSetting."""
    from ..benchmark.updaters import interval

    if plan.repeats > MAX_REPEATS:
        raise BadSetting(f"--repeat {plan.repeats}: at most {MAX_REPEATS}.")
    length = interval(plan.benchmark.scene_updater) or 0.0
    total = length * len(plan.levels()) * plan.repeats
    if total > LONGEST:
        raise BadSetting(
            f"The benchmark would simulate {total:.3g} s; at most {LONGEST:g} s can be asked for."
        )


def split(setting: str, option: str) -> tuple[str, str]:
    """Cut ``NAME=VALUE``; raises BadSetting."""
    name, equals, value = setting.partition("=")
    if not equals or not name.strip():
        raise BadSetting(f"{option} {setting!r}: expected NAME=VALUE.")
    return name.strip(), value.strip()


def chosen_level(text: str) -> tuple[str, float]:
    """Read ``fog=0.5``; raises BadSetting."""
    name, value = split(text, "--level")
    number = number_or_text(value)
    if isinstance(number, str):
        raise BadSetting(f"--level {text!r}: expected a number behind {name!r}.")
    return name, number


def number_or_text(text: str) -> float | str:
    """Return a finite number where the text is one, else the text."""
    try:
        number = float(text)
    except ValueError:
        return text
    return number if abs(number) < float("inf") else text


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

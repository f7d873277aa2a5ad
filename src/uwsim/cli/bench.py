"""``uwsim bench``: run a benchmark and write its result."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..analysis.repeats_note import repeats_note
from ..base.files.file_names import file_names
from ..base.interrupts import raise_from_now_on
from ..base.system_errors import as_run_failed
from ..base.terminal import warn
from ..errors import AllErrors, BadSetting, RunFailed
from ..runs.executors.choose import n_at_once
from ..runs.foreign_code import announce_code
from ..runs.planning.make_plan import make_plan, say_warnings
from ..runs.planning.plan_request import PlanRequest
from ..runs.timing import Stopwatch, Timing
from .options.client_options import ClientOptions
from .options.completion import algorithm_names
from .options.help_texts import INPUT, OUTPUT, RUN, in_group
from .options.live import LiveOptions
from .options.options import (
    CodeOptions,
    ModeOption,
    SettingOptions,
    TaskOptions,
    WorkerOptions,
    request_of,
)
from .options.run_options import TrialRecordOptions
from .output.console import standard_output
from .output.progress import progress

if TYPE_CHECKING:
    from ..results.result import Result
    from ..runs.executors.background import BackgroundProcess
    from ..runs.executors.executor import Executor, Outcome
    from ..runs.planning.plan import Plan
    from ..runs.run import Run
    from ..runs.trial.onlooker import Onlooker
    from ..viewer.trial_recording import TrialRecording


@dataclass(frozen=True, kw_only=True)
class BenchOptions:
    """What ``uwsim bench`` takes."""

    task: TaskOptions
    algorithm: Annotated[
        list[str] | None,
        in_group(
            INPUT,
            "--algorithm",
            metavar="NAME|module:Class",
            help="Algorithm under test: a name of `uwsim list algorithms`, or your own "
            "module:Class; "
            "without it the one that the benchmark names (u:algorithm). May be repeated: each has "
            "its result in a folder of --out.",
            autocompletion=algorithm_names,
        ),
    ] = None
    mode: ModeOption = None
    level: Annotated[
        list[str] | None,
        in_group(
            INPUT,
            "--level",
            metavar="NAME=VALUE",
            help="Only this level of the sweep, as fog=0.5; may be repeated.",
        ),
    ] = None
    changes: SettingOptions
    seed: Annotated[
        int, in_group(RUN, "--seed", metavar="N", min=0, help="Seed of every random stream.")
    ] = 0
    repeat: Annotated[
        int,
        in_group(
            RUN,
            "--repeat",
            metavar="K",
            min=1,
            help="Run K times, with seeds SEED ... SEED+K-1; a comparison of two results needs "
            "six at least.",
        ),
    ] = 1
    by: WorkerOptions
    outside: ClientOptions
    out: Annotated[
        Path | None,
        in_group(OUTPUT, "--out", metavar="DIR", help="Result directory [./NAME.result]."),
    ] = None
    resume: Annotated[
        bool, in_group(OUTPUT, "--resume", help="Resume an interrupted run in --out.")
    ] = False
    overwrite: Annotated[
        bool,
        in_group(
            OUTPUT, "--overwrite", help="Replace an earlier result in --out, and its recordings."
        ),
    ] = False
    recorded: TrialRecordOptions
    live: LiveOptions
    files: CodeOptions

    @property
    def directory(self) -> Path:
        """Where the result goes."""
        return self.out or Path(f"{Path(self.task.benchmark).stem}.result")

    def request(self, algorithm: str | None) -> PlanRequest:
        """Return what is asked for of one algorithm."""
        return replace(
            request_of(self.task, self.changes, self.files),
            algorithm=algorithm,
            seed=self.seed,
            repeat=self.repeat,
            mode=self.mode,
            levels=self.level or (),
            client=self.outside.client_spec(),
        )


def bench(context: typer.Context, options: BenchOptions) -> None:
    """Run a benchmark: score every level and write a table, logs, plots and a report.

    Written into --out: result.json (all numbers, with units, seeds and hashes), result.dat (the
    original's table), logs as CSV, plots, report.html. Same files and same seed: the same bytes.
    --resume continues an interrupted run; trials that are run again are recorded anew.
    """
    from ..results.directory import check, prepared
    from ..runs.prepare import prepare_runs

    wrong, executor, folders = AllErrors(), None, []
    options.outside.check(wrong, options.by.workers)
    how = {"resume": options.resume, "overwrite": options.overwrite}
    with wrong.kept():
        executor = options.by.executor()
    plans: list[Plan] = []
    for name in options.algorithm or (None,):
        with wrong.kept():
            plans.append(make_plan(options.request(name)))
    with wrong.kept():
        check_live(options, plans)
    with wrong.kept():
        folders = folders_of(options.algorithm or ())
    with wrong.kept():
        check(options.directory, **how, results=folders)
    recordings: list[TrialRecording] = []
    with wrong.kept():
        if len(plans) == len(options.algorithm or (None,)):
            recordings = recordings_of(options, plans, folders)
    wrong.check()
    assert executor is not None

    watch = Stopwatch()
    announce_code(plans[0].scene)
    runs = prepare_runs(plans, options.directory, folders)
    record(runs, recordings, is_resumed=options.resume)
    say_warnings(plans[0])
    raise_from_now_on()
    if note := repeats_note(len(plans), len(plans[0].levels()), options.repeat):
        print(note, file=sys.stderr)
    with (
        as_run_failed(),
        looked_at(options.live, plans) as onlooker,  # first: a port that is taken changes nothing
        prepared(options.directory, **how, results=folders),
    ):
        if onlooker is not None:
            from ..runs.executors.executor import SerialExecutor

            limit = options.by.callback_limit or None
            executor = SerialExecutor(onlooker, callback_limit=limit)
        run_and_finish(runs, executor, options.by.workers, watch, context.obj)


def recordings_of(
    options: BenchOptions, plans: Sequence[Plan], folders: Sequence[str]
) -> list[TrialRecording]:
    """Return what records each plan; none without ``--record``.

    Raises:
        BadSetting: nothing can be recorded there.
    """
    from ..middleware.recording import image_storage
    from ..runs.executors.choose import RAY

    images, file = image_storage(options.recorded.images), options.recorded.record
    if file is None:
        return []
    from ..viewer.trial_recording import check_recordings, trial_recordings

    if options.by.workers == RAY:
        raise BadSetting("--record: a worker of a Ray cluster may be on another machine.")
    recordings = trial_recordings(plans, file, images, folders)
    how = {"resume": options.resume, "overwrite": options.overwrite}
    check_recordings(plans, recordings, options.directory, **how)
    return recordings


def record(runs: Sequence[Run], recordings: Sequence[TrialRecording], *, is_resumed: bool) -> None:
    """Have the trials to come recorded; of a resumed run, names those that are over and are not."""
    if not recordings:
        return
    for run, recording in zip(runs, recordings, strict=True):
        run.recorder = recording
        for path in recording.missing(run) if is_resumed else ():
            warn(f"{path} is not written: its trial is finished, and is not run again")


def check_live(options: BenchOptions, plans: Sequence[Plan]) -> None:
    """Refuse a live view of several processes, and a pilot without one; raises BadSetting."""
    options.live.check()
    if options.live.view and options.by.workers not in ("0", "1"):
        raise BadSetting("--view looks on at one process: leave out --workers.")
    if any(map(is_piloted, plans)) and not options.live.view:
        raise BadSetting("--algorithm pilot: add --view, the page in which the pilot acts.")


def is_piloted(plan: Plan) -> bool:
    """Whether somebody is to pilot now: not where inputs of an earlier run are sent again."""
    return bool(getattr(plan.algorithm.cls, "IS_PILOTED", False)) and not plan.inputs


@contextmanager
def looked_at(live: LiveOptions, plans: Sequence[Plan]) -> Iterator[Onlooker | None]:
    """Open the live view that the options ask for; a pilot's run is in real time, and waits."""
    pilots = any(map(is_piloted, plans))
    title = Path(plans[0].benchmark.path).stem
    with live.opened(title, speed=float(pilots), is_piloted=pilots, waits=pilots) as view:
        yield view


def run_and_finish(
    runs: Sequence[Run],
    executor: Executor,
    workers: str,
    watch: Stopwatch,
    command: Sequence[str],
) -> None:
    """Run one benchmark with each algorithm, and write and print all results.

    Args:
        runs: an algorithm each.
        executor: who executes the trials.
        workers: the same, as it was said.
        watch: started with the command.
        command: what was typed behind ``uwsim``.

    Raises:
        UwsimError: the first failure; the other algorithms are run and written.
        RunFailed: a simulation failed, or an algorithm broke in every row.
    """
    from ..results.provenance import save_beginning
    from ..runs.control import control_of, wants_control
    from ..runs.executors.background import BackgroundProcess
    from ..runs.failed_algorithms import (
        refuse_if_a_process_ended,
        refuse_if_a_simulation_failed,
        refuse_if_all_broke,
    )
    from ..runs.sealed import is_foreign

    for run in runs:
        if message := save_beginning(command, run.out):
            warn(message)
    with BackgroundProcess(load_reporter) as background:
        controls = [control_of(run) for run in runs if wants_control(run.plan)]
        waits = any(is_foreign(run.plan) for run in runs)  # it could read the control's rows
        if controls and not waits:
            background.ask(controls[0])
        outcome = run_with_progress(runs, executor, n_at_once(workers))
        failed = {id(run) for run, _ in outcome.failures}
        if controls and len(failed) < len(runs):
            if waits:
                background.ask(controls[0])
            wait_for_controls(background, controls)
        timing = Timing(
            began=watch.began, wall=watch.passed(), workers=workers, command=command, runs=runs
        )
        for run, result in zip(runs, outcome.results, strict=True):
            if id(run) not in failed:
                if len(runs) > 1:
                    print(f"{run.plan.algorithm.name}:")
                finish(run, result, background, timing)
    if len(runs) > 1 and not failed:
        print("compare: uwsim compare " + " ".join(str(run.out) for run in runs))
    for _, error in outcome.failures:
        raise error
    refuse_if_a_simulation_failed(runs, outcome.results)
    refuse_if_a_process_ended(runs, outcome.results)
    refuse_if_all_broke(runs, outcome.results)


def folders_of(algorithms: Sequence[str]) -> list[str]:
    """Name the folder of each algorithm's result; none where there is one algorithm.

    Raises:
        BadSetting: an algorithm is given twice.
    """
    if len(algorithms) < 2:
        return []
    for i, name in enumerate(algorithms):
        if name in algorithms[:i]:
            raise BadSetting(f"--algorithm {name}: is given twice.")
    from ..results.directory import FOLDERS

    return list(file_names(algorithms, taken=FOLDERS).values())


def run_with_progress(runs: Sequence[Run], executor: Executor, at_once: int) -> Outcome:
    """Run one benchmark with each algorithm, showing progress."""
    from ..runs.executors.executor import run_each

    names = ", ".join(run.plan.algorithm.name for run in runs)
    title = f"{Path(runs[0].plan.benchmark.path).stem} ({names})"
    total = sum(len(trial.levels) for run in runs for trial in run.plan.trials())
    done = sum(run.n_finished() for run in runs)
    with progress(title, total, done=done, of="levels", at_once=at_once) as on_level:
        return run_each(runs, executor, on_level=on_level)


def wait_for_controls(background: BackgroundProcess, controls: Sequence[Run]) -> None:
    """Wait for the control of a run; the results are complete without it."""
    from ..runs.control import CONTROL

    try:
        background.wait()
        for other in controls[1:]:  # the control looks at nothing: it is the same for all
            shutil.copytree(controls[0].out, other.out, dirs_exist_ok=True)
    except (RunFailed, OSError) as error:
        warn(f"the report lacks the control {CONTROL!r}, which failed: {error}")


def load_reporter() -> Callable[[Path], object]:
    """Import and return the function that draws a report."""
    from ..analysis.report import write_report

    return write_report


def finish(run: Run, result: Result, background: BackgroundProcess, timing: Timing) -> None:
    """Write provenance, plots and report, and print the table."""
    from ..results.directory import REPORT
    from ..results.provenance import carried, save_provenance
    from ..results.refused_lines import refused_lines
    from ..results.table import table

    save_provenance({**timing.provenance(run), **carried(run.out)}, run.out)
    background.ask(run.out)
    console = standard_output()
    console.print(table(result, width=console.width))
    background.wait()
    report = run.out / REPORT
    for line in refused_lines(result):
        warn(line)
    shown = {remark.text.partition(": ")[2] for remark in result.remarks}  # beside a status
    for note in result.run.notes or ():
        if note.partition(": ")[2] not in shown:
            warn(note)
    print(f"written: {run.out}/result.json, result.dat, logs, plots; report: {report}")

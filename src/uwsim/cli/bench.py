"""``uwsim bench``: run a benchmark and write its result."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..analysis.load_reporter import load_reporter
from ..analysis.repeats_note import repeats_note
from ..base.exceptions import convert_to_run_failed
from ..base.files.file_names import file_names
from ..base.interrupts import raise_on_interrupt
from ..base.terminal import warn
from ..errors import BadSetting, ErrorCollector
from ..runs.planning.plan_request import PlanRequest
from .options.client_options import ClientOptions
from .options.completion import algorithm_names
from .options.help_texts import INPUT, OUTPUT, RUN, in_group
from .options.levels import read_levels
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
    from ..runs.execute import Callbacks
    from ..runs.executors.executor import OnLevel
    from ..runs.planning.plan import Plan
    from ..runs.run import Run
    from ..runs.trial.trial_observer import TrialObserver
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

    def requests(
        self, levels: Sequence[tuple[str, float]], wrong: ErrorCollector
    ) -> list[PlanRequest]:
        """Return what is asked for of each algorithm, none with an error; collects errors."""
        with wrong.collect():
            request = replace(
                request_of(self.task, self.changes, self.files),
                seed=self.seed,
                repeat=self.repeat,
                mode=self.mode,
                levels=levels,
                client=self.outside.client_spec(),
            )
            return [replace(request, algorithm=name) for name in self.algorithm or (None,)]
        return []


def bench(context: typer.Context, options: BenchOptions) -> None:
    """Run a benchmark: score every level and write a table, logs, plots and a report.

    Written into --out: result.json (all numbers, with units, seeds and hashes), result.dat (the
    original's table), logs as CSV, plots, report.html. Same files and same seed: the same bytes.
    --resume continues an interrupted run; trials that are run again are recorded anew.
    """
    from ..results.directory import check, prepare_directory
    from ..runs.execute import execute, plan_all, prepare_execution
    from ..runs.executors.background import BackgroundProcess

    wrong, wrong_levels, folders = ErrorCollector(), ErrorCollector(), []
    options.outside.check(wrong, options.by.workers)
    how = {"resume": options.resume, "overwrite": options.overwrite}
    requests = options.requests(read_levels(options.level, wrong_levels), wrong)
    executor, plans = plan_all(requests, options.by.workers, options.by.callback_limit, wrong)
    with wrong.collect():
        wrong_levels.raise_errors()
    with wrong.collect():
        check_live(options, plans)
    with wrong.collect():
        folders = folders_of(options.algorithm or ())
    with wrong.collect():
        check(options.directory, **how, results=folders)
    recordings: list[TrialRecording] = []
    with wrong.collect():
        if len(plans) == len(options.algorithm or (None,)):
            recordings = recordings_of(options, plans, folders)
    wrong.raise_errors()

    execution = prepare_execution(
        plans,
        executor,
        options.directory,
        workers=options.by.workers,
        folders=folders,
        command=context.obj,
    )
    record(execution.runs, recordings, is_resumed=options.resume)
    raise_on_interrupt()
    if note := repeats_note(len(plans), len(plans[0].levels()), options.repeat):
        print(note, file=sys.stderr)
    with (
        convert_to_run_failed(),
        looked_at(options.live, plans) as onlooker,  # first: a port that is taken changes nothing
    ):
        if onlooker is not None:
            from ..runs.executors.executor import SerialExecutor

            limit = options.by.callback_limit or None
            execution = replace(execution, executor=SerialExecutor(onlooker, callback_limit=limit))
        execute(
            execution,
            prepare_directory(options.directory, **how, results=folders),
            partial(BackgroundProcess, load_reporter),
            RunOutput(execution.runs, options.by.at_once).callbacks(),
        )


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
        for path in recording.missing_files(run) if is_resumed else ():
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
def looked_at(live: LiveOptions, plans: Sequence[Plan]) -> Iterator[TrialObserver | None]:
    """Open the live view that the options ask for; a pilot's run is in real time, and waits."""
    pilots = any(map(is_piloted, plans))
    title = Path(plans[0].benchmark.path).stem
    with live.opened(title, speed=float(pilots), is_piloted=pilots, waits=pilots) as view:
        yield view


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

    return list(file_names(algorithms, existing_names=FOLDERS).values())


class RunOutput:
    """What is printed of runs.

    Args:
        runs: an algorithm each.
        at_once: how many levels run at one time.
    """

    def __init__(self, runs: Sequence[Run], at_once: int) -> None:
        self._runs, self._at_once = runs, at_once
        self._n_written = 0

    def callbacks(self) -> Callbacks:
        """Return what prints."""
        from ..runs.execute import Callbacks

        return Callbacks(
            progress=self._progress, on_rows=self._print_table, on_report=self._print_written
        )

    def _progress(self, title: str, total: int, done: int) -> AbstractContextManager[OnLevel]:
        """Show how far the runs are."""
        return progress(title, total, done=done, of="levels", at_once=self._at_once)

    def _print_table(self, run: Run, result: Result) -> None:
        """Print the rows of a run."""
        from ..results.table import table

        if len(self._runs) > 1:
            print(f"{run.plan.algorithm.name}:")
        console = standard_output()
        console.print(table(result, width=console.width))

    def _print_written(self, run: Run, result: Result) -> None:
        """Print what reduces confidence in a run, and where its result is."""
        from ..results.directory import REPORT
        from ..results.refused_lines import refused_lines

        for line in refused_lines(result):
            warn(line)
        shown = {remark.text.partition(": ")[2] for remark in result.remarks}  # beside a status
        for note in result.run.notes or ():
            if note.partition(": ")[2] not in shown:
                warn(note)
        report = run.out / REPORT
        print(f"written: {run.out}/result.json, result.dat, logs, plots; report: {report}")
        self._n_written += 1
        if self._n_written == len(self._runs) > 1:
            print("compare: uwsim compare " + " ".join(str(run.out) for run in self._runs))

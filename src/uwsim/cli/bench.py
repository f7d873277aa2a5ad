"""``uwsim bench``: run a benchmark and write its result."""

from __future__ import annotations

import shlex
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
from ..runs.planning.ardupilot_scene import ADDRESS
from ..runs.planning.plan_request import PlanRequest
from .options.ardupilot_option import ArduPilotOption
from .options.client_options import ClientOptions
from .options.completion import algorithm_names
from .options.help_texts import INPUT, OUTPUT, RUN, option
from .options.levels import read_levels
from .options.live import LiveOptions
from .options.options import (
    CodeOptions,
    ModeOption,
    SettingOptions,
    TaskOptions,
    WorkerOptions,
    make_request,
)
from .options.px4_option import Px4Option
from .options.run_options import TrialRecordOptions
from .output.console import standard_output
from .output.progress import progress

if TYPE_CHECKING:
    from ..campaigns.shard import Shard
    from ..results.result import Result
    from ..runs.execute import Callbacks
    from ..runs.executors.executor import OnLevel
    from ..runs.planning.plan import Plan
    from ..runs.run import Run
    from ..runs.trial.trial_observer import TrialObserver
    from ..viewer.trial_recording import TrialRecording


@dataclass(frozen=True, kw_only=True)
class BenchOptions:
    """The options of ``uwsim bench``."""

    task: TaskOptions
    algorithm: Annotated[
        list[str] | None,
        option(
            INPUT,
            "--algorithm",
            metavar="NAME|module:Class",
            help="Algorithm under test: a name of `uwsim list algorithms`, or your own "
            "module:Class. The default is the benchmark's (u:algorithm). May be repeated: each "
            "result has a folder in --out.",
            autocompletion=algorithm_names,
        ),
    ] = None
    mode: ModeOption = None
    level: Annotated[
        list[str] | None,
        option(
            INPUT,
            "--level",
            metavar="NAME=VALUE",
            help="Only this level of the sweep, as fog=0.5; may be repeated.",
        ),
    ] = None
    changes: SettingOptions
    seed: Annotated[int, option(RUN, "--seed", metavar="N", min=0, help="Random seed.")] = 0
    repeat: Annotated[
        int,
        option(
            RUN,
            "--repeat",
            metavar="K",
            min=1,
            help="Run K times, with seeds SEED ... SEED+K-1; a comparison of two results needs at "
            "least six.",
        ),
    ] = 1
    processes: WorkerOptions
    client_options: ClientOptions
    ardupilot: ArduPilotOption = False
    px4: Px4Option = False
    out: Annotated[
        Path | None,
        option(OUTPUT, "--out", metavar="DIR", help="Result directory [./NAME.result]."),
    ] = None
    shard: Annotated[
        str | None,
        option(
            RUN,
            "--shard",
            metavar="I/N",
            help="Run part I of N of the trials, from 1/N on, into an --out that all parts share; "
            "`uwsim merge` then writes the result. A part that is run again continues.",
        ),
    ] = None
    resume: Annotated[bool, option(OUTPUT, "--resume", help="Resume the run in --out.")] = False
    overwrite: Annotated[
        bool,
        option(
            OUTPUT, "--overwrite", help="Replace an earlier result in --out, and its recordings."
        ),
    ] = False
    recording: TrialRecordOptions
    live_options: LiveOptions
    code: CodeOptions

    @property
    def directory(self) -> Path:
        """The directory of the result."""
        return self.out or Path(f"{Path(self.task.benchmark).stem}.result")

    def read_shard(self) -> Shard | None:
        """Return the shard to run; None to run all trials.

        Raises:
            BadSetting: the text is no shard, or another option excludes it.
        """
        from ..campaigns.shard import read_shard

        if self.shard is None:
            return None
        if self.resume or self.overwrite:
            raise BadSetting(
                "--shard continues what is in --out; leave out --resume and --overwrite."
            )
        if self.client_options.client is not None or self.ardupilot or self.px4:
            raise BadSetting("--shard: a program outside takes part in a run of one process only.")
        return read_shard(self.shard)

    def requests(
        self, levels: Sequence[tuple[str, float]], errors: ErrorCollector
    ) -> list[PlanRequest]:
        """Return the request of each algorithm; after an error, collect it and return none."""
        with errors.collect():
            request = replace(
                make_request(self.task, self.changes, self.code),
                seed=self.seed,
                repeat=self.repeat,
                mode=self.mode,
                levels=levels,
                client=self.client_options.client_spec(),
                udp_address=ADDRESS if self.ardupilot or self.px4 else None,
                has_px4=self.px4,
            )
            return [replace(request, algorithm=name) for name in self.algorithm or (None,)]
        return []


def bench(context: typer.Context, options: BenchOptions) -> None:
    """Run a benchmark: score every level and write a table, logs, plots and a report.

    It writes to --out: result.json (all numbers, with units, seeds and hashes), result.dat (the
    table of the original UWSim), logs as CSV, plots, report.html. Same files and same seed: the
    same bytes.
    --resume continues an interrupted run; trials that are run again are recorded anew.
    """
    from ..campaigns.shard import check_shared_directory, execute_shard
    from ..results.directory import check, prepare_directory
    from ..runs.execute import execute, plan_all, prepare_execution
    from ..runs.executors.background import BackgroundProcess

    errors, level_errors, folders = ErrorCollector(), ErrorCollector(), []
    options.client_options.check(
        errors, options.processes.workers, is_viewed=options.live_options.view
    )
    with errors.collect():
        if options.ardupilot and options.px4:
            raise BadSetting("--ardupilot and --px4 exclude each other.")
        has_autopilot = options.ardupilot or options.px4
        if has_autopilot and options.processes.workers not in ("0", "1"):
            name = "--px4" if options.px4 else "--ardupilot"
            raise BadSetting(
                f"--workers {options.processes.workers}: {name} is one program; expected 1."
            )
    modes = {"resume": options.resume, "overwrite": options.overwrite}
    requests = options.requests(read_levels(options.level, level_errors), errors)
    executor, plans = plan_all(
        requests, options.processes.workers, options.processes.callback_limit, errors
    )
    with errors.collect():
        level_errors.raise_errors()
    with errors.collect():
        check_live(options, plans)
    with errors.collect():
        folders = result_folders(options.algorithm or ())
    shard: Shard | None = None
    with errors.collect():
        shard = options.read_shard()
    with errors.collect():
        if shard is None:
            check(options.directory, **modes, results=folders)
        else:
            check_shared_directory(options.directory, folders)
    recordings: list[TrialRecording] = []
    with errors.collect():
        if len(plans) == len(options.algorithm or (None,)):
            recordings = plan_recordings(options, plans, folders)
    errors.raise_errors()

    execution = prepare_execution(
        plans,
        executor,
        options.directory,
        workers=options.processes.workers,
        folders=folders,
        command=context.obj,
    )
    record_trials(execution.runs, recordings, is_resumed=options.resume)
    raise_on_interrupt()
    if note := repeats_note(len(plans), len(plans[0].levels()), options.repeat):
        print(note, file=sys.stderr)
    with (
        convert_to_run_failed(),
        open_live_view(options, plans) as observer,  # first: it may fail at the port
    ):
        if observer is not None:
            from ..runs.executors.executor import SerialExecutor

            limit = options.processes.callback_limit or None
            execution = replace(execution, executor=SerialExecutor(observer, callback_limit=limit))
        output = RunOutput(execution.runs, options.processes.n_parallel)
        if shard is not None:
            runs = execute_shard(execution, shard, folders, output.progress)
            print_shard(shard, runs, options.directory)
            return
        execute(
            execution,
            prepare_directory(options.directory, **modes, results=folders),
            partial(BackgroundProcess, load_reporter),
            output.callbacks(),
        )


def print_shard(shard: Shard, runs: Sequence[Run], out: Path) -> None:
    """Print how many trials of a shard are finished, and the command that merges all shards."""
    n = sum(len(run.trials()) for run in runs)
    print(f"shard {shard}: its {n} trials are finished in {out}")
    print(f"when all shards are finished: {shlex.join(['uwsim', 'merge', str(out)])}")


def plan_recordings(
    options: BenchOptions, plans: Sequence[Plan], folders: Sequence[str]
) -> list[TrialRecording]:
    """Return the recording of each plan; none without ``--record``.

    Raises:
        BadSetting: recordings cannot be written.
    """
    from ..middleware.recording import image_storage
    from ..runs.executors.choose import RAY

    images, file = image_storage(options.recording.images), options.recording.record
    if file is None:
        return []
    from ..viewer.trial_recording import check_recordings, trial_recordings

    if options.processes.workers == RAY:
        raise BadSetting("--record: a worker of a Ray cluster may be on another machine.")
    recordings = trial_recordings(plans, file, images, folders)
    modes = {"resume": options.resume, "overwrite": options.overwrite}
    check_recordings(plans, recordings, options.directory, **modes)
    return recordings


def record_trials(
    runs: Sequence[Run], recordings: Sequence[TrialRecording], *, is_resumed: bool
) -> None:
    """Record the trials of runs; warn about finished trials of resumed runs without a recording."""
    if not recordings:
        return
    for run, recording in zip(runs, recordings, strict=True):
        run.recorder = recording
        for path in recording.missing_files(run) if is_resumed else ():
            warn(f"{path} is not written: its trial is finished, and is not run again")


def check_live(options: BenchOptions, plans: Sequence[Plan]) -> None:
    """Raise BadSetting for a live view of several processes, and for a pilot without one."""
    options.live_options.check()
    if options.live_options.view and options.processes.workers not in ("0", "1"):
        raise BadSetting("--view shows one process: leave out --workers.")
    if any(map(is_piloted, plans)) and not options.live_options.view:
        raise BadSetting("--algorithm pilot: add --view, the page in which the pilot acts.")


def is_piloted(plan: Plan) -> bool:
    """Return whether a user pilots in a plan, instead of recorded inputs of an earlier run."""
    return plan.algorithm.facts.is_piloted and not plan.inputs


@contextmanager
def open_live_view(options: BenchOptions, plans: Sequence[Plan]) -> Iterator[TrialObserver | None]:
    """Open the requested live view.

    A piloted run is in real time, and waits for a browser, as does a run with ``--speed``.
    """
    has_pilot = any(map(is_piloted, plans))
    title, speed = Path(plans[0].benchmark.path).stem, options.client_options.speed
    with options.live_options.open_session(
        title,
        speed=float(has_pilot) if speed is None else speed,
        is_piloted=has_pilot,
        waits=has_pilot or speed is not None,
    ) as view:
        yield view


def result_folders(algorithms: Sequence[str]) -> list[str]:
    """Return the folder of the result of each algorithm, if there are several.

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
    """The printed output of runs.

    Args:
        runs: the run of each algorithm.
        n_parallel: the number of levels that run in parallel.
    """

    def __init__(self, runs: Sequence[Run], n_parallel: int) -> None:
        self._runs, self._n_parallel = runs, n_parallel
        self._n_written = 0

    def callbacks(self) -> Callbacks:
        """Return the functions that a run calls to print its output."""
        from ..runs.execute import Callbacks

        return Callbacks(
            progress=self.progress, on_rows=self.print_table, on_report=self.print_written
        )

    def progress(self, title: str, total: int, n_done: int) -> AbstractContextManager[OnLevel]:
        """Display the number of finished levels."""
        return progress(title, total, n_done=n_done, unit="levels", n_parallel=self._n_parallel)

    def print_table(self, run: Run, result: Result) -> None:
        """Print the table of a result."""
        from ..results.table import table

        if len(self._runs) > 1:
            print(f"{run.plan.algorithm.name}:")
        console = standard_output()
        console.print(table(result, width=console.width))

    def print_written(self, run: Run, result: Result, *, has_report: bool = True) -> None:
        """Print the remarks and notes about a run as warnings, and the path of its result."""
        from ..results.directory import REPORT
        from ..results.refused_lines import refused_lines

        for line in refused_lines(result):
            warn(line)
        status_texts = {remark.text.partition(": ")[2] for remark in result.remarks}
        for note in result.run.notes or ():
            if note.partition(": ")[2] not in status_texts:
                warn(note)
        files = f"logs, plots; report: {run.out / REPORT}" if has_report else "logs"
        print(f"written: {run.out}/result.json, result.dat, {files}")
        self._n_written += 1
        if self._n_written == len(self._runs) > 1:
            print("compare: uwsim compare " + " ".join(str(run.out) for run in self._runs))

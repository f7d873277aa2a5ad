"""``uwsim suite run``: run an algorithm in the tasks of a suite."""

from __future__ import annotations

import shlex
from collections import Counter
from collections.abc import Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.table import Table

from ...base.interrupts import raise_on_interrupt
from ...base.terminal import clean_text
from ...errors import BadSetting, ErrorCollector
from ..bench import is_piloted
from ..options.client_options import ClientOptions
from ..options.completion import algorithm_names
from ..options.help_texts import INPUT, OUTPUT, option
from ..options.live import LiveOptions
from ..options.options import WorkerOptions
from ..output.console import standard_output
from ..output.progress import progress
from .list import SuiteArgument
from .seed_options import DrawnSeedOptions, ShardOption

if TYPE_CHECKING:
    from ...campaigns.shard import Shard
    from ...results.result import Result
    from ...runs.executors.executor import OnLevel
    from ...runs.planning.plan import Plan
    from ...runs.run import Run
    from ...suites.entry import Entry
    from ...suites.submission import Card
    from ...suites.suite_spec import TaskSpec


@dataclass(frozen=True, kw_only=True)
class EntryOptions:
    """The options that choose the algorithm, the tasks and the track."""

    algorithm: Annotated[
        list[str] | None,
        option(
            INPUT,
            "--algorithm",
            metavar="[TASK=]NAME",
            help="The algorithm of all tasks, or of one: a name of `uwsim list algorithms`, "
            "module:Class or FILE.py:Class. May be repeated.",
            autocompletion=algorithm_names,
        ),
    ] = None
    tasks: Annotated[
        str | None,
        option(
            INPUT,
            "--tasks",
            metavar="TASK,...",
            help="Only these tasks, with or without version. Without it all that have an "
            "algorithm.",
        ),
    ] = None
    track: Annotated[
        str,
        option(
            INPUT,
            "--track",
            metavar="TRACK",
            help="The track by sensors: other topics are withheld from the algorithm.",
        ),
    ] = "c"
    settings: Annotated[
        list[str] | None,
        option(
            INPUT,
            "--set",
            metavar="algorithm.NAME=VALUE",
            help="A parameter of the algorithm; may be repeated.",
        ),
    ] = None
    include: Annotated[
        list[Path] | None,
        option(
            INPUT,
            "--include",
            metavar="FILE",
            help="A file that FILE.py of --algorithm reads or imports, such as weights: it is "
            "copied next to it into the entry. May be repeated.",
        ),
    ] = None


@dataclass(frozen=True, kw_only=True)
class CardOptions:
    """The options of what the author states about the algorithm."""

    name: Annotated[
        str | None,
        option(OUTPUT, "--name", metavar="TEXT", help="Name of the entry. [name of --out]"),
    ] = None
    author: Annotated[str, option(OUTPUT, "--author", metavar="TEXT", help="The author.")] = ""
    description: Annotated[
        str, option(OUTPUT, "--description", metavar="TEXT", help="What the algorithm does.")
    ] = ""
    link: Annotated[
        str, option(OUTPUT, "--link", metavar="URL", help="Address of a page about it.")
    ] = ""
    gpu: Annotated[
        str,
        option(OUTPUT, "--gpu", metavar="TEXT", help="The GPU that the algorithm uses. [none]"),
    ] = ""

    def card(self) -> Card:
        """Return the card."""
        from ...suites.submission import Card

        return Card(author=self.author, description=self.description, link=self.link)


@dataclass(frozen=True, kw_only=True)
class SuiteRunOptions:
    """The options of ``uwsim suite run``."""

    entry: EntryOptions
    seeds: DrawnSeedOptions
    processes: WorkerOptions
    client_options: ClientOptions
    shard: ShardOption = None
    out: Annotated[Path, option(OUTPUT, "--out", metavar="DIR", help="The folder of the entry.")]
    card: CardOptions
    live_options: LiveOptions


def run_entry(context: typer.Context, suite: SuiteArgument, options: SuiteRunOptions) -> None:
    """Run an algorithm in the tasks of a suite.

    Each task has a folder in --out with a result, as of `uwsim bench`. submission.json lists their
    hashes, seeds, track, processor and CPU time. Run again, the command continues, and keeps
    finished trials. An algorithm FILE.py:Class is copied into --out/code and run there.

    Exit status 3: the algorithm failed by an error in every row of a task.
    """
    from ...suites.campaign import code_folder, copy_code
    from ...suites.entry import Entry, check_settings, choose_algorithms
    from ...suites.suite import find_suite, read_suite

    errors = ErrorCollector()
    options.client_options.check(
        errors, options.processes.workers, is_viewed=options.live_options.view
    )
    with errors.collect():
        options.live_options.check()
    with errors.collect():
        check_settings(options.entry.settings or ())
    shard: Shard | None = None
    with errors.collect():
        shard = read_shard_option(options)
    errors.raise_errors()
    source = read_suite(find_suite(suite).absolute())
    words = options.entry.algorithm or []
    if options.client_options.client is not None:
        if words:
            raise BadSetting(f"--algorithm {words[0]}: the algorithm is --client.")
        words = [options.client_options.client]
    tasks = [name for name in (options.entry.tasks or "").split(",") if name]
    algorithms = choose_algorithms(source, words, tasks)
    if not algorithms:
        raise BadSetting("--algorithm: expected NAME for all tasks, or TASK=NAME.")
    track, seeds = source.track(options.entry.track), options.seeds.read(source)
    out = options.out.absolute()
    names = copy_code(list(algorithms.values()), options.entry.include or (), out)
    entry = Entry(
        suite=source,
        algorithms={task: names[algorithm] for task, algorithm in algorithms.items()},
        track=track,
        seeds=seeds,
        is_short=options.seeds.public_seeds.is_short,
        settings=tuple(options.entry.settings or ()),
        client=options.client_options.client_spec(),
        folder=code_folder(out),
    )
    run_prepared(context.obj, entry, options, out, shard)


def read_shard_option(options: SuiteRunOptions) -> Shard | None:
    """Return the shard; None for all trials; raise BadSetting."""
    from ...campaigns.shard import read_shard

    if options.shard is None:
        return None
    if options.client_options.client is not None or options.live_options.view:
        raise BadSetting("--shard: a program outside, or a view, needs a run of one process.")
    return read_shard(options.shard)


def run_prepared(
    command: Sequence[str], entry: Entry, options: SuiteRunOptions, out: Path, shard: Shard | None
) -> None:
    """Run the trials of an entry, and write its submission."""
    from ...campaigns.shard import drop_shard
    from ...runs.execute import Execution
    from ...suites.campaign import cpu_time_text, execute_tasks
    from ...suites.entry import plan_entry, prepare_entry
    from ...suites.submission import save_submission, submission_of

    plans = plan_entry(entry)
    check_pilot(plans, options)
    runs = prepare_entry(plans, out)
    raise_on_interrupt()
    execution = Execution(
        runs=runs,
        executor=options.processes.executor(),
        workers=options.processes.workers,
        command=command,
        name=f"{entry.suite.spec.name} ({len(runs)} tasks)",
    )
    has_pilot = any(is_piloted(plan) for _, plan in plans)
    speed = options.client_options.speed
    with options.live_options.open_session(
        execution.title,
        speed=float(has_pilot) if speed is None else speed,
        is_piloted=has_pilot,
        waits=has_pilot or speed is not None,
    ) as view:
        if view is not None:
            from ...runs.executors.executor import SerialExecutor

            limit = options.processes.callback_limit or None
            execution = replace(execution, executor=SerialExecutor(view, callback_limit=limit))
        display = partial(show_progress, n_parallel=options.processes.n_parallel)
        outcome = execute_tasks(execution, shard, display)
    if shard is not None:
        words = shlex.join(["uwsim", *drop_shard(command)])
        print(f"shard {shard} is finished in {out}; when all are finished: {words}")
        return
    name = options.card.name or out.name
    submission = submission_of(
        entry, runs, outcome.results, name=name, card=options.card.card(), gpu=options.card.gpu
    )
    path = save_submission(submission, out)
    print(f"written: {path}; {cpu_time_text(submission.cpu_s)} of CPU time")
    print_results(entry, runs, outcome.results)


def check_pilot(plans: Sequence[tuple[TaskSpec, Plan]], options: SuiteRunOptions) -> None:
    """Raise BadSetting for a pilot without a live view, and a view of several processes."""
    if options.live_options.view and options.processes.workers not in ("0", "1"):
        raise BadSetting("--view shows one process: leave out --workers.")
    if not options.live_options.view and any(is_piloted(plan) for _, plan in plans):
        raise BadSetting("--algorithm pilot: add --view, the page in which the pilot acts.")


def show_progress(
    title: str, total: int, n_done: int, *, n_parallel: int
) -> AbstractContextManager[OnLevel]:
    """Display the number of finished levels."""
    return progress(title, total, n_done=n_done, unit="levels", n_parallel=n_parallel)


def print_results(entry: Entry, runs: Sequence[Run], results: Sequence[Result]) -> None:
    """Print how the trials of each task ended, and the first reason of each kind of error.

    Raises:
        RunFailed: an algorithm failed in every row of a task.
    """
    from ...runs.failed_algorithms import raise_if_all_failed

    standard_output().print(result_table(entry, results))
    for task, result in zip(entry.tasks, results, strict=True):
        for line in describe_errors(result):
            print(clean_text(f"{task.name}: {line}"))
    raise_if_all_failed(runs, results)


def describe_errors(result: Result) -> list[str]:
    """Return a line for each status that is an error: the number of rows, and the first reason."""
    from ...runs.failed_algorithms import ALGORITHM_ERROR
    from ...runs.trial.status import SIMULATION_ERROR

    statuses = result.values("status")
    lines = []
    for status in (ALGORITHM_ERROR, SIMULATION_ERROR):
        rows = [row for row, cell in enumerate(statuses) if cell == status]
        if rows:
            reason = result.reason(rows[0], "total") or "; ".join(result.reasons(rows[0]))
            lines.append(f"{len(rows)} of {len(statuses)} {status}: {reason}")
    return lines


def result_table(entry: Entry, results: Sequence[Result]) -> Table:
    """Return the table of the successes in each task.

    There is no interval over all levels: the levels of a seed are not independent.
    """
    table = Table(box=None, pad_edge=False, header_style="bold")
    for name in ("task", "algorithm"):
        table.add_column(name, no_wrap=True)
    for name in ("trials", "ok", "success [%]"):
        table.add_column(name, justify="right", no_wrap=True)
    table.add_column("others")
    for task, result in zip(entry.tasks, results, strict=True):
        counts = Counter(str(status) for status in result.values("status"))
        n, n_ok = counts.total(), counts.pop("ok", 0)
        failures = sorted(counts.items(), key=lambda item: (-item[1], item[0]))
        table.add_row(
            task.name,
            result.run.algorithm_label,
            str(n),
            str(n_ok),
            f"{100 * n_ok / max(1, n):.0f}",
            ", ".join(f"{count} {status}" for status, count in failures),
        )
    return table

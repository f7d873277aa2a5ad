"""``uwsim suite table``: the reference scores of a suite."""

from __future__ import annotations

import shlex
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from ...base.interrupts import raise_on_interrupt
from ..options.help_texts import INPUT, OUTPUT, RUN, option
from ..options.options import WorkerOptions
from ..output.console import standard_output
from .list import SuiteArgument
from .run import result_table, show_progress


@dataclass(frozen=True, kw_only=True)
class TableOptions:
    """The options of ``uwsim suite table``."""

    tasks: Annotated[
        str | None,
        option(INPUT, "--tasks", metavar="TASK,...", help="Only these tasks. Without it all."),
    ] = None
    seeds: Annotated[
        int | None,
        option(RUN, "--seeds", metavar="K", min=1, help="Only the first K seeds of the split."),
    ] = None
    split: Annotated[
        str | None,
        option(RUN, "--split", metavar="NAME", help="A public split. [the suite's first]"),
    ] = None
    is_short: Annotated[
        bool,
        option(RUN, "--short", help="One seed and the middle level of each task, as a trial."),
    ] = False
    processes: WorkerOptions
    shard: Annotated[
        str | None,
        option(
            RUN,
            "--shard",
            metavar="I/N",
            help="Part I of N of the trials, into an --out that all parts share. The same command "
            "without --shard then completes and writes the entries.",
        ),
    ] = None
    out: Annotated[Path, option(OUTPUT, "--out", metavar="DIR", help="The folder of the entries.")]


def write_reference_table(
    context: typer.Context, suite: SuiteArgument, options: TableOptions
) -> None:
    """Run all baselines, experts and control conditions of a suite.

    Each family has a folder in --out, which is an entry: baseline-1, baseline-2, expert, control.
    `uwsim suite site` makes a page of them. Run again, the command continues, and keeps finished
    trials. The CPU time of all trials is stated.
    """
    from ...campaigns.shard import drop_shard, read_shard
    from ...runs.execute import Execution
    from ...suites.campaign import cpu_time_text, execute_tasks, total_cpu_time
    from ...suites.entry import plan_entry, prepare_entries
    from ...suites.seeds import public_seeds
    from ...suites.submission import Card, save_submission, submission_of
    from ...suites.suite import find_suite, read_suite
    from ...suites.table import describe_family, reference_entries

    source = read_suite(find_suite(suite).absolute())
    source = source.select_tasks([name for name in (options.tasks or "").split(",") if name])
    count = 1 if options.is_short else options.seeds
    seeds = public_seeds(source, options.split or source.spec.splits[0].name, count)
    shard = None if options.shard is None else read_shard(options.shard)
    executor, out = options.processes.executor(), options.out.absolute()
    cpu_s = 0.0
    entries = dict(reference_entries(source, seeds, is_short=options.is_short))
    all_runs = prepare_entries({out / name: plan_entry(entry) for name, entry in entries.items()})
    raise_on_interrupt()
    for family, entry in entries.items():
        runs = all_runs[out / family]
        execution = Execution(
            runs=runs,
            executor=executor,
            workers=options.processes.workers,
            command=context.obj,
            name=f"{source.spec.name}, {family} ({len(runs)} tasks)",
        )
        display = partial(show_progress, n_parallel=options.processes.n_parallel)
        outcome = execute_tasks(execution, shard, display)
        cpu_s += total_cpu_time(out / family)
        if shard is None:
            kind = family.partition("-")[0]
            submission = submission_of(
                entry,
                runs,
                outcome.results,
                name=family,
                kind=kind,
                card=Card(description=describe_family(family)),
            )
            save_submission(submission, out / family)
            print(f"{family}:")
            standard_output().print(result_table(entry, outcome.results))
    if shard is not None:
        words = shlex.join(["uwsim", *drop_shard(context.obj)])
        print(f"shard {shard} is finished in {out}; when all are finished: {words}")
    else:
        print(f"written: {out}; {cpu_time_text(cpu_s)} of CPU time in total")

"""``uwsim suite table``: the reference scores of a suite."""

from __future__ import annotations

import shlex
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from ...base.interrupts import raise_on_interrupt
from ..options.help_texts import INPUT, OUTPUT, option
from ..options.options import WorkerOptions
from .list import SuiteArgument
from .run import print_results, show_progress
from .seed_options import SeedOptions, ShardOption


@dataclass(frozen=True, kw_only=True)
class TableOptions:
    """The options of ``uwsim suite table``."""

    tasks: Annotated[
        str | None,
        option(INPUT, "--tasks", metavar="TASK,...", help="Only these tasks. Without it all."),
    ] = None
    seeds: SeedOptions
    processes: WorkerOptions
    shard: ShardOption = None
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
    from ...suites.submission import Card, save_submission, submission_of
    from ...suites.suite import find_suite, read_suite
    from ...suites.table import describe_family, reference_entries

    source = read_suite(find_suite(suite).absolute())
    source = source.select_tasks([name for name in (options.tasks or "").split(",") if name])
    seeds = options.seeds.read(source)
    shard = None if options.shard is None else read_shard(options.shard)
    executor, out = options.processes.executor(), options.out.absolute()
    cpu_s = 0.0
    entries = dict(reference_entries(source, seeds, is_short=options.seeds.is_short))
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
            print_results(entry, runs, outcome.results)
    if shard is not None:
        words = shlex.join(["uwsim", *drop_shard(context.obj)])
        print(f"shard {shard} is finished in {out}; when all are finished: {words}")
    else:
        print(f"written: {out}; {cpu_time_text(cpu_s)} of CPU time in total")

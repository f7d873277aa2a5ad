"""``uwsim merge``: write the result of the shards of ``uwsim bench --shard``."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ...analysis.load_reporter import load_reporter
from ...base.exceptions import convert_to_run_failed
from ...base.interrupts import raise_on_interrupt
from ..bench import RunOutput
from ..options.help_texts import OUTPUT, option
from ..options.options import WorkerOptions
from ..options.recorded_files import FileOptions
from ..output.progress import progress

if TYPE_CHECKING:
    from ...runs.executors.executor import OnLevel
    from ...runs.run import Run

CampaignArgument = Annotated[
    Path, typer.Argument(metavar="DIR", help="The --out of all shards.", show_default=False)
]


def merge(
    campaign: CampaignArgument,
    worker_options: WorkerOptions,
    file_options: FileOptions,
    no_report: Annotated[
        bool, option(OUTPUT, "--no-report", help="Draw no plots and no report.html.")
    ] = False,
) -> None:
    """Write the result of a campaign from the trials that its shards have left in DIR.

    result.json, tables and logs have the bytes of `uwsim bench` on one machine. Trials that are
    not finished are listed, and nothing is written. Shards of other files, seeds or versions are
    refused. Files are found by name and recorded hash, as by `uwsim verify`. Exit status 3: a
    simulation failed, or an algorithm in every row, as of `uwsim bench`.
    """
    from ...campaigns.merge import merge as write_results
    from ...campaigns.merge import read_campaign, save_provenances
    from ...runs.execute import Execution
    from ...runs.failed_algorithms import raise_if_rows_failed

    executor = worker_options.executor()
    shared_runs = read_campaign(campaign, file_options.overrides())
    execution = Execution(runs=shared_runs.runs, executor=executor, workers=worker_options.workers)
    raise_on_interrupt()
    output = RunOutput(shared_runs.runs, worker_options.n_parallel)
    with convert_to_run_failed(), ExitStack() as stack:
        results = write_results(
            shared_runs,
            executor=executor,
            open_progress=partial(_open_progress, stack, worker_options),
        )
        save_provenances(execution, shared_runs)
        report: Callable[[Path], object] = (lambda path: None) if no_report else load_reporter()
        for run, result in zip(shared_runs.runs, results, strict=True):
            output.print_table(run, result)
            report(run.out)
            output.print_written(run, result, has_report=not no_report)
        raise_if_rows_failed(shared_runs.runs, results)


def _open_progress(stack: ExitStack, worker_options: WorkerOptions, run: Run) -> OnLevel:
    """Display the progress of the control run."""
    n_levels = sum(len(trial.levels) for trial in run.trials())
    display = progress(
        "control run",
        n_levels,
        n_done=run.n_finished(),
        unit="levels",
        n_parallel=worker_options.n_parallel,
    )
    on_level: OnLevel = stack.enter_context(display)
    return on_level

"""The function that searches for the breaking point and returns the envelope."""

from __future__ import annotations

from dataclasses import replace

from ..runs.executors.executor import Executor, OnLevel
from ..runs.run import Run
from .envelope import Envelope, SearchSettings
from .evaluate import Evaluations
from .search import strategy
from .search_request import SearchRequest


def max_runs(settings: SearchSettings) -> int:
    """Return an upper bound of the number of runs of a search."""
    return 9 + len(settings.seeds) * (settings.bounds.max_cuts() + 1)


def find(
    run: Run, request: SearchRequest, settings: SearchSettings, executor: Executor, on_run: OnLevel
) -> Envelope:
    """Search for the breaking point of every seed.

    Args:
        run: the benchmark run that stores the trials, with a plan of `plan_for`.
        request: the request of the search.
        settings: the settings of the search, with the seeds.
        executor: the executor of the runs that are not on disk.
        on_run: called after each executed run.
    """
    runs = Evaluations(
        run, level=request.level, parameter=request.parameter, criterion=request.criterion
    )
    search = runs.run(strategy(settings.seeds, settings.bounds), executor, on_run)
    return Envelope(
        settings=settings,
        search=search,
        evaluations=tuple(runs.results[key] for key in sorted(runs.results, key=lambda k: k[::-1])),
        inputs=run.inputs,
        run=replace(run.info, seed=None, repeats=None, levels=None),
    )

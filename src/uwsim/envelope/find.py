"""The search for an envelope and the collection of its runs."""

from __future__ import annotations

from dataclasses import replace

from ..runs.executors.executor import Executor, OnLevel
from ..runs.run import Run
from .envelope import Envelope, SearchSettings
from .evaluate import Evaluations
from .search import strategy
from .search_request import SearchRequest


def max_runs(settings: SearchSettings) -> int:
    """Return the greatest number of runs of a search."""
    return 9 + len(settings.seeds) * (settings.bounds.max_cuts() + 1)


def find(
    run: Run, request: SearchRequest, settings: SearchSettings, executor: Executor, on_run: OnLevel
) -> Envelope:
    """Search for the breaking point of every seed.

    Args:
        run: the run; its plan is one of `plan_for`.
        request: the request of the search.
        settings: the same, with the seeds.
        executor: the executor of the runs that are not on disk.
        on_run: called for each of these.
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

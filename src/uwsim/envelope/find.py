"""Finding an envelope: executes the search and collects its runs."""

from __future__ import annotations

from dataclasses import replace

from ..runs.executors.executor import Executor, OnLevel
from ..runs.run import Run
from .envelope import Asked, Envelope
from .evaluate import Evaluations
from .search import strategy
from .search_request import SearchRequest


def most_runs(asked: Asked) -> int:
    """Return how many runs a search takes at most."""
    return 9 + len(asked.seeds) * (asked.where.most_cuts() + 1)


def find(
    run: Run, request: SearchRequest, asked: Asked, executor: Executor, on_run: OnLevel
) -> Envelope:
    """Search for the breaking point of every seed.

    Args:
        run: its plan is one of `plan_for`.
        request: what is searched for.
        asked: the same, with the seeds.
        executor: who executes the runs that are not on disk.
        on_run: called for each of these.
    """
    runs = Evaluations(run, at=request.at, over=request.over, criterion=request.criterion)
    found = runs.run(strategy(asked.seeds, asked.where), executor, on_run)
    return Envelope(
        asked=asked,
        found=found,
        evaluations=tuple(runs.made[key] for key in sorted(runs.made, key=lambda k: k[::-1])),
        inputs=run.inputs,
        run=replace(run.info, seed=None, repeats=None, levels=None),
    )

"""Algorithms that failed in every row, or ended their process: the command fails."""

from __future__ import annotations

from collections.abc import Sequence

from ..errors import RunFailed
from ..results.result import Result
from .run import Run
from .trial.status import ended_its_process

ALGORITHM_ERROR = "algorithm error"


def refuse_if_all_broke(runs: Sequence[Run], results: Sequence[Result]) -> None:
    """Raise if an algorithm failed in every row; all files are written by then.

    Raises:
        RunFailed: names the algorithms, and why the first row of each is as it is.
    """
    broke = [
        f"{run.plan.algorithm.name} ({result.why(0, 'total')})"
        for run, result in zip(runs, results, strict=True)
        if result.rows and set(result.values("status")) == {ALGORITHM_ERROR}
    ]
    if broke:
        raise RunFailed(f"Every row ended in {ALGORITHM_ERROR!r}: {'; '.join(broke)}.")


def refuse_if_a_process_ended(runs: Sequence[Run], results: Sequence[Result]) -> None:
    """Raise if an algorithm ended its process.

    Raises:
        RunFailed: names the algorithms, and why the first such row of each is as it is.
    """
    ended = []
    for run, result in zip(runs, results, strict=True):
        reasons = [result.why(row, "total") or "" for row in range(len(result.rows))]
        name = run.plan.algorithm.name
        ended += [why for why in reasons if ended_its_process(name, why)][:1]
    if ended:
        raise RunFailed(f"{'; '.join(ended)}. Rows are kept; --resume tries those again.")

"""Failed simulations, and algorithms that failed in every row or ended their process."""

from __future__ import annotations

from collections.abc import Sequence

from ..errors import RunFailed
from ..results.result import Result
from .run import Run
from .trial.status import SIMULATION_ERROR, ended_its_process

ALGORITHM_ERROR = "algorithm error"


def raise_if_rows_failed(runs: Sequence[Run], results: Sequence[Result]) -> None:
    """Raise an error if rows of finished runs failed in a way that their user has to know.

    Raises:
        RunFailed: a simulation failed, an algorithm ended its process, or failed in every row.
    """
    raise_if_simulation_failed(runs, results)
    raise_if_process_ended(runs, results)
    raise_if_all_failed(runs, results)


def raise_if_simulation_failed(runs: Sequence[Run], results: Sequence[Result]) -> None:
    """Raise an error if the simulation of a row failed; all files are written by then.

    Raises:
        RunFailed: states the number of such rows for each algorithm, and the reason of the first.
    """
    texts = []
    for run, result in zip(runs, results, strict=True):
        status = result.values("status")
        rows = [row for row, cell in enumerate(status) if cell == SIMULATION_ERROR]
        if rows:
            name, reason = run.plan.algorithm.name, result.reason(rows[0], "total") or ""
            texts.append(f"{name}, {len(rows)} of {len(status)} rows ({reason.rstrip('.')})")
    if texts:
        raise RunFailed(
            f"Rows ended in {SIMULATION_ERROR!r}: {'; '.join(texts)}. Other rows are not affected."
        )


def raise_if_all_failed(runs: Sequence[Run], results: Sequence[Result]) -> None:
    """Raise an error if an algorithm failed in every row; all files are written by then.

    Raises:
        RunFailed: names the algorithms, and the reason of the first row of each.
    """
    texts = [
        f"{run.plan.algorithm.name} ({result.reason(0, 'total')})"
        for run, result in zip(runs, results, strict=True)
        if result.rows and set(result.values("status")) == {ALGORITHM_ERROR}
    ]
    if texts:
        raise RunFailed(f"Every row ended in {ALGORITHM_ERROR!r}: {'; '.join(texts)}.")


def raise_if_process_ended(runs: Sequence[Run], results: Sequence[Result]) -> None:
    """Raise an error if an algorithm ended its process.

    Raises:
        RunFailed: names the algorithms, and the reason of the first such row of each.
    """
    texts = []
    for run, result in zip(runs, results, strict=True):
        reasons = [result.reason(row, "total") or "" for row in range(len(result.rows))]
        name = run.plan.algorithm.name
        texts += [reason for reason in reasons if ended_its_process(name, reason)][:1]
    if texts:
        raise RunFailed(f"{'; '.join(texts)}. Rows are kept; --resume tries those again.")

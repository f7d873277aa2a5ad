"""The encryption (sealing) of the rows and motion tracks of third-party algorithms during runs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from ..results.seal import Keeper, Seal, deny_access_to_memory
from .planning.plan import Plan
from .run import Run


def is_foreign(plan: Plan) -> bool:
    """Return whether foreign code runs: a class, a plugin or an external program."""
    return plan.algorithm.client is not None or not plan.is_bundled


@contextmanager
def seal_runs(runs: Sequence[Run]) -> Iterator[None]:
    """Seal the files of all these runs until the block ends, if one runs foreign code."""
    if not any(is_foreign(run.plan) for run in runs):
        yield
        return
    deny_access_to_memory()
    seal = Seal()
    for run in runs:
        run.out.mkdir(parents=True, exist_ok=True)
        run.seal = seal
    # a second process that decrypts the files if this one is killed
    keeper = Keeper(seal, [run.out for run in runs])
    try:
        yield
    finally:
        is_all_open = True
        for run in runs:
            is_all_open &= seal.open_all(run.out)
            run.seal = None
        keeper.close(is_all_open=is_all_open)

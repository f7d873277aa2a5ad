"""The algorithm of a plan: made in this process, or in one of its own."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager

from ...bus import Algorithm
from ..planning.plan import Plan
from .process import OwnProcess, ProcessAlgorithm

Program = Callable[[Mapping[str, float | str]], Algorithm]
"""Makes the algorithm; takes the parameters that the user set."""
OWN_PROCESS, IN_PROCESS = "own process", "in process"
"""How a third-party algorithm takes part, as a result says it."""


@contextmanager
def program_of(plan: Plan) -> Iterator[Program]:
    """Yield what makes the algorithm of a plan; its process ends with the block."""
    if not plan.own_process:
        yield lambda parameters: plan.algorithm()
        return
    with OwnProcess() as process:
        yield lambda parameters: ProcessAlgorithm(process, plan.algorithm, plan.plugins, parameters)


def clients_of(plan: Plan) -> tuple[tuple[str, str], ...] | None:
    """Return who takes part, and how; None where only code of uwsim does."""
    if plan.own_process:
        return ((plan.algorithm_name, OWN_PROCESS),)
    if plan.algorithm.__module__.startswith("uwsim."):
        return None
    return ((plan.algorithm_name, IN_PROCESS),)

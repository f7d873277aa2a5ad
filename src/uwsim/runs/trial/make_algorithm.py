"""Making the algorithm of a trial."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from ...bus import Algorithm
from ...errors import NeverStarted, UwsimError
from ...interrupts import is_of_user
from ...simulation import Calls, what_broke
from ..planning.plan import Plan
from .status import legible


def make_algorithm(
    plan: Plan,
    program: Callable[[Mapping[str, float | str]], Algorithm],
    parameters: Mapping[str, float | str],
    calls: Calls,
) -> Algorithm:
    """Make the algorithm; an exception of its constructor is a NeverStarted."""
    try:
        with calls:
            return program(parameters)
    except BaseException as error:
        is_outside = plan.algorithm.client is not None
        if is_of_user(error) or (is_outside and isinstance(error, UwsimError)):
            raise
        raise NeverStarted(
            f"Algorithm {plan.algorithm.name!r} cannot be made: "
            f"{legible(what_broke(error, plan.algorithm.cls))}"
        ) from error

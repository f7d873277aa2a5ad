"""Making the algorithm of a trial, and asking it for its parameters."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from ...base.exceptions import RemoteError
from ...base.interrupts import is_user_interrupt
from ...base.tracked_parameters import describe_unread_parameters
from ...benchmark.plugin_checks import parameters_of
from ...bus import Algorithm
from ...errors import NeverStarted, RunFailed, UwsimError
from ...simulation import Calls, InProcessNode, what_broke
from ...simulation.nodes.calls import Stopped
from ..own_process.process import ProcessAlgorithm
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
        if is_user_interrupt(error) or (is_outside and isinstance(error, UwsimError)):
            raise
        raise NeverStarted(
            f"Algorithm {plan.algorithm.name!r} cannot be made: "
            f"{legible(what_broke(error, plan.algorithm.cls))}"
        ) from error


def parameters_said(
    plan: Plan, algorithm: Algorithm, given: Mapping[str, float | str], calls: Calls
) -> dict[str, float | int | str]:
    """Return the parameters that the algorithm reports.

    Raises:
        RunFailed: they cannot be stored in a result, or reading them fails.
    """
    try:
        with calls:
            return parameters_of(algorithm, given, name=plan.algorithm.cls.__name__)
    except UwsimError:
        raise
    except BaseException as error:
        if is_user_interrupt(error):
            raise
        message = legible(what_broke(error, plan.algorithm.cls))
        raise RunFailed(
            f"Algorithm {plan.algorithm.name!r} cannot report its parameters: {message}"
        ) from error


def unread_parameters(plan: Plan, algorithm: Algorithm, node: InProcessNode) -> tuple[str, ...]:
    """Say which of the parameters that the user set an algorithm has never read, if any.

    Nothing is said of one that failed: it may have failed before it could read them.
    """
    given = [name for name in plan.algorithm.parameters if name != "latency_s"]
    if not given or node.error is not None:
        return ()
    asked: Iterable[str] = node.parameters.names_read
    if isinstance(algorithm, ProcessAlgorithm):
        try:
            asked = algorithm.names_read
        except (RemoteError, Stopped):
            return ()
    note = describe_unread_parameters(plan.algorithm.name, given, asked)
    return (note,) if note else ()

"""The construction of a trial's algorithm, and the parameters that it reports and reads."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from ...base.exceptions import RemoteError
from ...base.interrupts import is_user_interrupt
from ...base.terminal import warn
from ...base.tracked_parameters import describe_unread_parameters
from ...benchmark.plugin_checks import read_parameters
from ...bus import Algorithm
from ...errors import NeverStarted, RunFailed, UwsimError
from ...simulation import Calls, InProcessNode, describe_failure
from ...simulation.nodes.calls import CallStopped
from ..own_process.process import ProcessAlgorithm
from ..planning.plan import Plan, Trial
from .status import to_line


def make_algorithm(
    plan: Plan,
    program: Callable[[Mapping[str, float | str]], Algorithm],
    parameters: Mapping[str, float | str],
    calls: Calls,
) -> Algorithm:
    """Construct the algorithm; raise NeverStarted for an exception of its constructor."""
    try:
        with calls:
            return program(parameters)
    except BaseException as error:
        is_outside = plan.algorithm.client is not None
        if is_user_interrupt(error) or (is_outside and isinstance(error, UwsimError)):
            raise
        raise NeverStarted(
            f"Algorithm {plan.algorithm.name!r} cannot be made: "
            f"{to_line(describe_failure(error, plan.algorithm.loaded_class))}"
        ) from error


def reported_parameters(
    plan: Plan, algorithm: Algorithm, user_parameters: Mapping[str, float | str], calls: Calls
) -> dict[str, float | int | str]:
    """Return the parameters that the algorithm reports.

    Raises:
        RunFailed: they cannot be stored in a result, or reading them fails.
    """
    try:
        with calls:
            return read_parameters(algorithm, user_parameters, name=plan.algorithm.facts.name)
    except UwsimError:
        raise
    except BaseException as error:
        if is_user_interrupt(error):
            raise
        message = to_line(describe_failure(error, plan.algorithm.loaded_class))
        raise RunFailed(
            f"Algorithm {plan.algorithm.name!r} cannot report its parameters: {message}"
        ) from error


def unread_parameters(plan: Plan, algorithm: Algorithm, node: InProcessNode) -> tuple[str, ...]:
    """Return a note on the user's parameters that an algorithm has never read; () without any.

    There is no note on a failed algorithm, which may have failed before it could read them.
    """
    names = [name for name in plan.algorithm.parameters if name != "latency_s"]
    if not names or node.error is not None:
        return ()
    names_read: Iterable[str] = node.parameters.names_read
    if isinstance(algorithm, ProcessAlgorithm):
        try:
            names_read = algorithm.names_read
        except (RemoteError, CallStopped):
            return ()
    note = describe_unread_parameters(plan.algorithm.name, names, names_read)
    return (note,) if note else ()


def warn_of_topics(plan: Plan, trial: Trial, node: InProcessNode) -> None:
    """Print a warning for each topic of a user's algorithm that has no other end.

    It is printed after the first trial of a run, and is not part of the result. Bundled algorithms
    may offer topics that no measure reads.
    """
    if trial.index == 0 and not plan.is_bundled and node.error is None:
        for sentence in node.describe_unconnected_topics():
            warn(sentence)

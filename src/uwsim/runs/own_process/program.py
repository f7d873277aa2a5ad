"""The algorithm of a plan: made in this process, in one of its own, or a program outside."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from functools import partial

from ...bus import Algorithm
from ...middleware.lockstep.client import LockStepClient
from ...middleware.lockstep.external_client import make_external_client
from ...middleware.lockstep.external_program import ExternalProgram
from ...middleware.lockstep.spec import FREE_RUNNING, LOCK_STEP, ClientSpec
from ...middleware.pacing import Pace
from ...simulation import Simulation
from ..planning.plan import Plan
from .process import OwnProcess, ProcessAlgorithm

Program = Callable[[Simulation, Mapping[str, float | str]], Algorithm]
"""Makes the algorithm of a simulation; takes the parameters that the user set."""
OWN_PROCESS, IN_PROCESS = "own process, grade (b)", "in process"
"""How an algorithm class that is not bundled takes part, as a result says it."""


@contextmanager
def program_of(plan: Plan, limit: float | None = None) -> Iterator[Program]:
    """Yield what makes the algorithm of a plan; its process, or connection, ends with the block.

    Args:
        plan: names the algorithm.
        limit: how long a callback in a process of its own may take [s of wall time].
    """
    with ExitStack() as stack:
        if plan.algorithm.client is not None:
            yield partial(_client, plan.algorithm.client, stack)
        elif plan.algorithm.own_process:
            yield partial(_in_own_process, plan, stack.enter_context(OwnProcess(limit)))
        else:
            yield lambda simulation, parameters: plan.algorithm.cls()


def _in_own_process(
    plan: Plan, process: OwnProcess, simulation: Simulation, parameters: Mapping[str, float | str]
) -> Algorithm:
    may_refuse = simulation.bus.may_refuse
    return ProcessAlgorithm(process, plan.algorithm.cls, plan.plugins, parameters, may_refuse)


def _client(
    spec: ClientSpec,
    stack: ExitStack,
    simulation: Simulation,
    parameters: Mapping[str, float | str],
) -> Algorithm:
    """Open the connection of a program outside, until the stack is closed."""
    opened = spec.connection.open(simulation.bus, lambda: simulation.time)
    bridges = stack.enter_context(opened)
    client = make_external_client(spec, bridges, timestep=simulation.timestep)
    for bridge in bridges:
        simulation.watch(bridge.step)
    if spec.sync == "none":
        simulation.watch(Pace(lambda: simulation.time, spec.speed).step)
    return client


def refused_of(algorithm: Algorithm) -> tuple[tuple[str, str, int], ...]:
    """Return what was refused, since the last call, of programs that do not take part.

    Sender, topic or service, and how often; nothing where the algorithm is no program outside.
    """
    if isinstance(algorithm, LockStepClient | ExternalProgram):
        return algorithm.take_refusals()
    return ()


def clients_of(plan: Plan) -> tuple[tuple[str, str], ...] | None:
    """Return who takes part, how, and its grade; None where only code of uwsim does."""
    if plan.algorithm.client is not None:
        return ((plan.algorithm.name, plan.algorithm.client.participation),)
    if plan.algorithm.own_process:
        return ((plan.algorithm.name, OWN_PROCESS),)
    if plan.algorithm.cls.__module__.startswith("uwsim."):
        return None
    return ((plan.algorithm.name, IN_PROCESS),)


def is_outside(how: str) -> bool:
    """Whether an entry of `clients_of` is of a program outside, which only its owner can run."""
    return how.startswith((LOCK_STEP, FREE_RUNNING))

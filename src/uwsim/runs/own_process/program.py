"""The algorithm of a plan: in this process, in a process of its own, or an external program."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from functools import partial

from ...algorithms.policy import make_algorithm_of
from ...bus import Algorithm
from ...middleware.lockstep.client import LockStepClient
from ...middleware.lockstep.external_client import make_client
from ...middleware.lockstep.external_program import ExternalProgram
from ...middleware.lockstep.spec import FREE_RUNNING, LOCK_STEP, ClientSpec
from ...middleware.pacing import Pace
from ...simulation import Simulation
from ..planning.plan import Plan
from .process import OwnProcess, ProcessAlgorithm

Program = Callable[[Simulation, Mapping[str, float | str]], Algorithm]
"""The constructor of a simulation's algorithm from the parameters that the user set."""
ARDUPILOT, ARDUPILOT_PARTICIPATION = "ArduPilot", f"{LOCK_STEP}, ardupilot, grade (b)"
"""The name and the participation in a result of the autopilot of ``--ardupilot``."""
PX4, PX4_PARTICIPATION = "PX4", f"{LOCK_STEP}, px4, grade (b)"
"""The name and the participation in a result of the autopilot of ``--px4``."""
OWN_PROCESS, SHARED_PROCESS = "own process, grade (b)", "in process"
"""The texts in a result for the participation of an algorithm class that is not bundled."""


@contextmanager
def program_of(plan: Plan, limit: float | None = None) -> Iterator[Program]:
    """Yield the constructor of a plan's algorithm.

    The process of the algorithm, or the connection to it, is closed at the end of the block.

    Args:
        plan: the plan, which names the algorithm.
        limit: the longest callback in a process of its own [s of wall time].
    """
    with ExitStack() as stack:
        if plan.algorithm.client is not None:
            yield partial(_client, plan.algorithm.client, stack)
        elif plan.algorithm.own_process:
            yield partial(
                _process_algorithm,
                plan,
                stack.enter_context(OwnProcess(limit, plan.algorithm.folder)),
            )
        else:
            yield lambda simulation, parameters: make_algorithm_of(plan.algorithm.loaded_class)


def _process_algorithm(
    plan: Plan, process: OwnProcess, simulation: Simulation, parameters: Mapping[str, float | str]
) -> Algorithm:
    may_refuse = simulation.bus.may_refuse
    under_test = plan.algorithm
    return ProcessAlgorithm(
        process, under_test.cls, plan.plugins, parameters, may_refuse, under_test.folder
    )


def _client(
    spec: ClientSpec,
    stack: ExitStack,
    simulation: Simulation,
    parameters: Mapping[str, float | str],
) -> Algorithm:
    """Open the connection to an external program; the stack closes it."""
    connection = spec.connection.open(simulation.bus, lambda: simulation.time)
    bridges = stack.enter_context(connection)
    client = make_client(spec, bridges, timestep=simulation.timestep)
    for bridge in bridges:
        simulation.watch(bridge.step)
    if spec.sync == "none":
        simulation.watch(Pace(lambda: simulation.time, spec.speed).step)
    return client


def pop_refused_messages(algorithm: Algorithm) -> tuple[tuple[str, str, int], ...]:
    """Return the numbers of messages that were refused since the last call.

    Messages of external programs that do not take part in the benchmark are refused.

    Returns:
        For each sender and topic or service: the sender, the topic or service, the number.
    """
    if isinstance(algorithm, LockStepClient | ExternalProgram):
        return algorithm.pop_refusals()
    return ()


def clients_of(plan: Plan) -> tuple[tuple[str, str], ...] | None:
    """Return the name and the participation, with its grade, of each participant.

    None if only code of uwsim takes part.
    """
    autopilot: tuple[tuple[str, str], ...] = ()
    if plan.udp_address is not None:
        is_px4 = plan.has_px4
        autopilot = (
            ((PX4, PX4_PARTICIPATION),) if is_px4 else ((ARDUPILOT, ARDUPILOT_PARTICIPATION),)
        )
    if plan.algorithm.client is not None:
        return ((plan.algorithm.name, plan.algorithm.client.participation), *autopilot)
    if plan.algorithm.own_process:
        return ((plan.algorithm.name, OWN_PROCESS), *autopilot)
    if plan.algorithm.facts.module.startswith("uwsim."):
        return autopilot or None
    return ((plan.algorithm.name, SHARED_PROCESS), *autopilot)


def is_outside(participation: str) -> bool:
    """Return whether a participation, from `clients_of`, is of an external program."""
    return participation.startswith((LOCK_STEP, FREE_RUNNING))

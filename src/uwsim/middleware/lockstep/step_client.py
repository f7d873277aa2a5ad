"""A program that takes the steps itself, by the service ``step_simulation``.

It calls the service with a number of steps (`simulation_interfaces/srv/StepSimulation`); simulation
time passes by as many and then stands until the next call. The response comes when they are done,
behind all that was published in them where the transport keeps the order. What the program has
published before a call is put on the bus before the first of its steps.
"""

from __future__ import annotations

from collections import deque
from concurrent.futures import Future

from ...bus import Node
from ...errors import ClientLost, NeverStarted
from ...messages.simulation_control import (
    MAX_STEPS,
    Result,
    StepSimulation,
    StepSimulationResponse,
)
from ..bridge import Bridge
from .external_program import ExternalProgram
from .spec import ClientSpec

SERVICE = "step_simulation"


class StepClient(ExternalProgram):
    """One program; an algorithm in the sense of `uwsim.bus.Algorithm`.

    Args:
        bridge: to the transport by which it comes.
        spec: its name and limit.
        timestep: of the simulation [s].
    """

    def __init__(self, bridge: Bridge, spec: ClientSpec, *, timestep: float) -> None:
        super().__init__(bridge, spec)
        self._timestep = timestep
        self._calls: deque[tuple[int, Future[object]]] = deque()
        self._left = 0
        self._answer: Future[object] | None = None

    def start(self, node: Node) -> None:
        """Wait for the first call.

        Raises:
            NeverStarted: there was none within the limit.
        """
        self._node = node
        self._bridge.deferred_responses.offer(SERVICE, StepSimulation, self._asked)
        self._bridge.step()
        if not self._next():
            raise NeverStarted(
                f"Client {self.name!r} has not called /{SERVICE} within {self._spec.limit:g} s of "
                "wall time (--client-limit)."
            )
        self._left += 1  # what is published before the first step ends none
        node.create_timer(self._timestep, self._barrier)

    def _barrier(self) -> None:
        """End a step; where it was the last of a call, answer it and wait for the next."""
        self._left -= 1
        if self._left > 0:
            return
        assert self._answer is not None
        self._answer.set_result(StepSimulationResponse())
        self._answer = None
        if not self._next():
            raise ClientLost(
                f"Client {self.name!r} has not called /{SERVICE} at {self._node.now:g} s within "
                f"{self._spec.limit:g} s of wall time (--client-limit): the run is invalid."
            )

    def _next(self) -> bool:
        """Wait for a call; whether it came. What was published before it is on the bus then."""
        bridge = self._bridge
        if not bridge.wait_for(lambda: bool(self._calls), self._spec.limit):
            return False
        self._left, self._answer = self._calls.popleft()
        if self._spec.settling:
            bridge.wait_for(lambda: False, self._spec.settling)
        bridge.step()
        return True

    def _asked(self, request: object, answer: Future[object]) -> None:
        """Take in a call, in the thread of the simulation."""
        assert isinstance(request, StepSimulation)
        if not 1 <= request.steps <= MAX_STEPS:
            said = f"Expected 1 to {MAX_STEPS} steps."
            answer.set_result(StepSimulationResponse(Result(Result.OPERATION_FAILED, said)))
        elif self._calls or self._answer is not None:
            said = "Another call takes steps; wait for its response."
            answer.set_result(StepSimulationResponse(Result(Result.INCORRECT_STATE, said)))
        else:
            self._calls.append((request.steps, answer))

"""A program that controls the steps of the simulation with the service ``step_simulation``.

It calls the service with a number of steps (`simulation_interfaces/srv/StepSimulation`). The
simulation takes these steps and then waits for the next call. The response is sent after the steps
and, if the transport keeps the order, after all messages of the steps. Messages that the program
sends before a call are published on the bus before the first step of the call.
"""

from __future__ import annotations

from collections import deque
from concurrent.futures import Future

from ...bus import Node
from ...errors import ClientLost, NeverStarted
from ...messages.simulation_control import MAX_STEPS, Result, StepSimulation, StepSimulationResponse
from ..bridge import Bridge
from .external_program import ExternalProgram
from .spec import ClientSpec

SERVICE = "step_simulation"
"""The name of the service."""


class StepClient(ExternalProgram):
    """One program that controls the steps; an algorithm in the sense of `uwsim.bus.Algorithm`.

    Args:
        bridge: the bridge of the program's transport.
        spec: the specification of the program, with its name and time limit.
        timestep: the step of the simulation [s].
    """

    def __init__(self, bridge: Bridge, spec: ClientSpec, *, timestep: float) -> None:
        super().__init__(bridge, spec)
        self._timestep = timestep
        self._calls: deque[tuple[int, Future[object]]] = deque()
        self._n_steps_left = 0
        self._answer: Future[object] | None = None

    def start(self, node: Node) -> None:
        """Wait for the first call.

        Raises:
            NeverStarted: there was no call within the limit.
        """
        self._node = node
        self._bridge.deferred_responses.offer(SERVICE, StepSimulation, self._accept_call)
        self._bridge.step()
        if not self._wait_for_call():
            raise NeverStarted(
                f"Client {self.name!r} has not called /{SERVICE} within {self._spec.limit:g} s of "
                "wall time (--client-limit)."
            )
        self._n_steps_left += 1  # the barrier before the first step ends no step
        node.create_timer(self._timestep, self._barrier)

    def _barrier(self) -> None:
        """End a step; if it was the last step of a call, respond and wait for the next call."""
        self._n_steps_left -= 1
        if self._n_steps_left > 0:
            return
        assert self._answer is not None
        self._answer.set_result(StepSimulationResponse())
        self._answer = None
        if not self._wait_for_call():
            raise ClientLost(
                f"Client {self.name!r} has not called /{SERVICE} at {self._node.now:g} s within "
                f"{self._spec.limit:g} s of wall time (--client-limit): the run is invalid."
            )

    def _wait_for_call(self) -> bool:
        """Wait for a call, then publish the messages sent before it; return whether it came."""
        bridge = self._bridge
        if not bridge.wait_for(lambda: bool(self._calls), self._spec.limit):
            return False
        self._n_steps_left, self._answer = self._calls.popleft()
        if self._spec.settle_time:
            bridge.wait_for(lambda: False, self._spec.settle_time)
        bridge.step()
        return True

    def _accept_call(self, request: object, answer: Future[object]) -> None:
        assert isinstance(request, StepSimulation)
        if not 1 <= request.steps <= MAX_STEPS:
            error = f"Expected 1 to {MAX_STEPS} steps."
            answer.set_result(StepSimulationResponse(Result(Result.OPERATION_FAILED, error)))
        elif self._calls or self._answer is not None:
            error = "Another call takes steps; wait for its response."
            answer.set_result(StepSimulationResponse(Result(Result.INCORRECT_STATE, error)))
        else:
            self._calls.append((request.steps, answer))

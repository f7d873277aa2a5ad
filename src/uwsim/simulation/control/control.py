"""Play, pause, step, reset and quit, by the services of ROS 2's simulation_interfaces.

The services are on the bus, so that every transport offers them. Their names have no prefix:
``/get_simulation_state``, ``/step_simulation`` and so on.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

from ...errors import UwsimError
from ...messages.simulation_control import (
    MAX_STEPS,
    GetSimulationState,
    GetSimulationStateResponse,
    GetSimulatorFeatures,
    GetSimulatorFeaturesResponse,
    ResetSimulation,
    ResetSimulationResponse,
    Result,
    SetSimulationState,
    SetSimulationStateResponse,
    SimulationState,
    SimulatorFeatures,
    StepSimulation,
    StepSimulationResponse,
)
from ..simulation import Simulation
from .entities import Entities

FEATURES = (
    SimulatorFeatures.SPAWNING,
    SimulatorFeatures.DELETING,
    SimulatorFeatures.ENTITY_STATE_GETTING,
    SimulatorFeatures.ENTITY_STATE_SETTING,
    SimulatorFeatures.SIMULATION_RESET,
    SimulatorFeatures.SIMULATION_STATE_GETTING,
    SimulatorFeatures.SIMULATION_STATE_SETTING,
    SimulatorFeatures.SIMULATION_STATE_PAUSE,
    SimulatorFeatures.STEP_SIMULATION_SINGLE,
    SimulatorFeatures.STEP_SIMULATION_MULTIPLE,
)
INFO = (
    "uwsim. Entities are vehicles and objects; poses are in the frame of the scene file. What is "
    "spawned is a marker: it has no mass and no camera sees it. A reset is of everything."
)
POLL_INTERVAL = 0.002
"""The period at which a paused simulation polls for calls of services [s of wall time]."""


class Quit(Exception):
    """An exception that ends the simulation at the request of an external program."""


class SimulationControl:
    """The services by which external programs control a simulation.

    `hold` is called at the end of each step, after the transports; it returns when the next step
    may begin.

    Args:
        simulation: the simulation to control.
        exchange: a function that answers the service calls on all transports during a pause.
    """

    def __init__(self, simulation: Simulation, exchange: Callable[[], None]) -> None:
        self._simulation, self._exchange = simulation, exchange
        self._state = SimulationState.PLAYING
        self._is_stepping = False
        self._start: bytes | None = None
        self._entities = Entities(simulation)
        bus = simulation.bus
        bus.services.serve("get_simulator_features", GetSimulatorFeatures, self._features)
        bus.services.serve("get_simulation_state", GetSimulationState, self._get_state)
        bus.services.serve("set_simulation_state", SetSimulationState, self._set_state)
        bus.services.serve("step_simulation", StepSimulation, self._step)
        bus.services.serve("reset_simulation", ResetSimulation, self._reset)
        self._entities.serve(bus)

    def begin(self) -> None:
        """Save the state that a reset restores; call this before the first step."""
        try:
            self._start = self._simulation.save()
        except UwsimError:
            self._start = None  # an algorithm is attached, whose state cannot be saved

    def hold(self) -> None:
        """Wait while the simulation is paused or stopped, and answer calls.

        Raises:
            Quit: an external program has requested it.
        """
        while not self._is_stepping and self._state != SimulationState.PLAYING:
            if self._state == SimulationState.QUITTING:
                raise Quit
            time.sleep(POLL_INTERVAL)
            self._exchange()

    def _features(self, _request: GetSimulatorFeatures) -> GetSimulatorFeaturesResponse:
        return GetSimulatorFeaturesResponse(
            SimulatorFeatures(
                features=np.array(FEATURES, dtype=np.uint16),
                spawn_formats=["obj", "stl", "dae"],
                custom_info=INFO,
            )
        )

    def _get_state(self, _request: GetSimulationState) -> GetSimulationStateResponse:
        return GetSimulationStateResponse(state=SimulationState(self._state))

    def _set_state(self, request: SetSimulationState) -> SetSimulationStateResponse:
        requested_state, states = request.state.state, SimulationState
        if requested_state not in (states.STOPPED, states.PLAYING, states.PAUSED, states.QUITTING):
            return SetSimulationStateResponse(
                Result(Result.OPERATION_FAILED, f"There is no state {requested_state}.")
            )
        if requested_state == self._state:
            code = SetSimulationStateResponse.ALREADY_IN_TARGET_STATE
            return SetSimulationStateResponse(Result(code, "It is in that state."))
        if requested_state == states.STOPPED:
            failure = self._restore_start()
            if failure is not None:
                return SetSimulationStateResponse(failure)
        self._state = requested_state
        return SetSimulationStateResponse()

    def _step(self, request: StepSimulation) -> StepSimulationResponse:
        if self._state != SimulationState.PAUSED or self._is_stepping:
            message = "Steps are taken while the simulation is paused."
            return StepSimulationResponse(Result(Result.INCORRECT_STATE, message))
        if request.steps > MAX_STEPS:
            message = f"At most {MAX_STEPS} steps."
            return StepSimulationResponse(Result(Result.OPERATION_FAILED, message))
        self._is_stepping = True
        try:
            for _ in range(request.steps):
                self._simulation.advance()
        finally:
            self._is_stepping = False
        return StepSimulationResponse()

    def _reset(self, request: ResetSimulation) -> ResetSimulationResponse:
        if request.scope not in (ResetSimulation.SCOPE_DEFAULT, ResetSimulation.SCOPE_ALL):
            message = "Everything is reset, or nothing: scope 0 or 255."
            return ResetSimulationResponse(Result(Result.FEATURE_UNSUPPORTED, message))
        return ResetSimulationResponse(self._restore_start() or Result())

    def _restore_start(self) -> Result | None:
        """Restore the state at the start; return an error if that state could not be saved."""
        if self._start is None:
            message = "An algorithm is attached, whose state cannot be reset."
            return Result(Result.FEATURE_UNSUPPORTED, message)
        self._simulation.restore(self._start)
        return None

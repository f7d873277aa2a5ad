"""Many simulations of free vehicles: loops of `free_step` over rows, without Python between steps.

Rows are independent, so that the bytes of a row depend neither on the number of rows nor on their
order.
"""

from __future__ import annotations

import numpy as np

from ....base.numerics.jit import njit
from ....base.numerics.memory import Floats
from ..columns import WATER_COLUMNS
from .free_step import (
    ACTUATORS,
    ROTOR,
    WORK,
    FreeVehicle,
    advance_actuators,
    fill_rotors,
    step_one,
)


@njit
def simulate_rows(
    vehicle: FreeVehicle, states: Floats, commands: Floats, water: Floats, h: float, path: Floats
) -> None:
    """Simulate one vehicle from several initial states.

    Args:
        vehicle: the numbers of the vehicle.
        states: the initial states, (rows, `ACTUATORS` + k), which become the final states.
        commands: the commands of each row and step, (rows, n, k).
        water: the water, the same for all rows and steps (`columns`), (12,).
        h: the length of a step [s].
        path: receives the motion of each row before the first and after every step,
            (rows, n + 1, `ACTUATORS`).
    """
    work, rotors = np.empty(WORK), np.zeros((len(vehicle.actuators), ROTOR))
    fill_rotors(vehicle, h, rotors)
    waters = np.empty((len(vehicle.bodies) + 1, WATER_COLUMNS))
    for i in range(len(waters)):
        for k in range(WATER_COLUMNS):
            waters[i, k] = water[k]
    for row in range(len(states)):
        state = states[row]
        for k in range(ACTUATORS):
            path[row, 0, k] = state[k]
        for i in range(commands.shape[1]):
            step_one(vehicle, rotors, state, commands[row, i], waters, h, work)
            for k in range(ACTUATORS):
                path[row, i + 1, k] = state[k]


@njit
def simulate_actuators(
    vehicle: FreeVehicle, state: Floats, commands: Floats, h: float, path: Floats
) -> None:
    """Simulate the rotors and fins of a vehicle alone.

    Args:
        vehicle: the numbers of the vehicle.
        state: the initial state, (`ACTUATORS` + k,), which becomes the final state.
        commands: the commands of each step, (n, k).
        h: the length of a step [s].
        path: receives the states of the actuators before the first and after every step,
            (n + 1, k).
    """
    rotors = np.zeros((len(vehicle.actuators), ROTOR))
    fill_rotors(vehicle, h, rotors)
    for i in range(len(commands)):
        for k in range(path.shape[1]):
            path[i, k] = state[ACTUATORS + k]
        advance_actuators(vehicle, rotors, state, commands[i], h)
    for k in range(path.shape[1]):
        path[len(commands), k] = state[ACTUATORS + k]

"""The loops over rows: resets and steps, with observations and rewards, without Python.

Rows are independent, so that the bytes of a row depend neither on the number of rows nor on the
number of threads that share them.
"""

from __future__ import annotations

import math

import numpy as np

from ...base.numerics.draws import uniform
from ...base.numerics.jit import njit, njit_borrowed
from ...base.numerics.memory import Floats
from ...physics.hydrodynamics.kernel.free_step import (
    ACTUATORS,
    LOSS,
    WORK,
    FreeVehicle,
    fill_rotors,
    step_one,
    write_axes,
)
from . import columns as c
from .arrays import Flags, RowArrays, TaskNumbers
from .channels import Situation, observe
from .errors import distance
from .flows import FUNCTION, RowFlows, move_water
from .rewards import reward_of
from .trajectories import fill_goal
from .variation import vary_vehicle, vehicle_of_row

_MAX_SPEEDS = 1e3
"""The sum of speeds [m/s, rad/s] beyond which a simulation has diverged."""
SCRATCH = 9 + 2 * c.GOAL_COLUMNS
"""The length of the scratch memory of a row."""


@njit
def reset_rows(
    first: int,
    end: int,
    mask: Flags,
    nominal_vehicle: FreeVehicle,
    vehicles: FreeVehicle,
    is_varied: bool,
    task: TaskNumbers,
    rows: RowArrays,
    levels: Floats,
) -> None:
    """Begin new episodes of some rows: draw the parameters, place the vehicles, observe.

    Every parameter takes one number of the row's stream, whether or not its level is given.

    Args:
        first: the first row.
        end: the end of the rows.
        mask: true for the rows to reset, (n,).
        nominal_vehicle: the nominal vehicle.
        vehicles: one vehicle for all rows, or one for each.
        is_varied: true if there is one for each.
        task: the numbers of the task.
        rows: the arrays of the rows.
        levels: the values of the parameters, NaN for those to draw, (n, p).
    """
    scratch = np.empty(SCRATCH)
    for row in range(first, end):
        if not mask[row]:
            continue
        parameters = rows.parameters[row]
        for k in range(len(parameters)):
            low, high = task.ranges[k, 0], task.ranges[k, 1]
            value = low + (high - low) * uniform(rows.streams[row])
            level = levels[row, k]
            parameters[k] = value if level != level else level
        if is_varied:
            vary_vehicle(nominal_vehicle, parameters, vehicle_of_row(vehicles, row))
        vehicle = vehicle_of_row(vehicles, row if is_varied else 0)
        fill_rotors(vehicle, task.timestep, rows.rotors[row])
        _place_row(task, rows, row, scratch)
        _observe_row(task, rows, row, scratch)


@njit_borrowed
def _place_row(task: TaskNumbers, rows: RowArrays, row: int, scratch: Floats) -> None:
    """Place the vehicle of a row at its start, at rest over ground, with all sums at zero."""
    parameters, state, origin = rows.parameters[row], rows.states[row], rows.origins[row]
    goal = scratch[9 : 9 + c.GOAL_COLUMNS]
    for i in range(c.ORIGIN_COLUMNS):
        origin[i] = task.origin[i]
    origin[c.PHASE] += parameters[c.START_PHASE]
    fill_goal(task.trajectory, origin, 0.0, goal)
    for i in range(len(state)):
        state[i] = 0.0
    for i in range(3):
        state[i] = goal[i] + parameters[c.START + i]
    n, m = math.cos(0.5 * parameters[c.START_YAW]), math.sin(0.5 * parameters[c.START_YAW])
    k = c.GOAL_ATTITUDE
    state[3], state[4] = n * goal[k] - m * goal[k + 3], n * goal[k + 1] - m * goal[k + 2]
    state[5], state[6] = n * goal[k + 2] + m * goal[k + 1], n * goal[k + 3] + m * goal[k]
    speed, heading = parameters[c.CURRENT_SPEED], parameters[c.CURRENT_HEADING]
    for i in range(rows.water.shape[1]):
        for j in range(rows.water.shape[2]):
            rows.water[row, i, j] = 0.0
        rows.water[row, i, 0] = speed * math.cos(heading)
        rows.water[row, i, 1] = speed * math.sin(heading)
    for i in range(rows.rotors.shape[1]):
        is_lost = parameters[c.LOST_THRUSTER] >= 0.0 and int(parameters[c.LOST_THRUSTER]) == i
        rows.rotors[row, i, LOSS] = parameters[c.LOSS] if is_lost else 0.0
    past_actions, tally = rows.past_actions[row], rows.tallies[row]
    for i in range(past_actions.shape[0]):
        for j in range(past_actions.shape[1]):
            past_actions[i, j] = 0.0
    for i in range(len(tally)):
        tally[i] = 0.0
    rows.steps[row], rows.rewards[row] = 0, 0.0
    rows.terminated[row] = rows.truncated[row] = rows.successes[row] = False


@njit
def step_rows(
    first: int,
    end: int,
    mask: Flags,
    vehicles: FreeVehicle,
    is_varied: bool,
    task: TaskNumbers,
    rows: RowArrays,
    actions: Floats,
    flows: RowFlows | None,
) -> None:
    """Take a step of the environment with some rows.

    Args:
        first: the first row.
        end: the end of the rows.
        mask: true for the rows to step, (n,).
        vehicles: one vehicle for all rows, or one for each.
        is_varied: true if there is one for each.
        task: the numbers of the task.
        rows: the arrays of the rows.
        actions: the actions from -1 to 1, (n, a).
        flows: the water that moves at the rows; None: the water remains as it is.
    """
    work, scratch = np.empty(WORK), np.empty(SCRATCH)
    commands = np.empty(len(task.mixing))
    for row in range(first, end):
        if not mask[row]:
            continue
        vehicle = vehicle_of_row(vehicles, row if is_varied else 0)
        step_row(row, vehicle, task, rows, actions[row], commands, work, scratch, flows)


@njit_borrowed
def step_row(
    row: int,
    vehicle: FreeVehicle,
    task: TaskNumbers,
    rows: RowArrays,
    action: Floats,
    commands: Floats,
    work: Floats,
    scratch: Floats,
    flows: RowFlows | None,
) -> None:
    """Take a step of the environment with one row.

    Args:
        row: the index of the row.
        vehicle: the numbers of its vehicle.
        task: the numbers of the task.
        rows: the arrays of the rows.
        action: the action from -1 to 1, (a,).
        commands: scratch memory for the commands, (k,).
        work: scratch memory, (`free_step.WORK`,).
        scratch: scratch memory, (`SCRATCH`,).
        flows: the water that moves at the rows; None: the water remains as it is.
    """
    effort, change = _take_action(task, rows, row, action, commands)
    state, rotors, water = rows.states[row], rows.rotors[row], rows.water[row]
    h, n = task.timestep, rows.steps[row] * task.substeps
    for i in range(task.substeps):
        if flows is not None and flows.functions[row, FUNCTION] != 0:
            move_water(flows, row, vehicle, state, water, (n + i + 1) * h - 0.5 * h, work)
        step_one(vehicle, rotors, state, commands, water, h, work)
    rows.steps[row] += 1
    _observe_row(task, rows, row, scratch)
    _score_row(task, rows, row, effort, change, scratch[9 : 9 + c.GOAL_COLUMNS])


@njit_borrowed
def _take_action(
    task: TaskNumbers, rows: RowArrays, row: int, action: Floats, commands: Floats
) -> tuple[float, float]:
    """Store an action, and compute the commands of the action that is due.

    Returns:
        The mean squares of the actions and of their changes.
    """
    past_actions = rows.past_actions[row]
    n = len(action)
    effort, change = 0.0, 0.0
    delay = min(max(int(rows.parameters[row, c.DELAY]), 0), c.MAX_DELAY)
    for j in range(n):
        for i in range(delay, 0, -1):
            past_actions[i, j] = past_actions[i - 1, j]
        value = action[j]
        value = min(max(value, -1.0), 1.0) if value == value else 0.0
        last_value = past_actions[1, j] if delay > 0 else past_actions[0, j]
        past_actions[0, j] = value
        effort += value * value
        change += (value - last_value) * (value - last_value)
    for k in range(len(commands)):
        command = 0.0
        for j in range(n):
            command += task.mixing[k, j] * past_actions[delay, j]
        commands[k] = command
    return effort / n, change / n


@njit_borrowed
def _observe_row(task: TaskNumbers, rows: RowArrays, row: int, scratch: Floats) -> None:
    """Compute the goal of a row at the present time, and its observation."""
    state, goal = rows.states[row], scratch[9 : 9 + c.GOAL_COLUMNS]
    time = rows.steps[row] * task.substeps * task.timestep
    fill_goal(task.trajectory, rows.origins[row], time, goal)
    write_axes(state, scratch[:9])
    situation = Situation(
        state, scratch[:9], goal, rows.origins[row], rows.past_actions[row, 0],
        rows.water[row, rows.water.shape[1] - 1], scratch[9 + c.GOAL_COLUMNS :],
    )  # fmt: skip
    observe(task.channels, task.trajectory, situation, time, rows.observations[row])


@njit_borrowed
def _score_row(
    task: TaskNumbers, rows: RowArrays, row: int, effort: float, change: float, goal: Floats
) -> None:
    """Compute the reward of a step, the sums of the episode, and whether it ends."""
    state, tally = rows.states[row], rows.tallies[row]
    error = distance(state, goal)
    has_left = not error <= task.exit_distance or has_diverged(state)
    tally[c.N_INSIDE] = tally[c.N_INSIDE] + 1.0 if error <= task.tolerance else 0.0
    has_succeeded = tally[c.N_INSIDE] == float(task.hold_steps) and not rows.successes[row]
    if has_succeeded:
        rows.successes[row] = True
    reward = reward_of(task.terms, state, goal, error, (effort, change), has_succeeded, has_left)
    if reward != reward:
        reward = 0.0
    tally[c.SUM_OF_REWARDS] += reward
    tally[c.SUM_OF_ERRORS] += error
    tally[c.SUM_OF_SQUARES] += error * error
    tally[c.MAX_ERROR] = max(tally[c.MAX_ERROR], error)
    tally[c.LAST_ERROR] = error
    tally[c.SUM_OF_EFFORT] += effort
    rows.rewards[row] = reward
    rows.terminated[row] = has_left or (task.ends_on_success and rows.successes[row])
    rows.truncated[row] = not rows.terminated[row] and rows.steps[row] >= task.max_steps


@njit_borrowed
def has_diverged(state: Floats) -> bool:
    """Return whether a velocity is not finite, or too large to be that of a vehicle."""
    total = 0.0
    for i in range(7, ACTUATORS):
        total += abs(state[i])
    return not total <= _MAX_SPEEDS

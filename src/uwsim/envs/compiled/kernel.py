"""The compiled loops over episodes: beginning, physics, measures, observations and rewards.

The formulas are those of `benchmark.environment` and of the measures; the water and the vehicle
are those of `envs.batch`. A row depends neither on other rows nor on the number of threads.
"""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import write_quaternion, write_rotation
from ...base.numerics.jit import njit, njit_borrowed
from ...base.numerics.memory import Floats, Ints64
from ...benchmark.environment.observer import MAX_OBSERVATION
from ...benchmark.environment.program import MAX_STACK, run
from ...physics.actuation.power_kernel import thruster_power
from ...physics.hydrodynamics import columns as h
from ...physics.hydrodynamics.kernel.equations import to_body
from ...physics.hydrodynamics.kernel.flow import submerged_share
from ...physics.hydrodynamics.kernel.free_step import (
    ACTUATORS,
    LOSS,
    WORK,
    FreeVehicle,
    step_one,
    write_axes,
)
from ...physics.hydrodynamics.kernel.thrusters import static_thrust
from ..batch.arrays import RowArrays
from ..batch.flows import FUNCTION, RowFlows, move_water
from ..batch.loops import has_diverged
from ..batch.variation import vehicle_of_row
from . import numbers as c
from .numbers import EpisodeArrays, Flags, TaskNumbers


@njit
def begin_episodes(
    rows: Ints64,
    starts: Floats,
    vehicles: FreeVehicle,
    is_varied: bool,
    task: TaskNumbers,
    physics: RowArrays,
    episodes: EpisodeArrays,
) -> None:
    """Place the vehicles of rows that were reset, take the first samples, and observe.

    Args:
        rows: the indices of the rows, (k,).
        starts: the position of each vehicle in L [m], and its angles in UWSim's order for
            vehicles, ``Rx Ry Rz`` [rad], (k, 6).
        vehicles: one vehicle for all rows, or one for each.
        is_varied: true if there is one for each.
        task: the numbers of the task.
        physics: the states of the vehicles.
        episodes: the arrays of the episodes.
    """
    axes = np.empty(9)
    rotation, attitude = np.empty((3, 3)), np.empty((3, 3))
    frame = task.localized_from_world
    for i in range(len(rows)):
        row, start = rows[i], starts[i]
        state = physics.states[row]
        write_rotation(-start[3], -start[4], -start[5], rotation)  # the inverse of Rx Ry Rz
        for j in range(3):
            state[j] = 0.0
            for k in range(3):
                state[j] += frame[3 * k + j] * (start[k] - frame[9 + k])
                attitude[j, k] = 0.0
                for m in range(3):
                    attitude[j, k] += frame[3 * m + j] * rotation[k, m]
        write_quaternion(attitude, state[3:7])
        write_axes(state, axes)
        for j in range(3):
            episodes.down[row, j] = -axes[6 + j]
        for j in range(episodes.last_actions.shape[1]):
            episodes.last_actions[row, j] = 0.0
        for m in range(episodes.statistics.shape[1]):
            for k in range(c.STATISTICS):
                episodes.statistics[row, m, k] = 0.0
        episodes.steps[row] = 0
        episodes.rewards[row] = 0.0
        episodes.terminated[row] = episodes.truncated[row] = False
        vehicle = vehicle_of_row(vehicles, row if is_varied else 0)
        _measure(row, vehicle, task, physics, episodes)
        _observe(row, axes, task, physics, episodes)


@njit
def step_episodes(
    first: int,
    end: int,
    mask: Flags,
    vehicles: FreeVehicle,
    is_varied: bool,
    task: TaskNumbers,
    physics: RowArrays,
    episodes: EpisodeArrays,
    actions: Floats,
    flows: RowFlows | None,
) -> None:
    """Apply an action in some rows for one period, or until the episode ends.

    Rows without a step have the reward 0.

    Args:
        first: the first row.
        end: the end of the rows.
        mask: true for the rows to step, (n,).
        vehicles: one vehicle for all rows, or one for each.
        is_varied: true if there is one for each.
        task: the numbers of the task.
        physics: the states of the vehicles.
        episodes: the arrays of the episodes.
        actions: the actions, which are limited to -1 to 1, (n, a).
        flows: the water that moves at the rows; None: the water remains as it is.
    """
    n_actions, n_measures = actions.shape[1], len(task.measures)
    work, axes, stack = np.empty(WORK), np.empty(9), np.empty(MAX_STACK)
    values, commands = np.empty(n_measures + 6), np.empty(n_actions)
    last_state = np.empty(physics.states.shape[1])
    for row in range(first, end):
        episodes.rewards[row] = 0.0
        episodes.terminated[row] = episodes.truncated[row] = False
        if not mask[row]:
            continue
        vehicle = vehicle_of_row(vehicles, row if is_varied else 0)
        for j in range(n_actions):
            commands[j] = min(max(actions[row, j], -1.0), 1.0)
        for j in range(len(last_state)):
            last_state[j] = physics.states[row, j]
        _advance(row, vehicle, task, physics, episodes, commands, work, flows)
        if has_diverged(physics.states[row]):
            episodes.terminated[row] = True
            for j in range(len(last_state)):
                physics.states[row, j] = last_state[j]
        write_axes(physics.states[row], axes)
        _fill_values(row, axes, task, physics, episodes, commands, values)
        reward = run(task.reward, values, stack)
        if math.isfinite(reward) and not episodes.terminated[row]:
            episodes.rewards[row] = reward
        for j in range(n_actions):
            episodes.last_actions[row, j] = commands[j]
        _observe(row, axes, task, physics, episodes)
        is_over = episodes.steps[row] >= task.n_steps
        episodes.truncated[row] = is_over and not episodes.terminated[row]


@njit_borrowed
def _advance(
    row: int,
    vehicle: FreeVehicle,
    task: TaskNumbers,
    physics: RowArrays,
    episodes: EpisodeArrays,
    commands: Floats,
    work: Floats,
    flows: RowFlows | None,
) -> None:
    """Take the physics steps of a period, with a sample of each measure after each step."""
    state, rotors, water = physics.states[row], physics.rotors[row], physics.water[row]
    dt = task.timestep
    for _ in range(min(task.substeps, task.n_steps - episodes.steps[row])):
        if flows is not None and flows.functions[row, FUNCTION] != 0:
            time = (episodes.steps[row] + 1) * dt - 0.5 * dt
            move_water(flows, row, vehicle, state, water, time, work)
        step_one(vehicle, rotors, state, commands, water, dt, work)
        episodes.steps[row] += 1
        _measure(row, vehicle, task, physics, episodes)


@njit_borrowed
def _measure(
    row: int, vehicle: FreeVehicle, task: TaskNumbers, physics: RowArrays, episodes: EpisodeArrays
) -> None:
    """Take a sample of each measure."""
    state, k = physics.states[row], episodes.steps[row]
    last_power = episodes.powers[row]
    if len(task.powers) > 0:
        episodes.powers[row] = _power(vehicle, task.powers, physics, row)
    for m in range(len(task.measures)):
        values = episodes.statistics[row, m]
        if task.measures[m] == c.ENERGY:
            mean_power = task.hotel_loads[m] + 0.5 * (last_power + episodes.powers[row])
            values[c.LAST_SAMPLE] += mean_power * task.timestep if k > 0 else 0.0
            continue
        place = task.places[m, k]
        x, y, z = state[0] - place[0], state[1] - place[1], state[2] - place[2]
        square = x * x + y * y + z * z
        sample = math.sqrt(square)
        values[c.LAST_SAMPLE] = sample
        values[c.MEAN] += (sample - values[c.MEAN]) / (k + 1.0)
        values[c.SQUARES] += square
        values[c.MAX] = max(values[c.MAX], sample)


@njit_borrowed
def _power(vehicle: FreeVehicle, tables: Floats, physics: RowArrays, row: int) -> float:
    """Return the electric power of the thrusters in still water (`power_kernel.thrusts`) [W]."""
    state, rotors, water = physics.states[row], physics.rotors[row], physics.water[row]
    w, x, y, z = state[3], state[4], state[5], state[6]
    a, b = 2.0 * (x * z - w * y), 2.0 * (y * z + w * x)
    d = w * w - x * x - y * y + z * z
    power = 0.0
    for i in range(len(tables)):
        table, site, link = vehicle.actuators[i], vehicle.sites[i], vehicle.actuator_links[i]
        level = vehicle.world[h.SURFACE] + water[link if link >= 0 else -1, h.ELEVATION]
        height = state[2] + a * site[0] + b * site[1] + d * site[2]
        command = min(max(state[ACTUATORS + i], vehicle.limits[i, 0]), vehicle.limits[i, 1])
        thrust = (1.0 - rotors[i, LOSS]) * static_thrust(table, command)
        thrust *= submerged_share(level, height, table[h.RADIUS])
        power += thruster_power(tables[i], thrust)
    return power


@njit_borrowed
def _fill_values(
    row: int,
    axes: Floats,
    task: TaskNumbers,
    physics: RowArrays,
    episodes: EpisodeArrays,
    action: Floats,
    values: Floats,
) -> None:
    """Write the numbers of the reward: the samples, then effort ... time (`reward`)."""
    state, last_action, n = physics.states[row], episodes.last_actions[row], len(action)
    k = len(task.measures)
    for m in range(k):
        values[m] = episodes.statistics[row, m, c.LAST_SAMPLE]
    effort, change = 0.0, 0.0
    for j in range(n):
        effort += action[j] * action[j]
        change += (action[j] - last_action[j]) * (action[j] - last_action[j])
    u, v, w = state[7], state[8], state[9]
    p, q, r = state[10], state[11], state[12]
    down = episodes.down[row]
    cosine = -(down[0] * axes[6] + down[1] * axes[7] + down[2] * axes[8])
    values[k], values[k + 1] = effort / n, change / n
    values[k + 2] = math.sqrt(u * u + v * v + w * w)
    values[k + 3] = math.sqrt(p * p + q * q + r * r)
    values[k + 4] = math.acos(min(max(cosine, -1.0), 1.0))
    values[k + 5] = episodes.steps[row] * task.timestep


@njit_borrowed
def _observe(
    row: int, axes: Floats, task: TaskNumbers, physics: RowArrays, episodes: EpisodeArrays
) -> None:
    """Write the observation of a row, limited to `MAX_OBSERVATION`."""
    state, out, step = physics.states[row], episodes.observations[row], episodes.steps[row]
    frame = task.localized_from_world
    for i in range(len(task.channels)):
        code, j = task.channels[i, 0], task.channels[i, 1]
        if code == c.HEADING:
            for k in range(2):
                a, b, d = frame[3 * k], frame[3 * k + 1], frame[3 * k + 2]
                out[j + k] = a * axes[0] + b * axes[3] + d * axes[6]
            continue
        if code == c.LAST_ACTION:
            for k in range(episodes.last_actions.shape[1]):
                out[j + k] = episodes.last_actions[row, k]
            continue
        x, y, z = 0.0, 0.0, -1.0  # gravity
        if code == c.POSITION_ERROR:
            place = task.places[task.reference, step]
            x, y, z = place[0] - state[0], place[1] - state[1], place[2] - state[2]
        elif code == c.REFERENCE_VELOCITY:
            speed = task.reference_velocity[step]
            x, y, z = speed[0], speed[1], speed[2]
        elif code == c.LINEAR_VELOCITY:
            x, y, z = state[7], state[8], state[9]
        if code == c.POSITION:
            for k in range(3):
                a, b, d = frame[3 * k], frame[3 * k + 1], frame[3 * k + 2]
                out[j + k] = a * state[0] + b * state[1] + d * state[2] + frame[9 + k]
        elif code == c.ANGULAR_VELOCITY:
            out[j], out[j + 1], out[j + 2] = state[10], state[11], state[12]
        else:
            out[j], out[j + 1], out[j + 2] = to_body(axes, x, y, z)
    for j in range(len(out)):
        out[j] = min(max(out[j], -MAX_OBSERVATION), MAX_OBSERVATION)

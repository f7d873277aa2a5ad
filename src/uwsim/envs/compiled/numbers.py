"""The numbers of a benchmark's task that compiled rows read, and the arrays that they write."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ...base.expression import parse
from ...base.geometry import Array, Pose
from ...base.numerics.memory import Floats, Ints64
from ...benchmark.environment.channels import CHANNELS
from ...benchmark.environment.program import Program, compile_program
from ...benchmark.environment.reward import REWARD_NAMES
from ...benchmark.measures import EnergySpec, MeasureSpec, PositionErrorSpec, TrackingErrorSpec
from ...benchmark.reference_trajectory import TrajectorySpec
from ...physics.actuation.power import power_table
from ...scene.hydrodynamics.spec import ThrusterSpec
from ..row_task import ROW_CHANNELS, RowPlan

Flags = npt.NDArray[np.bool_]
(
    POSITION_ERROR, REFERENCE_VELOCITY, POSITION, HEADING, GRAVITY, LINEAR_VELOCITY,
    ANGULAR_VELOCITY, LAST_ACTION,
) = range(8)  # fmt: skip
"""The codes of the observed quantities, in the order of `ROW_CHANNELS`."""
DISTANCE, ENERGY = 0, 1
"""The kinds of measures."""
LAST_SAMPLE, MEAN, SQUARES, MAX, STATISTICS = range(5)
"""The columns of the statistics of a measure: the newest sample, the mean, the sum of squares and
the greatest sample of an episode; and their number."""


class TaskNumbers(NamedTuple):
    """The numbers of a task, the same for all rows."""

    channels: Ints64
    """The code of each observed quantity, and the index of its first number, (c, 2)."""
    measures: Ints64
    """The kind of each measure, (m,)."""
    places: Floats
    """The desired positions of the measures after each physics step, in W, (m, n + 1, 3) [m]."""
    hotel_loads: Floats
    """The constant power of each measure of energy, (m,) [W]."""
    reference: int
    """The index of the measure that has the observed desired position; -1: there is none."""
    reference_velocity: Floats
    """The velocity of the observed desired position in W, (n + 1, 3) [m/s]."""
    powers: Floats
    """The tables of `thruster_power`, (k, 2, 1 + q); no row without a measure of energy."""
    localized_from_world: Floats
    """The rotation from W to L by rows, and the position of W's origin in L, (12,)."""
    reward: Program
    """The reward: a program of the newest samples of the measures, then of `REWARD_NAMES`."""
    timestep: float
    """The length of a physics step [s]."""
    substeps: int
    """The number of physics steps in a period."""
    n_steps: int
    """The number of physics steps in an episode."""


class EpisodeArrays(NamedTuple):
    """The episodes of the rows, and what a step computes for each of them."""

    statistics: Floats
    """The statistics of the measures, (n, m, `STATISTICS`)."""
    powers: Floats
    """The electric power of the thrusters after the last physics step, (n,) [W]."""
    down: Floats
    """The direction of gravity in base axes when the episode began, (n, 3)."""
    last_actions: Floats
    """The last actions, (n, a)."""
    steps: Ints64
    """The numbers of physics steps since the episodes began, (n,)."""
    observations: Floats
    """The observations, (n, o)."""
    rewards: Floats
    """The rewards of the last step, (n,)."""
    terminated: Flags
    """The rows whose simulation has failed in the last step, (n,)."""
    truncated: Flags
    """The rows whose time is over after the last step, (n,)."""


def task_numbers(task: RowPlan) -> TaskNumbers:
    """Return the numbers of a task."""
    steps: Array = np.arange(task.n_steps + 1, dtype=np.float64)
    times: Array = steps * task.plan.timestep
    rotation = task.world_from_localized.rotation
    places = np.zeros((len(task.measures), len(times), 3))
    for i, measure in enumerate(task.measures):
        if (trajectory := trajectory_of(measure)) is not None:
            positions = trajectory.position(times)
            places[i] = _turn(rotation, positions) + task.world_from_localized.position
    names = [measure.name for measure in task.measures]
    reference = names.index(task.spec.reference) if task.spec.reference is not None else -1
    velocity = np.zeros((len(times), 3))
    if reference >= 0 and (trajectory := trajectory_of(task.measures[reference])) is not None:
        velocity = _turn(rotation, trajectory.velocity(times))
    energies = [measure for measure in task.measures if isinstance(measure, EnergySpec)]
    reward = parse(task.spec.reward, [*names, *REWARD_NAMES])
    return TaskNumbers(
        channels=channel_table(task.spec.channels, len(task.vehicle.actuators)),
        measures=np.array(
            [ENERGY if measure in energies else DISTANCE for measure in task.measures], np.int64
        ),
        places=places,
        hotel_loads=np.array([getattr(measure, "hotel_load", 0.0) for measure in task.measures]),
        reference=reference,
        reference_velocity=velocity,
        powers=power_tables(task.thrusters if energies else (), task.vehicle.density),
        localized_from_world=_row_of(task.world_from_localized.inverse()),
        reward=compile_program(reward, [*names, *REWARD_NAMES]),
        timestep=task.plan.timestep,
        substeps=task.substeps,
        n_steps=task.n_steps,
    )


def make_arrays(n: int, numbers: TaskNumbers, n_actions: int, n_observations: int) -> EpisodeArrays:
    """Return the arrays of n rows."""
    return EpisodeArrays(
        statistics=np.zeros((n, len(numbers.measures), STATISTICS)),
        powers=np.zeros(n),
        down=np.zeros((n, 3)),
        last_actions=np.zeros((n, n_actions)),
        steps=np.zeros(n, np.int64),
        observations=np.zeros((n, n_observations)),
        rewards=np.zeros(n),
        terminated=np.zeros(n, np.bool_),
        truncated=np.zeros(n, np.bool_),
    )


def trajectory_of(measure: MeasureSpec) -> TrajectorySpec | None:
    """Return the desired position of a measure; None if it has none."""
    if isinstance(measure, TrackingErrorSpec):
        return measure.trajectory
    if isinstance(measure, PositionErrorSpec):
        return TrajectorySpec(shape="point", centre=measure.position)
    return None


def channel_table(names: Sequence[str], n_actions: int) -> Ints64:
    """Return the code and the first index of each observed quantity, (c, 2)."""
    rows, offset = [], 0
    for name in names:
        rows.append((ROW_CHANNELS.index(name), offset))
        offset += CHANNELS[name][0] or n_actions
    return np.array(rows, dtype=np.int64).reshape(-1, 2)


def power_tables(thrusters: Sequence[ThrusterSpec], density: float) -> Array:
    """Return the tables of `thruster_power` of some thrusters, (k, 2, 1 + q)."""
    n_terms = max((power_table(spec, density).shape[1] - 1 for spec in thrusters), default=0)
    tables = [power_table(spec, density, n_terms) for spec in thrusters]
    return np.array(tables, dtype=np.float64).reshape(-1, 2, 1 + n_terms)


def _turn(rotation: Array, vectors: Array) -> Array:
    """Return ``rotation @ vector`` for vectors (n, 3)."""
    result: Array = np.sum(rotation * vectors[:, None, :], axis=-1)
    return result


def _row_of(pose: Pose) -> Array:
    return np.concatenate([pose.rotation.ravel(), pose.position])

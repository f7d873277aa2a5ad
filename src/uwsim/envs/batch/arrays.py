"""The arrays of rows that compiled code reads and writes, one row for each vehicle."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ...base.numerics.draws import STREAM
from ...base.numerics.memory import Floats, Ints64
from ...physics.hydrodynamics.columns import WATER_COLUMNS
from ...physics.hydrodynamics.kernel.free_step import ACTUATORS, ROTOR, FreeVehicle
from . import columns as c
from .channels import Singles

Flags = npt.NDArray[np.bool_]


class TaskNumbers(NamedTuple):
    """The numbers of a task, the same for all rows."""

    channels: Floats
    """The table of observations (`columns`), (c, 4)."""
    terms: Floats
    """The table of rewards (`columns`), (m, 3)."""
    trajectory: Floats
    """The row of the trajectory (`columns`), (9,)."""
    origin: Floats
    """The origin of all rows (`columns`), (5,)."""
    ranges: Floats
    """The least and the greatest value of each parameter (`columns`), (p, 2)."""
    mixing: Floats
    """The commands of the actuators per action, (k, a)."""
    timestep: float
    """The length of a physics step [s]."""
    substeps: int
    """The number of physics steps in a step of the environment."""
    max_steps: int
    """The number of steps after which an episode is truncated."""
    exit_distance: float
    """The distance from the goal at which an episode ends [m]."""
    tolerance: float
    """The distance from the goal within which a row is at the goal [m]."""
    hold_steps: int
    """The number of successive steps at the goal after which a row succeeds."""
    ends_on_success: bool
    """True if an episode ends when its row succeeds."""


class RowArrays(NamedTuple):
    """The state of the rows, and what a step computes for each of them."""

    states: Floats
    """The states of the vehicles (`free_step`), (n, 13 + k)."""
    rotors: Floats
    """The rotors of the thrusters (`free_step`), (n, k, 3)."""
    water: Floats
    """The water at the links and the base of each vehicle (`free_step`), (n, links + 1, 12)."""
    origins: Floats
    """The origins of the trajectories (`columns`), (n, 5)."""
    parameters: Floats
    """The parameters of the episodes (`columns`), (n, p)."""
    past_actions: Floats
    """The last actions, the newest first, (n, `MAX_DELAY` + 1, a)."""
    tallies: Floats
    """The sums over the episodes (`columns`), (n, 7)."""
    steps: Ints64
    """The number of steps since the episodes began, (n,)."""
    streams: npt.NDArray[np.void]
    """The random streams of the rows, (n,)."""
    observations: Singles
    """The observations, (n, o)."""
    rewards: Floats
    """The rewards of the last step, (n,)."""
    terminated: Flags
    """The rows that left the region of the task, or whose task ends on success, (n,)."""
    truncated: Flags
    """The rows whose time is over, (n,)."""
    successes: Flags
    """The rows that have succeeded in this episode, (n,)."""


def make_arrays(
    n: int, n_links: int, n_actuators: int, n_actions: int, n_observations: int
) -> RowArrays:
    """Return the arrays of n rows."""
    return RowArrays(
        states=np.zeros((n, ACTUATORS + n_actuators)),
        rotors=np.zeros((n, n_actuators, ROTOR)),
        water=np.zeros((n, n_links + 1, WATER_COLUMNS)),
        origins=np.zeros((n, c.ORIGIN_COLUMNS)),
        parameters=np.zeros((n, len(c.PARAMETERS))),
        past_actions=np.zeros((n, c.MAX_DELAY + 1, n_actions)),
        tallies=np.zeros((n, c.TALLY_COLUMNS)),
        steps=np.zeros(n, np.int64),
        streams=np.zeros(n, STREAM),
        observations=np.zeros((n, n_observations), np.float32),
        rewards=np.zeros(n),
        terminated=np.zeros(n, np.bool_),
        truncated=np.zeros(n, np.bool_),
        successes=np.zeros(n, np.bool_),
    )


def stack_vehicles(vehicle: FreeVehicle, n: int) -> FreeVehicle:
    """Return the numbers of n equal vehicles, with a first axis of n in every array but gravity."""
    return vehicle._replace(
        rigid_body=np.repeat(vehicle.rigid_body[None], n, axis=0),
        bodies=np.repeat(vehicle.bodies[None], n, axis=0),
        actuators=np.repeat(vehicle.actuators[None], n, axis=0),
    )

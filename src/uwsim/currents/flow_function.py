"""The compiled function of a current, and the query that it evaluates.

The function has the form of `uwsim.base.numerics.calls`: it receives the address of a record with
the current's parameters, the address of a record of `QUERY`, and the time [s].
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Triple
from ..base.numerics.calls import address_of, function_address, prepare_nothing
from ..base.numerics.jit import njit
from ..base.numerics.memory import view_doubles

QUERY = np.dtype(
    [
        ("n", np.int64),  # the number of points
        ("points", np.int64),  # the address of the points in L, (n, 3) [m]
        ("vehicles", np.int64),  # the address of the vehicle's index at each point, (n,); 0: none
        ("velocity", np.int64),  # the address of the velocities in L, (n, 3) [m/s]
        ("acceleration", np.int64),  # the address of the accelerations [m/s2]; 0: not needed
    ]
)
"""A query of the motion of the water at n points: the inputs, and the addresses of the results."""

Record = Any


@dataclass(frozen=True, kw_only=True, eq=False)
class FlowFunction:
    """The compiled function of a current, with its parameters."""

    function: Callable[[int, int, float], None]
    """The Python function to compile, of module level; see `uwsim.base.numerics.calls`."""
    parameters: npt.NDArray[Any]
    """The array whose address the function receives."""
    prepare: Callable[[float], None] = prepare_nothing
    """The function that draws the random numbers needed up to a time [s]."""
    memory_owners: tuple[object, ...] = field(default=())
    """The objects whose addresses the parameters contain, kept alive here."""

    @property
    def addresses(self) -> tuple[int, int]:
        """The two addresses of `calls.FUNCTION`; the first access compiles the function."""
        return function_address(self.function), address_of(self.parameters)


def query_of(vehicles: npt.NDArray[np.int64]) -> tuple[npt.NDArray[Any], ...]:
    """Return a record of `QUERY`, (1,), and the arrays it refers to, with a point for each vehicle.

    Args:
        vehicles: the index of the vehicle at each point, (n,).

    Returns:
        The record; then the vehicles, points, velocities and accelerations.
    """
    points, velocity, acceleration = np.zeros((3, len(vehicles), 3))
    query = np.zeros(1, QUERY)
    query["n"], query["vehicles"] = len(vehicles), address_of(vehicles)
    query["points"], query["velocity"] = address_of(points), address_of(velocity)
    query["acceleration"] = address_of(acceleration)
    return query, vehicles, points, velocity, acceleration


@njit
def write_everywhere(query: Record, velocity: Array | Triple, acceleration: Array | Triple) -> None:
    """Write a velocity [m/s] and an acceleration [m/s2], (3,) each, for all points of a query."""
    fill(query.velocity, query.n, velocity)
    if query.acceleration != 0:
        fill(query.acceleration, query.n, acceleration)


@njit
def write_no_acceleration(query: Record) -> None:
    """Write zero accelerations, if the query needs accelerations."""
    if query.acceleration != 0:
        fill(query.acceleration, query.n, (0.0, 0.0, 0.0))


@njit
def fill(address: int, n: int, vector: Array | Triple) -> None:
    """Write a vector (3,) n times at an address."""
    vectors = view_doubles(address, 3 * n)
    for i in range(n):
        for k in range(3):
            vectors[3 * i + k] = vector[k]

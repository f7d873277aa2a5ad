"""The function of a current, for compiled code.

It is a function of `uwsim.base.numerics.calls`. Its parameters are a record of the current, and its
values a record of `QUERY`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.calls import address_of, function_address, prepare_nothing
from ..base.numerics.jit import njit
from ..base.numerics.memory import view_doubles

QUERY = np.dtype(
    [
        ("n", np.int64),  # the number of points
        ("points", np.int64),  # the address of the points in L, (n, 3) [m]
        ("vehicles", np.int64),  # the address of the vehicle at each, (n,); 0: none
        ("velocity", np.int64),  # the address of the result, (n, 3) [m/s]
        ("acceleration", np.int64),  # the address of the result [m/s2]; 0: not needed
    ]
)
"""A query of the motion of the water at some points, and the addresses of its results."""

Record = Any


@dataclass(frozen=True, kw_only=True, eq=False)
class FlowFunction:
    """The function of a current."""

    function: Callable[[int, int, float], None]
    """A function of the module's level; see `uwsim.base.numerics.calls`."""
    parameters: npt.NDArray[Any]
    """The array that the function reads at its address."""
    prepare: Callable[[float], None] = prepare_nothing
    """The function that prepares random numbers up to a time [s]."""
    memory_owners: tuple[object, ...] = field(default=())
    """The objects whose addresses the parameters contain."""

    @property
    def addresses(self) -> tuple[int, int]:
        """The numbers of `calls.FUNCTION`; the function is compiled when they are first needed."""
        return function_address(self.function), address_of(self.parameters)


def query_of(vehicles: npt.NDArray[np.int64]) -> tuple[npt.NDArray[Any], ...]:
    """Return a record of `QUERY` with a point for each vehicle, (1,), and its arrays."""
    points, velocity, acceleration = np.zeros((3, len(vehicles), 3))
    query = np.zeros(1, QUERY)
    query["n"], query["vehicles"] = len(vehicles), address_of(vehicles)
    query["points"], query["velocity"] = address_of(points), address_of(velocity)
    query["acceleration"] = address_of(acceleration)
    return query, vehicles, points, velocity, acceleration


@njit
def write_everywhere(query: Record, velocity: Array, acceleration: Array) -> None:
    """Write one velocity and one acceleration, (3,), for all points."""
    fill(query.velocity, query.n, velocity)
    if query.acceleration != 0:
        fill(query.acceleration, query.n, acceleration)


@njit
def write_no_acceleration(query: Record) -> None:
    """Write zero accelerations, if the query needs accelerations."""
    if query.acceleration != 0:
        fill(query.acceleration, query.n, np.zeros(3))


@njit
def fill(address: int, n: int, vector: Array) -> None:
    """Write a vector (3,) for each of n points at an address."""
    vectors = view_doubles(address, 3 * n)
    for i in range(n):
        for k in range(3):
            vectors[3 * i + k] = vector[k]

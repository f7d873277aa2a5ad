"""Compiled functions of the water's motion at bodies, and of the drift of kinematic vehicles."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.calls import address_of, call
from ...base.numerics.jit import njit

POINT, VELOCITY, ACCELERATION, ROTATION, SURFACE, WATER_ROW = 0, 3, 6, 9, 12, 15
"""The columns of the row of a body, in W: a point [m], the velocity [m/s], the acceleration [m/s2]
and the angular velocity [rad/s] of the water at the point, and the elevation of the surface above
it [m] with its slopes along x and y [1]; the last is the length of a row."""


@dataclass(frozen=True, kw_only=True, eq=False)
class WaterFunction:
    """A compiled function of the water's motion; see `uwsim.base.numerics.calls`.

    Its values are a row of `WATER_ROW` numbers for each body: it reads the point and writes the
    other numbers. Its time is the middle of the step.
    """

    function: int
    """The address of the function."""
    parameters: npt.NDArray[Any]
    """The array whose address the function receives."""
    needs_points: bool = False
    """True if the function reads the points, which must then be up to date."""
    follows_surface: bool = False
    """True if the point of a body that pierces the surface has the height of the centre of its
    submerged part."""
    is_steady: bool = False
    """True if the motion in the first step of a run holds for all other steps."""
    memory_owners: tuple[object, ...] = field(default=())
    """The objects whose addresses the parameters contain, kept alive here."""

    @cached_property
    def address(self) -> int:
        """The address of the parameters."""
        return address_of(self.parameters)


@dataclass(frozen=True, kw_only=True, eq=False)
class DriftFunction:
    """A compiled function that moves kinematic vehicles with the water, at the start of each step.

    See `uwsim.base.numerics.calls`. Its values are the poses in W of all kinematic vehicles,
    position [m] and quaternion (wxyz), (n, 7), which it changes. Its time is the end of the step.
    """

    function: int
    """The address of the function."""
    parameters: npt.NDArray[Any]
    """The array whose address the function receives."""
    memory_owners: tuple[object, ...] = field(default=())
    """The objects whose addresses the parameters contain, kept alive here."""

    @cached_property
    def address(self) -> int:
        """The address of the parameters."""
        return address_of(self.parameters)


@njit
def apply_drift(function: int, parameters: int, poses: Array, time: float) -> None:
    """Move poses (n, 7) with the function and parameters of a `DriftFunction`."""
    call(function, parameters, poses.ctypes.data, time)

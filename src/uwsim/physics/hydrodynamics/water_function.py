"""Compiled functions of the water's motion at bodies, and of the drift of kinematic vehicles."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.calls import address_of, call
from ...base.numerics.jit import njit

POINT, VELOCITY, ACCELERATION, ANGULAR_VELOCITY, SURFACE = 0, 3, 6, 9, 12
"""The first columns in the row of a body, all in the world frame W: a point [m], the velocity
[m/s], acceleration [m/s2] and angular velocity [rad/s] of the water at the point, and the elevation
of the surface above the point [m] with the slopes of the surface along x and y [1]."""
WATER_ROW_LENGTH = 15
"""The number of columns in the row of a body."""


@dataclass(frozen=True, kw_only=True, eq=False)
class WaterFunction:
    """A compiled function that computes the water's motion; see `uwsim.base.numerics.calls`.

    The array ``values`` has a row of `WATER_ROW_LENGTH` numbers for each body. The function reads
    the point and writes the other numbers. The argument ``time`` is the middle of the step.
    """

    function: int
    """The address of the function."""
    parameters: npt.NDArray[Any]
    """The array whose address the function receives."""
    needs_points: bool = False
    """True if the function reads the points, which must then be up to date."""
    uses_submerged_centre: bool = False
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
    """A compiled function that moves kinematic vehicles with the water.

    It is called at the start of each step and moves the vehicles to their poses at the end of the
    step; see `uwsim.base.numerics.calls`. The array ``values`` has the poses of all kinematic
    vehicles in the world frame W, position [m] and quaternion (wxyz), (n, 7). The argument ``time``
    is the end of the step.
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

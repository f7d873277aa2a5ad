"""The motion of the water at the bodies of a scene in the compiled steps."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.calls import address_of, call
from ...base.numerics.jit import njit

POINT, VELOCITY, ACCELERATION, ROTATION, WATER_ROW = 0, 3, 6, 9, 12
"""The columns of a row of water at a body, in W: the point [m], and there the velocity [m/s],
acceleration [m/s2] and angular velocity [rad/s] of the water."""


@dataclass(frozen=True, kw_only=True, eq=False)
class WaterFunction:
    """A compiled function of the water's motion; see `uwsim.base.numerics.calls`.

    Its values are a row of `WATER_ROW` numbers a body: it reads the points and writes the others.
    Its time is that in the middle of the step.
    """

    function: int
    """The address of the function."""
    parameters: npt.NDArray[Any]
    """The array that it reads at its address."""
    needs_points: bool = False
    """True if it reads the points, which must then be up to date."""
    is_steady: bool = False
    """True if its values at the first step hold for all others."""
    memory_owners: tuple[object, ...] = field(default=())
    """The objects whose addresses the parameters contain."""

    @cached_property
    def address(self) -> int:
        """The address of the parameters."""
        return address_of(self.parameters)


@dataclass(frozen=True, kw_only=True, eq=False)
class DriftFunction:
    """A function that moves vehicles that are not simulated, at the start of each step of a run.

    See `uwsim.base.numerics.calls`: its values are the poses of all such vehicles, position [m] and
    quaternion (wxyz), (n, 7), which it changes. Its time is that at the end of the step.
    """

    function: int
    """The address of the function."""
    parameters: npt.NDArray[Any]
    """The array that it reads at its address."""
    memory_owners: tuple[object, ...] = field(default=())
    """The objects whose addresses the parameters contain."""

    @cached_property
    def address(self) -> int:
        """The address of the parameters."""
        return address_of(self.parameters)


@njit
def apply_drift(function: int, parameters: int, poses: Array, time: float) -> None:
    """Move poses (n, 7) by the `DriftFunction` at these addresses."""
    call(function, parameters, poses.ctypes.data, time)

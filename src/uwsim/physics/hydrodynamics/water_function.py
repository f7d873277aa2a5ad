"""How the water moves the bodies of a scene in the compiled run of steps."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.calls import address_of, call
from ...base.numerics.jit import njit

POINT, VELOCITY, ACCELERATION, ROTATION, WATER_ROW = 0, 3, 6, 9, 12
"""Columns of a row of water at a body, in W: where it is felt [m], its velocity [m/s], acceleration
[m/s2] and rotation [rad/s]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class WaterFunction:
    """A function that is asked in each step of a run; see `uwsim.base.numerics.calls`.

    Its values are a row of `WATER_ROW` numbers a body: it reads the points, and writes the rest. It
    gets the time in the middle of the step.
    """

    function: int
    """Its address."""
    parameters: npt.NDArray[Any]
    """The array that it reads at its address."""
    needs_points: bool = False
    """Whether it reads where the bodies are; else the points may be out of date."""
    is_steady: bool = False
    """Whether what it says at the first step is the same in all others."""
    kept: tuple[object, ...] = field(default=())
    """What the parameters have the addresses of."""

    @cached_property
    def address(self) -> int:
        """The address of the parameters."""
        return address_of(self.parameters)


@dataclass(frozen=True, kw_only=True, eq=False)
class DriftFunction:
    """A function that moves vehicles which are not simulated, at the start of each step of a run.

    See `uwsim.base.numerics.calls`: its values are the poses of all such vehicles, position [m] and
    quaternion (wxyz), (n, 7), which it changes. It gets the time at the end of the step.
    """

    function: int
    """Its address."""
    parameters: npt.NDArray[Any]
    """The array that it reads at its address."""
    kept: tuple[object, ...] = field(default=())
    """What the parameters have the addresses of."""

    @cached_property
    def address(self) -> int:
        """The address of the parameters."""
        return address_of(self.parameters)


@njit
def move_placed(function: int, parameters: int, poses: Array, time: float) -> None:
    """Move poses (n, 7) as a `DriftFunction` says, whose addresses are given."""
    call(function, parameters, poses.ctypes.data, time)

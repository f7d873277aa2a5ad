"""The interface through which compiled code reads frames on vehicles and the water's velocity."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..base.geometry import Array
from ..base.numerics.calls import call
from ..base.numerics.jit import njit

MOUNT = np.dtype([("pose", np.int64), ("motion", np.int64), ("parameters", np.int64)])
"""A frame on a vehicle: the addresses of the functions that write its pose and its motion, and of
their parameters.

See `uwsim.base.numerics.calls`; ``motion`` is 0 if the motion is not read.
"""

N_SURFACE_VALUES = 5
"""The values of `read_surface`: the point (3,), the elevation, the pressure."""

Record = Any


@njit
def read_frame(mount: Record, frame: Array) -> None:
    """Write the pose of a frame in W.

    Args:
        mount: a record of `MOUNT`.
        frame: the array into which the origin (3,) [m] and the rotation by rows (9,) are written.
    """
    call(mount.pose, mount.parameters, frame.ctypes.data, 0.0)


@njit
def read_motion(mount: Record, motion: Array) -> None:
    """Write the motion of a point that is fixed to a frame, in W.

    Args:
        mount: a record of `MOUNT`.
        motion: an array (12,) that begins with the point (3,) [m]; the velocity of the point [m/s],
            the angular velocity of the frame [rad/s] and the acceleration of the point [m/s2] are
            written after it.
    """
    call(mount.motion, mount.parameters, motion.ctypes.data, 0.0)


@njit
def read_water(water: Record, points: Array, time: float) -> None:
    """Write the velocities of the water at points.

    Args:
        water: a record of `uwsim.base.numerics.calls.FUNCTION`.
        points: an array (2, n, 3) that begins with n points in W (n, 3) [m]; the velocities there
            (n, 3) [m/s] are written after them.
        time: the simulation time [s].
    """
    call(water.function, water.parameters, points.ctypes.data, time)


@njit
def read_surface(surface: Record, point: Array, time: float) -> tuple[float, float]:
    """Return the elevation of the surface above a point, and the dynamic pressure there.

    Args:
        surface: a record of `FUNCTION`; its first number is 0 under a level surface.
        point: the point in W; only the first three numbers are read [m].
        time: the simulation time [s].

    Returns:
        The elevation above the still surface [m], and the dynamic pressure over the density of the
        water [m2/s2].
    """
    if surface.function == 0:
        return 0.0, 0.0
    values = np.zeros(N_SURFACE_VALUES)
    for k in range(3):
        values[k] = point[k]
    call(surface.function, surface.parameters, values.ctypes.data, time)
    return values[3], values[4]

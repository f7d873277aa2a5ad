"""The interface through which compiled code reads frames on vehicles and the water."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..base.geometry import Array
from ..base.numerics.calls import call
from ..base.numerics.jit import njit

MOUNT = np.dtype([("place", np.int64), ("move", np.int64), ("parameters", np.int64)])
"""The addresses of the functions that write a frame and its motion, and of their parameters.

See `uwsim.base.numerics.calls`; ``move`` is 0 if the motion is not read.
"""

Record = Any


@njit
def read_frame(mount: Record, frame: Array) -> None:
    """Write the pose of a frame: its origin in W [m], then its axes by rows, into (12,)."""
    call(mount.place, mount.parameters, frame.ctypes.data, 0.0)


@njit
def read_motion(mount: Record, motion: Array) -> None:
    """Write the motion of a point of a frame, in W, after the point.

    Args:
        mount: the frame.
        motion: the point (3,) [m]; then its velocity [m/s], the angular velocity of the frame
            [rad/s] and the acceleration of the point [m/s2] are written, (12,).
    """
    call(mount.move, mount.parameters, motion.ctypes.data, 0.0)


@njit
def read_water(water: Record, points: Array, time: float) -> None:
    """Write the velocities of the water at points, after them.

    Args:
        water: a record of `FUNCTION`.
        points: of W, (n, 3) [m]; then their velocities are written, (2, n, 3) [m/s].
        time: the simulation time [s].
    """
    call(water.function, water.parameters, points.ctypes.data, time)

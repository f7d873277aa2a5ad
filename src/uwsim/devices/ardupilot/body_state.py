r"""The motion of a vehicle as ArduPilot reads it: north-east-down, and forward-right-down.

With the position p, the velocity v, the acceleration a and the angular velocity :math:`\omega` of
the base in W, its axes :math:`R` in W, and gravity g,

.. math::

    p_n = M (p - p_h), \quad v_n = M v, \quad R_n = M R S, \quad
    \omega_b = S R^T \omega, \quad f_b = S R^T (a + g e_z)

where M is the rotation from W (east, north, up) to north, east, down, :math:`p_h` is home, and S is
the rotation from forward-right-down to the base: the identity for a base with z down, diag(1, -1,
-1) for one with z up. The acceleration is that of the engine, not a difference of velocities. Not
modelled: noise, biases and delays of the inertial sensors, which ArduPilot's simulation adds by its
parameters ``SIM_ACC*`` and ``SIM_GYR*``.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...base.geometry import Array, write_quaternion
from ...base.numerics.linear import rotate_back
from ...base.numerics.memory import carray, pointer, view_doubles
from ...base.sampling import Sampler
from ...sensors.sensor import create_sampler
from ...world import GRAVITY, MovingBody
from ...world.mounts import MOUNT, read_frame, read_motion

BODY = np.dtype(
    [
        ("mount", MOUNT),
        ("home", np.float64, 3),  # in W [m]
        ("z_sign", np.float64),  # 1: the base has z down; -1: up
    ]
)
"""The parameters of the sampler, for compiled code."""
N_VALUES = 16
"""The number of values: position in NED (3) [m], quaternion (4), velocity in NED (3) [m/s], angular
velocity in FRD (3) [rad/s], specific force in FRD (3) [m/s2]."""


def body_sampler(mount: MovingBody, home: Array, *, is_z_down: bool) -> Sampler:
    """Return the sampler of a vehicle's motion; see `N_VALUES`.

    Args:
        mount: the base of the vehicle.
        home: the position of home in W, (3,) [m].
        is_z_down: True if the z axis of the base points down at the start, and y to starboard.
    """
    row = np.zeros(1, BODY)
    row["mount"], row["home"] = mount.functions, home
    row["z_sign"] = 1.0 if is_z_down else -1.0
    return create_sampler(mount, sample_body, row, N_VALUES, ())


def sample_body(parameters: int, values_address: int, time: float) -> None:
    """Take a sample of the motion of a vehicle; see `uwsim.base.numerics.calls`."""
    body = carray(pointer(parameters), (1,), BODY)[0]
    values = view_doubles(values_address, N_VALUES)
    frame, motion, rotation = np.empty(12), np.empty(12), np.empty((3, 3))
    read_frame(body.mount, frame)
    motion[:3] = frame[:3]
    read_motion(body.mount, motion)
    sign = body.z_sign
    axes = frame[3:].reshape((3, 3))
    for i in range(3):
        column = 1.0 if i == 0 else sign
        rotation[0, i] = column * axes[1, i]
        rotation[1, i] = column * axes[0, i]
        rotation[2, i] = -column * axes[2, i]
    values[0] = frame[1] - body.home[1]
    values[1] = frame[0] - body.home[0]
    values[2] = body.home[2] - frame[2]
    write_quaternion(rotation, values[3:7])
    values[7], values[8], values[9] = motion[4], motion[3], -motion[5]
    motion[11] += GRAVITY
    values[10:13] = rotate_back(axes, motion[6:9])
    values[13:16] = rotate_back(axes, motion[9:12])
    for i in (11, 12, 14, 15):
        values[i] *= sign


def is_base_z_down(rotation: Array) -> bool:
    """Return whether the z axis of a base points down, from its axes in W, (3, 3)."""
    return bool(rotation[2, 2] < 0.0)


def split_sample(values: Array) -> tuple[Sequence[float], ...]:
    """Return position, quaternion, velocity, angular velocity and specific force of a sample."""
    numbers = values.tolist()
    return numbers[:3], numbers[3:7], numbers[7:10], numbers[10:13], numbers[13:]

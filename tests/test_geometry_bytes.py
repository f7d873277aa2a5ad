"""Rotations to the last bit: what results hang on is added in a stated order, without BLAS."""

from __future__ import annotations

import math
from itertools import product as combinations

import numpy as np
import pytest

from uwsim.base.geometry import (
    Array,
    quaternion_from_rotation,
    rotation_from_quaternion,
    rotation_from_rpy,
    rotation_x,
    rotation_y,
    rotation_z,
)
from uwsim.base.numerics.linear import product

ANGLES = (0.0, -0.0, 0.3, -1.2, math.pi / 2, math.pi, -math.pi, 3.0)


def shepperd(r: Array) -> Array:
    """The quaternion as it is written in Shepperd's paper, by indices."""
    choices = np.array([np.trace(r), r[0, 0], r[1, 1], r[2, 2]])
    i = int(np.argmax(choices))
    q = np.empty(4)
    if i == 0:
        q[:] = 1.0 + choices[0], r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]
    else:
        a, b, c = i - 1, i % 3, (i + 1) % 3
        q[0] = r[c, b] - r[b, c]
        q[1 + a] = 1.0 + r[a, a] - r[b, b] - r[c, c]
        q[1 + b] = r[b, a] + r[a, b]
        q[1 + c] = r[c, a] + r[a, c]
    q = q / math.sqrt(sum(float(x) * float(x) for x in q))
    return -q if q[0] < 0.0 else q


@pytest.mark.parametrize("angles", [*combinations(ANGLES, repeat=3)][::7])
def test_roll_pitch_yaw_are_three_rotations_to_the_bit(angles: tuple[float, float, float]) -> None:
    roll, pitch, yaw = angles
    each = product(product(rotation_z(yaw), rotation_y(pitch)), rotation_x(roll))
    assert rotation_from_rpy(roll, pitch, yaw).tobytes() == each.tobytes()


def test_a_quaternion_is_shepperds_to_the_bit() -> None:
    rng = np.random.default_rng(0)
    wxyz = rng.standard_normal((500, 4))
    wxyz[::5, 0] = 0.0
    wxyz[::7, 1] = 0.0
    for one in [*wxyz, *np.eye(4)]:
        rotation = rotation_from_quaternion(one)
        assert quaternion_from_rotation(rotation).tobytes() == shepperd(rotation).tobytes()

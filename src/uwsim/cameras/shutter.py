r"""The shutter: the times at which each row of an image collects light.

The middle of the exposure of the middle row is the time of the image. With a rolling shutter, each
row begins by the row time after the one above. An image is the mean of images at N times,
:math:`\tau_i`, in which the camera moves with its present twist. The weight of image i in row r is

.. math:: w_{ri} = \frac 1 t \int_{\tau_r - t/2}^{\tau_r + t/2} \Lambda_i(\tau) \, d\tau

with the hat function :math:`\Lambda_i`, which is 1 at :math:`\tau_i` and 0 at the neighbours: light
is interpolated between the times. Times are so near that no point moves by more than a pixel
between them, unless this takes more than `MAX_IMAGES` images.

Not modelled: acceleration within the exposure, bodies that move on their own.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Intrinsics, Pose
from ..base.numerics.jit import njit
from ..base.numerics.linear import product

MAX_IMAGES = 32
"""The greatest number of images that are averaged."""
MIN_MOTION = 0.1
"""The motion during the whole exposure below which one image is enough [px]."""


@dataclass(frozen=True, kw_only=True)
class Shutter:
    """The shutter of a camera."""

    mode: Literal["global", "rolling"] = "global"
    """All rows at once, or row by row."""
    row_time: float = 0.0
    """The time from the exposure of a row to that of the next, with a rolling shutter [s]."""
    exposure_time: float = 0.01
    """The exposure time of a row [s]; 0 without motion blur."""

    def compute_span(self, height: int) -> float:
        """Return the time from the first light of an image of ``height`` rows to the last [s]."""
        readout = self.row_time * (height - 1) if self.mode == "rolling" else 0.0
        return self.exposure_time + readout

    def choose_times(self, height: int, motion: float) -> Array:
        """Choose the times of the images that are averaged, relative to the image's, (n,) [s].

        Args:
            height: the number of rows.
            motion: the greatest motion of a pixel [px/s].
        """
        span = self.compute_span(height)
        n_pixels = motion * span
        if not n_pixels > MIN_MOTION:
            return np.zeros(1)
        n = min(1 + math.ceil(min(n_pixels, float(MAX_IMAGES))), MAX_IMAGES)
        return np.array([span * (i / (n - 1) - 0.5) for i in range(n)])

    def compute_weights(self, height: int, times: Array) -> npt.NDArray[np.float32]:
        """Return the weight of each image in each row, (n, height); their sum in a row is 1."""
        if len(times) == 1:
            return np.ones((1, height), np.float32)
        row_time = self.row_time if self.mode == "rolling" else 0.0
        middles = [(row - 0.5 * (height - 1)) * row_time for row in range(height)]
        half, step = 0.5 * self.exposure_time, float(times[1] - times[0])
        weights = np.empty((len(times), height))
        for row, middle in enumerate(middles):
            for i, time in enumerate(times.tolist()):
                low, high = (middle - half - time) / step, (middle + half - time) / step
                if half > 0.0:
                    weights[i, row] = (_integrate_hat(high) - _integrate_hat(low)) / (high - low)
                else:
                    weights[i, row] = max(1.0 - abs(low), 0.0)
            weights[:, row] /= weights[:, row].sum()
        return weights.astype(np.float32)


def move_pose(pose: Pose, velocity: Array, angular_velocity: Array, time: float) -> Pose:
    """Return a pose after a time with constant velocities in W [m/s, rad/s].

    The origin moves along a line, and the axes turn about the angular velocity.
    """
    return Pose(
        pose.position + velocity * time, product(turn(angular_velocity, time), pose.rotation)
    )


def turn(angular_velocity: Array, time: float) -> Array:
    """Return the rotation by a constant angular velocity, (3, 3), by Rodrigues' formula."""
    x, y, z = (angular_velocity * time).tolist()
    angle = math.sqrt(x * x + y * y + z * z)
    if angle == 0.0:
        return np.eye(3)
    x, y, z = x / angle, y / angle, z / angle
    c, s = math.cos(angle), math.sin(angle)
    k = 1.0 - c
    return np.array(
        [
            [c + k * x * x, k * x * y - s * z, k * x * z + s * y],
            [k * x * y + s * z, c + k * y * y, k * y * z - s * x],
            [k * x * z - s * y, k * y * z + s * x, c + k * z * z],
        ]
    )


def find_motion(
    depth: Array, intrinsics: Intrinsics, velocity: Array, angular_velocity: Array
) -> float:
    """Find the greatest motion of a point in the image of a moving pinhole [px/s].

    Args:
        depth: the planar depth of each pixel, (h, w) [m]; inf: no surface, which only turns.
        intrinsics: the pinhole, without a lens.
        velocity: the velocity of the camera in its frame (x right, y up, z backward), (3,) [m/s].
        angular_velocity: the angular velocity in that frame, (3,) [rad/s].
    """
    pinhole = np.array([intrinsics.fx, intrinsics.fy, intrinsics.cx, intrinsics.cy])
    return _find_motion(depth, pinhole, velocity, angular_velocity)


@njit
def _find_motion(depth: Array, pinhole: Array, velocity: Array, rate: Array) -> float:
    height, width = depth.shape
    max_square = 0.0
    for row in range(height):
        y = (pinhole[3] - row) / pinhole[1]
        for column in range(width):
            x = (column - pinhole[2]) / pinhole[0]
            inverse = 1.0 / depth[row, column]
            # The velocity of the point (x, y, -1) over its depth, in the frame of the camera.
            dx = -velocity[0] * inverse + rate[1] + rate[2] * y
            dy = -velocity[1] * inverse - rate[2] * x - rate[0]
            dz = -velocity[2] * inverse - (rate[0] * y - rate[1] * x)
            du, dv = pinhole[0] * (dx + x * dz), pinhole[1] * (dy + y * dz)
            max_square = max(max_square, du * du + dv * dv)
    return math.sqrt(max_square)


def _integrate_hat(end: float) -> float:
    """Return the integral of max(1 - |x|, 0) from -infinity to a number."""
    if end <= -1.0:
        return 0.0
    if end >= 1.0:
        return 1.0
    rising = 0.5 * (1.0 + min(end, 0.0)) ** 2
    return rising + (end - 0.5 * end * end if end > 0.0 else 0.0)

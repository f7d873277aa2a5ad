"""Validation of numbers, positions and orientations from programs, viewers and files.

A peer may send any number that its encoding can express: infinities, 1e308, 5e-324, or an integer
of a thousand digits. All code that reads such values uses these functions.
"""

from __future__ import annotations

import math
from typing import Protocol, SupportsFloat

import numpy as np

from .geometry import Array, Pose

MAX_COMMAND = 1e6
"""The absolute value to which commands are clipped, in SI units; no vehicle reaches it."""
MAX_COORDINATE = MAX_COMMAND
"""The largest absolute coordinate of a position that is accepted [m]."""
EXPECTED_POSE = (
    f"finite coordinates of at most {MAX_COORDINATE:g} m, and a quaternion that is not zero"
)
"""A description of the poses that `read_pose` accepts, for messages to the user."""


class Triple(Protocol):
    """A message with the coordinates ``x``, ``y``, ``z``: Point or Vector3."""

    x: float
    y: float
    z: float


class QuaternionMessage(Triple, Protocol):
    """A message with a quaternion."""

    w: float


class PoseMessage(Protocol):
    """A message with a position and an orientation."""

    @property
    def position(self) -> Triple:
        """The origin [m]."""

    @property
    def orientation(self) -> QuaternionMessage:
        """The rotation."""


def read_number(value: object) -> float | None:
    """Return a number of a decoded message as a float.

    Returns:
        None for every value that is not a finite number: text, true and false, NaN, infinities,
        and integers beyond the range of a float.
    """
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    return finite_float(value)


def finite_float(value: SupportsFloat) -> float | None:
    """Return a number as a float; None if it is not finite, or beyond the range of a float."""
    try:
        number = float(value)
    except OverflowError:
        return None
    return number if math.isfinite(number) else None


def read_position(message: Triple) -> Array | None:
    """Return a position, (3,) [m]; None if a coordinate is not finite or beyond the limit."""
    position = np.array([message.x, message.y, message.z])
    is_valid = bool((np.abs(position) <= MAX_COORDINATE).all())  # False where one is NaN
    return position if is_valid else None


def read_quaternion(message: QuaternionMessage) -> Array | None:
    """Return a quaternion wxyz, (4,), scaled so that its largest component is 1 or -1.

    Returns:
        None if a component is not finite or all are zero. The length is not restricted: without the
        scaling, squares of components below 1e-162 or above 1e154 are 0 or infinite.
    """
    wxyz = np.array([message.w, message.x, message.y, message.z])
    max_component = float(np.abs(wxyz).max())
    return wxyz / max_component if 0.0 < max_component < math.inf else None


def read_pose(message: PoseMessage) -> Pose | None:
    """Return the pose of a message; None if it is not `EXPECTED_POSE`."""
    position, quaternion = read_position(message.position), read_quaternion(message.orientation)
    if position is None or quaternion is None:
        return None
    return Pose.from_quaternion(position, quaternion)

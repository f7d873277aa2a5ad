"""Frames on the links of vehicles, and how they move."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import ClassVar

import numpy as np

from ..geometry import Array, Pose, quaternion_from_rotation
from ..numerics.linear import length, product, turned_back
from ..world import BodyMotion
from .bodies import SceneBody

Wrench = Callable[[Array], Array]
"""Point of W (3,) [m] -> force and torque about it, in W, (6,) [N, N m]."""


class LinkBody(SceneBody):
    """A frame on a link.

    Args:
        name: of the link.
        pose: where the frame is.
        contacts: force and torque of the contacts on the link about a point of W, in W.
        joint: those of the link on its joint, about a point of W, in W.
    """

    def __init__(
        self, name: str, pose: Callable[[], Pose], contacts: Wrench, joint: Wrench
    ) -> None:
        super().__init__(name, pose, None)
        self._contacts, self._joint = contacts, joint

    def contact_wrench(self) -> Array:
        """Return that of the contacts on the link, about its origin, in its axes, (6,)."""
        return self._in_its_axes(self._contacts)

    def joint_wrench(self) -> Array:
        """Return that of the link on its joint, about its origin, in its axes, (6,)."""
        return self._in_its_axes(self._joint)

    def _in_its_axes(self, wrench: Wrench) -> Array:
        here = self.world_from_body
        parts = wrench(here.position).reshape(2, 3)
        return np.concatenate([turned_back(here.rotation, each) for each in parts])


class EngineBody(LinkBody):
    """A frame on a link of a simulated vehicle (`uwsim.world.MovingBody`).

    Args:
        name: of the link.
        pose: where the frame is.
        contacts: on the link.
        joint: what the link does to its joint.
        motion: how a point of W moves with the link.
    """

    STATE: ClassVar[tuple[str, ...]] = ()
    """Attributes of its state, for snapshots."""

    def __init__(
        self,
        name: str,
        pose: Callable[[], Pose],
        contacts: Wrench,
        joint: Wrench,
        motion: Callable[[Array], BodyMotion],
    ) -> None:
        super().__init__(name, pose, contacts, joint)
        self._motion = motion

    def motion(self, time: float) -> BodyMotion:
        """Return how it moves now."""
        return self._motion(self.world_from_body.position)


class PlacedBody(LinkBody):
    """A frame on a link of a vehicle that is put from place to place (`uwsim.world.MovingBody`)."""

    STATE: ClassVar[tuple[str, ...]] = ("_time", "_place", "_rotation", "_moved", "_twist")
    """Attributes of its state, for snapshots."""

    def __init__(
        self, name: str, pose: Callable[[], Pose], contacts: Wrench, joint: Wrench
    ) -> None:
        super().__init__(name, pose, contacts, joint)
        self._time: float | None = None
        self._place, self._rotation = np.zeros(3), np.eye(3)
        self._moved: Array | None = None  # the velocity before the present one
        self._twist = np.zeros((3, 3))  # rows: velocity, angular velocity, acceleration

    def motion(self, time: float) -> BodyMotion:
        """Return the mean since the last call: differences of poses, and of those velocities."""
        if time != self._time:
            self._differentiate(time)
        return BodyMotion(*self._twist.copy())

    def _differentiate(self, time: float) -> None:
        here = self.world_from_body
        if self._time is not None:
            lasted = time - self._time
            velocity = (here.position - self._place) / lasted
            turned = product(here.rotation, self._rotation.T)
            acceleration = np.zeros(3)
            if self._moved is not None:
                acceleration = (velocity - self._moved) / lasted
            self._moved = velocity
            self._twist = np.stack([velocity, rotation_vector(turned) / lasted, acceleration])
        self._time, self._place, self._rotation = time, here.position, here.rotation


def rotation_vector(rotation: Array) -> Array:
    """Return axis times angle of a rotation matrix (3, 3), (3,) [rad]."""
    w, *axis = quaternion_from_rotation(rotation).tolist()
    sine = length(axis)
    if sine < 1e-12:
        return 2.0 * np.array(axis)
    return np.array(axis) * (2.0 * math.atan2(sine, w) / sine)

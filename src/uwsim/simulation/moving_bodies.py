"""Frames on the links of vehicles, and how they move."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..base.geometry import Array, Pose
from ..base.numerics.linear import turned_back
from ..world import BodyMotion
from .bodies import SceneBody

Wrench = Callable[[Array], Array]
"""Point of W (3,) [m] -> force and torque about it, in W, (6,) [N, N m]."""


class MountedBody(SceneBody):
    """A frame on a link of a vehicle (`uwsim.world.MovingBody`).

    Args:
        name: of the link.
        pose: where the frame is.
        contacts: force and torque of the contacts on the link about a point of W, in W.
        joint: those of the link on its joint, about a point of W, in W.
        motion: how a point of W moves with the link.
    """

    def __init__(
        self,
        name: str,
        pose: Callable[[], Pose],
        contacts: Wrench,
        joint: Wrench,
        motion: Callable[[Array], BodyMotion],
    ) -> None:
        super().__init__(name, pose, None)
        self._contacts, self._joint, self._motion = contacts, joint, motion

    def motion(self) -> BodyMotion:
        """Return how it moves now."""
        return self._motion(self.world_from_body.position)

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

r"""How the links of simulated vehicles move: velocities and accelerations of points on them.

With the Jacobian J of a point, :math:`v = J \dot q` and :math:`a = J \ddot q + \dot J \dot q`.
Velocities are those at the end of the last step; :math:`\ddot q` is what the engine solved in that
step, in which forces act at its middle: accelerations are half a step old.
"""

from __future__ import annotations

import mujoco
import numpy as np

from ..geometry import Array
from ..linear import product
from ..world import BodyMotion
from .poses import Poses


class LinkMotion:
    """The motion of points on links.

    Args:
        model: of the scene.
        data: its state.
        poses: where everything is.
    """

    STATE = ("_version",)
    """Attributes of its state, for snapshots: the Jacobians' parts are in the engine's data."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, poses: Poses) -> None:
        self._model, self._data, self._poses = model, data, poses
        self._jacobians = np.zeros((4, 3, model.nv))  # of place and turn, and their rates
        self._version = -1

    def of(self, index: int, link: str, point: Array) -> BodyMotion:
        """Return the motion of a point of W, (3,) [m], on the link of a vehicle."""
        self._refresh()
        model, data, body = self._model, self._data, self._poses.link_body(index, link)
        place, turn, place_rate, turn_rate = self._jacobians
        mujoco.mj_jac(model, data, place, turn, point, body)
        mujoco.mj_jacDot(model, data, place_rate, turn_rate, point, body)
        acceleration = product(place, data.qacc) + product(place_rate, data.qvel)
        return BodyMotion(product(place, data.qvel), product(turn, data.qvel), acceleration)

    def _refresh(self) -> None:
        """Work out what Jacobians are made of, if something was moved."""
        if self._version != self._poses.version:
            self._poses.refresh()
            mujoco.mj_comPos(self._model, self._data)
            mujoco.mj_comVel(self._model, self._data)
            self._version = self._poses.version

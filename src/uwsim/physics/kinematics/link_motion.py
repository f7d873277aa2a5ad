r"""How the links of vehicles move: velocities and accelerations of points on them.

With the Jacobian J of a point, :math:`v = J \dot q` and :math:`a = J \ddot q + \dot J \dot q`.
Velocities of a simulated vehicle are those at the end of the last step; :math:`\ddot q` is what the
engine solved in that step, in which forces act at its middle: accelerations are half a step old.
"""

from __future__ import annotations

import mujoco
import numpy as np

from ...base.geometry import Array
from ...base.numerics.jit import njit
from ...world import BodyMotion
from ..poses import Poses


class LinkMotion:
    """The motion of points on links.

    It works in memory of its own: the engine's has the velocities of contacts, from the beginning
    of the last step, which stay as they are.

    Args:
        model: of the scene.
        data: its state.
        poses: where everything is.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, poses: Poses) -> None:
        self._model, self._data, self._poses = model, data, poses
        self._jacobians = np.zeros((4, 3, model.nv))  # of place and turn, and their rates
        self._own: mujoco.MjData | None = None
        self._copied: tuple[bytes, bytes] | None = None  # the places and velocities in it

    def of(self, index: int, link: str, point: Array) -> BodyMotion:
        """Return the motion of a point of W, (3,) [m], on the link of a simulated vehicle."""
        return self.at(index, link, point, self._data.qvel, self._data.qacc)

    def at(self, index: int, link: str, point: Array, speeds: Array, rates: Array) -> BodyMotion:
        """Return the motion of a point on a link, for given motions of all joints.

        Args:
            index: number of the vehicle.
            link: name of the link.
            point: in W, (3,) [m].
            speeds: of the degrees of freedom, (nv,) [m/s, rad/s].
            rates: of these speeds, (nv,) [m/s2, rad/s2].
        """
        return self._at(self._poses.link_body(index, link), point, speeds, rates)

    def of_body(self, body: int, point: Array) -> BodyMotion:
        """Return the motion of a point of W, (3,) [m], on a body of the engine, by its number."""
        return self._at(body, point, self._data.qvel, self._data.qacc)

    def _at(self, body: int, point: Array, speeds: Array, rates: Array) -> BodyMotion:
        model, own = self._model, self._moved(speeds)
        place, turn, place_rate, turn_rate = self._jacobians
        mujoco.mj_jac(model, own, place, turn, point, body)
        mujoco.mj_jacDot(model, own, place_rate, turn_rate, point, body)
        found = np.empty((3, 3))
        _multiply(self._jacobians, speeds, rates, found)
        return BodyMotion(*found)

    def _moved(self, speeds: Array) -> mujoco.MjData:
        """Places of all links as they are now, and their velocities."""
        data, own = self._data, self._own
        now = data.qpos.tobytes(), speeds.tobytes()
        if own is None:
            own = self._own = mujoco.MjData(self._model)
        elif now == self._copied:
            return own
        self._copied = now
        own.qpos[:], own.qvel[:] = data.qpos, speeds
        mujoco.mj_kinematics(self._model, own)
        mujoco.mj_comPos(self._model, own)
        mujoco.mj_comVel(self._model, own)
        return own


@njit
def _multiply(jacobians: Array, speeds: Array, rates: Array, found: Array) -> None:
    """Velocity, angular velocity and acceleration of a point, into (3, 3), by rows.

    Args:
        jacobians: of place and turn, and their rates, (4, 3, n).
        speeds: of the joints, (n,).
        rates: of these speeds, (n,).
        found: into which they are written.
    """
    for i in range(3):
        velocity, turn, pushed, carried = 0.0, 0.0, 0.0, 0.0
        for k in range(len(speeds)):
            velocity += jacobians[0, i, k] * speeds[k]
            turn += jacobians[1, i, k] * speeds[k]
            pushed += jacobians[0, i, k] * rates[k]
            carried += jacobians[2, i, k] * speeds[k]
        found[0, i], found[1, i], found[2, i] = velocity, turn, pushed + carried

r"""What a link, with all that is beyond it, does to the joint that carries it.

That is what a force-torque sensor in the joint reads. With the momentum :math:`p` of the links
beyond the joint, their weight, contacts, the objects they hold, and the water on them (buoyancy,
drag, added mass),

.. math:: w = W + w_{contacts} + w_{water} - \dot p .

Forces and accelerations are those of the last step, places those at its end.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import mujoco
import numpy as np

from ..base.geometry import Array
from ..base.numerics.linear import cross
from .poses import Poses

if TYPE_CHECKING:
    from .hydrodynamics.hydrodynamics import Hydrodynamics


class JointWrench:
    """The wrenches at the joints of simulated vehicles.

    It works in memory of its own: the engine's stays as the step left it.

    Args:
        model: of the scene.
        data: its state.
        poses: where everything is.
        water: around the vehicles; None if nothing is simulated.
    """

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, poses: Poses, water: Hydrodynamics | None
    ) -> None:
        self._model, self._data, self._poses, self._water = model, data, poses, water
        self._own: mujoco.MjData | None = None

    def of(self, index: int, link: str, point: Array) -> Array:
        """Force and torque about a point of W (3,) [m], in W, (6,) [N, N m].

        0 for a vehicle that is not simulated.
        """
        if self._water is None:
            return np.zeros(6)
        model, body = self._model, self._poses.link_body(index, link)
        own = self._own = self._own or mujoco.MjData(model)
        mujoco.mj_copyData(own, model, self._data)
        mujoco.mj_kinematics(model, own)
        mujoco.mj_comPos(model, own)
        mujoco.mj_comVel(model, own)
        mujoco.mj_rnePostConstraint(model, own)
        wrench = self._water.wrenches(own)[body] - own.cfrc_int[body]  # torque, then force
        lever = point - own.subtree_com[model.body_rootid[body]]
        return np.concatenate([wrench[3:], wrench[:3] - cross(lever, wrench[3:])])

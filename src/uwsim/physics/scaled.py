r"""A vehicle's ``scaleFactor``: a scale at the root of the tree of links.

As in UWSim (C++), the scale S applies to the vehicle as a whole. With the world frame W, the base B
and a link K, a point p of the link is in W at

.. math:: {}^W T_B\; S\; {}^B T_K\; p

S moves the origins of links, the parts mounted on them and their shapes. It stretches a mesh along
the axes of the base, which shears the mesh if S is not uniform and the link is not aligned with the
base. S moves a frame and does not rotate it. Joint values do not change.
"""

from __future__ import annotations

import mujoco
import numpy as np

from ..base.geometry import Array, Triple, rotation_from_rpy
from ..base.numerics.linear import length, rotate, rotate_back
from ..model.body_names import vehicle_body
from ..scene.urdf.kinematics import joint_positions, link_poses
from ..scene.urdf.robot import RobotSpec


class ScaledLinks:
    """The link poses of a scaled vehicle in the engine.

    Args:
        model: the engine's model, whose relative link poses are changed here.
        robot: the links and joints of the vehicle.
        index: the index of the vehicle.
        scale: the scale along the axes of the base [1].
    """

    def __init__(self, model: mujoco.MjModel, robot: RobotSpec, index: int, scale: Triple) -> None:
        self._model, self._robot, self._scale = model, robot, np.array(scale)
        self._bodies = {
            link.name: model.body(vehicle_body(index, link.name)).id for link in robot.links
        }

    def set_poses(self, values: Array) -> None:
        """Set the scaled pose of every link for a joint vector (n,) [rad or m]."""
        poses = link_poses(self._robot, values.tolist())
        positions = joint_positions(self._robot, values.tolist())
        for joint in self._robot.joints:
            parent, child = poses[joint.parent], poses[joint.child]
            offset = rotate_back(parent.rotation, self._scale * (child.position - parent.position))
            if joint.kind == "prismatic":  # the engine adds the slide
                axis = np.array(joint.axis) / length(joint.axis)
                offset -= rotate(rotation_from_rpy(*joint.rpy), axis) * positions[joint.name]
            self._model.body_pos[self._bodies[joint.child]] = offset

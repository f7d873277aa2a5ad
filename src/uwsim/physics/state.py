"""The state of the bodies: MuJoCo's data, given out as copies."""

from __future__ import annotations

from collections.abc import Mapping

import mujoco
import numpy as np

from ..geometry import Pose, quaternion_from_rotation
from ..scene.kinematics import joint_positions
from ..scene.spec import SceneSpec
from ..scene.urdf import RobotSpec
from .compile import compile_scene, object_body, vehicle_body, vehicle_joint


class State:
    """Where every link and object of a scene is.

    Joint vectors hold the movable, non-mimic joints in UWSim's order; mimic joints follow.
    """

    def __init__(self, scene: SceneSpec, robots: Mapping[int, RobotSpec]) -> None:
        self._model = compile_scene(scene, robots)
        self._data = mujoco.MjData(self._model)
        self._robots = robots
        self._joints: dict[int, np.ndarray] = {}
        self._is_stale = True
        self.version = 0
        """Grows whenever something was moved."""
        for index, vehicle in enumerate(scene.vehicles):
            n_joints = len(robots[index].movable)
            values = np.zeros(n_joints)  # (n,) [rad or m]
            given = vehicle.joint_values[:n_joints]
            values[: len(given)] = given
            self.set_joints(index, values)

    def vehicle_pose(self, index: int) -> Pose:
        """Return ``world_from_base`` of a vehicle."""
        return self._free_pose(vehicle_joint(index, ""))

    def place_vehicle(self, index: int, world_from_base: Pose) -> None:
        """Put a vehicle somewhere."""
        self._place_free(vehicle_joint(index, ""), world_from_base)

    def joints(self, index: int) -> np.ndarray:
        """Return a copy of the joint vector of a vehicle, (n,) [rad or m]."""
        return self._joints[index].copy()

    def set_joints(self, index: int, values: np.ndarray) -> None:
        """Set the joint vector of a vehicle (n,) [rad or m]; clamped to the limits."""
        positions = joint_positions(self._robots[index], values.tolist())
        self._joints[index] = np.array(
            [positions[joint.name] for joint in self._robots[index].movable]
        )
        for name, value in positions.items():
            address = self._model.joint(vehicle_joint(index, name)).qposadr[0]
            self._data.qpos[address] = value
        self._moved()

    def link_pose(self, index: int, link: str) -> Pose:
        """Return ``world_from_link`` (the kinematic frame) of a vehicle's link."""
        return self._body_pose(vehicle_body(index, link))

    def object_pose(self, index: int) -> Pose:
        """Return ``world_from_object`` (before its offsets and its scale)."""
        return self._body_pose(object_body(index))

    def place_object(self, index: int, world_from_object: Pose) -> None:
        """Put an object somewhere."""
        self._place_free(f"{object_body(index)}/joint", world_from_object)

    def _free_pose(self, joint: str) -> Pose:
        address = self._model.joint(joint).qposadr[0]
        qpos = self._data.qpos[address : address + 7].copy()
        return Pose.from_quaternion(qpos[:3], qpos[3:])

    def _place_free(self, joint: str, world_from_body: Pose) -> None:
        address = self._model.joint(joint).qposadr[0]
        self._data.qpos[address : address + 3] = world_from_body.position
        self._data.qpos[address + 3 : address + 7] = quaternion_from_rotation(
            world_from_body.rotation
        )
        self._moved()

    def _moved(self) -> None:
        self._is_stale = True
        self.version += 1

    def _body_pose(self, name: str) -> Pose:
        if self._is_stale:
            mujoco.mj_kinematics(self._model, self._data)
            self._is_stale = False
        body = self._data.body(name)
        return Pose(np.array(body.xpos), np.array(body.xmat).reshape(3, 3))

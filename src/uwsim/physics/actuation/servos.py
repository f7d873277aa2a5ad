"""Joint servos of a vehicle with dynamics: position, velocity and effort control.

A servo moves its joint to a target and compensates the load on the joint (`servo_kernel`). Its
stiffness and damping follow from its greatest effort. The URDF states this effort, the position
limits, and the greatest speed of the target. A position command sets the final position of the
target. A velocity command moves the target until the next command. An effort command switches the
servo off, and applies the effort to the joint. The end stops of a joint are at its limits while the
servo is off, and slightly beyond them while it is on. A mimic joint follows the target of its
leader, or the position of the leader while its servo is off. Not modelled: backlash, friction of
the gear.
"""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.record import Record
from ...model.body_names import vehicle_joint
from ...scene.urdf.robot import JointSpec, RobotSpec
from ...vehicle import JointIndices
from ..joints import servo_gains, stops
from .records import GEAR_RATIO, JOINT, JOINT_STATE, OWN_VALUE, SLIDER_CRANK

MAX_SPEED = 2.0
"""The greatest speed of a target, whatever the URDF states [rad/s or m/s]."""


@dataclass(slots=True)
class ServosState(Record):
    """The state of the servos of a vehicle."""

    joints: npt.NDArray[np.void]
    """The state of the servo of each moving joint, records of `records.JOINT_STATE`, (m,)."""


class Servos:
    """The servos of one vehicle.

    Each of the m moving joints has a servo. The joint vector has the n joints that are not mimic
    joints, in the order of UWSim; commands refer to joints by their index in it.
    """

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, robot: RobotSpec, index: int
    ) -> None:
        """Find the joints and servos of the vehicle ``index`` in the engine's model."""
        from . import servo_kernel

        self._kernel = servo_kernel
        self._model, self._data = model, data
        self._specs = moving_joints = [joint for joint in robot.joints if joint.moves]
        names = [joint.name for joint in moving_joints]
        self._joints = [model.joint(vehicle_joint(index, name)).id for name in names]
        self._servos = [model.actuator(f"{vehicle_joint(index, name)}/servo").id for name in names]
        self._records = _joint_records(moving_joints)
        self._records["qpos_address"] = model.jnt_qposadr[self._joints]
        self._records["dof_address"] = model.jnt_dofadr[self._joints]
        self._records["ctrl_address"] = model.actuator_ctrladr[self._servos]
        self._state = np.zeros(len(moving_joints), JOINT_STATE)
        self.state = ServosState(self._state)
        """The state of the servo of each moving joint."""
        self._state["is_on"] = True
        self._indices = np.array(
            [names.index(joint.name) for joint in robot.movable_joints], np.int64
        )  # (n,)
        self._qpos_addresses = self._records["qpos_address"][self._indices]
        self._dofs = self._records["dof_address"][self._indices]

    @property
    def addresses(self) -> tuple[int, int, int]:
        """The memory addresses of the joints' parameters and states; the number of joints m."""
        return self._records.ctypes.data, self._state.ctypes.data, len(self._records)

    @property
    def positions(self) -> Array:
        """The positions of the joints, (n,) [rad or m]."""
        positions: Array = self._data.qpos[self._qpos_addresses]
        return positions

    @property
    def velocities(self) -> Array:
        """The velocities of the joints, (n,) [rad/s or m/s]."""
        velocities: Array = self._data.qvel[self._dofs]
        return velocities

    @property
    def efforts(self) -> Array:
        """The efforts at the joints, (n,) [N m or N]."""
        efforts: Array = self._data.qfrc_actuator[self._dofs] + self._data.qfrc_applied[self._dofs]
        return efforts

    def set_positions(self, values: Array) -> None:
        """Move all joints to positions (n,) [rad or m] at once, at rest, and hold them there."""
        joints = [self._specs[index] for index in self._indices]
        positions = [joint.clamp(value) for joint, value in zip(joints, values, strict=False)]
        self.set_position_targets(np.arange(len(positions)), np.array(positions, dtype=np.float64))
        self._state["target"] = self._state["final_target"]
        self._state["integral"] = 0.0
        self._data.qpos[self._records["qpos_address"]] = self._state["final_target"]
        self._data.qvel[self._records["dof_address"]] = 0.0

    def set_position_targets(self, joints: JointIndices, targets: Array) -> None:
        """Move some joints to target positions (k,) [rad or m], and hold them there.

        The other joints are not affected.
        """
        indices = self._indices[joints]
        while (off_index := self._kernel.find_first_off(self._state, indices)) >= 0:
            self._switch(int(joints[off_index]), is_on=True)
        self._kernel.set_targets(self._records, self._state, indices, targets)

    def set_velocity_targets(self, joints: JointIndices, speeds: Array) -> None:
        """Move the targets of some joints at speeds (k,) [rad/s or m/s]; other targets stop."""
        self._state["requested_speed"] = 0.0
        for joint, speed in zip(joints.tolist(), speeds.tolist(), strict=True):
            self._switch(joint, is_on=True)
            index = self._indices[joint]
            max_speed = float(self._records["max_speed"][index])
            self._state["requested_speed"][index] = min(max(speed, -max_speed), max_speed)
        states = self._state[self._indices]
        positions = np.where(states["is_on"], states["target"], self.positions)
        self._state["requested_position"][self._indices] = positions
        self._kernel.clamp_targets(self._records, self._state)

    def set_efforts(self, joints: JointIndices, efforts: Array) -> None:
        """Switch the servos of some joints off, and apply efforts (k,) [N m or N] to these joints.

        Efforts are limited to the greatest effort of each servo. Other joints are not affected.
        """
        for joint, effort in zip(joints.tolist(), efforts.tolist(), strict=True):
            index = self._indices[joint]
            self._state["requested_speed"][index] = 0.0
            self._switch(joint, is_on=False)
            max_effort = float(self._records["max_effort"][index])
            self._data.qfrc_applied[self._dofs[joint]] = min(max(effort, -max_effort), max_effort)
        self._kernel.clamp_targets(self._records, self._state)

    def _switch(self, joint: int, *, is_on: bool) -> None:
        """Switch the servo of a joint, by its index in the joint vector, and move the end stops."""
        index = self._indices[joint]
        if is_on and self._state["is_on"][index]:
            return
        record, servo = self._records[index], self._servos[index]
        stiffness, damping = float(record["stiffness"]) * is_on, float(record["damping"]) * is_on
        self._state["is_on"][index] = is_on
        self._model.actuator_gainprm[servo, 0] = stiffness
        self._model.actuator_biasprm[servo, 1:3] = -stiffness, -damping
        stop = stops(self._specs[index], is_held=is_on)
        self._model.jnt_range[self._joints[index]] = stop
        self._data.qfrc_applied[self._dofs[joint]] = 0.0
        self._state["target"][index] = self._data.qpos[self._qpos_addresses[joint]]
        self._state["integral"][index] = 0.0


def _joint_records(joints: list[JointSpec]) -> npt.NDArray[np.void]:
    """Return the records of moving joints, without their addresses in the engine, (m,)."""
    names = [joint.name for joint in joints]
    records = np.zeros(len(joints), JOINT)
    for record, joint in zip(records, joints, strict=True):
        record["lower"], record["upper"] = joint.lower, joint.upper
        record["stiffness"], record["damping"] = servo_gains(joint)
        record["max_effort"] = joint.effort
        record["max_speed"] = min(joint.velocity, MAX_SPEED)
        record["kind"] = OWN_VALUE
        if joint.mimic is not None:
            record["kind"] = SLIDER_CRANK if joint.is_crank else GEAR_RATIO
            leader_names = [other.name for other in joints if other.mimic is None]
            leader = joint.mimic.joint
            record["leader"] = names.index(leader) if leader in leader_names else -1
            record["multiplier"], record["offset"] = joint.mimic.multiplier, joint.mimic.offset
    return records

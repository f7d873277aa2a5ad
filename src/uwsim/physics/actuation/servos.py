"""Joint servos of a simulated vehicle: position, velocity and effort control.

A servo pulls its joint to a target (`servo_kernel`), with a stiffness and damping that follow from
its strength, and carries what hangs on the joint. How strong it is and how fast its target moves at
most is said by the URDF. A position sets where the target goes, a velocity moves it until the next
command, both within the limits of the URDF. An effort switches the servo off and acts on the joint
alone. The limits are stops where the servo is off, and a little beyond where it holds. Joints that
mimic follow the targets, or where the leader has no servo, its position. Not modelled: play,
friction of the gear.
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
from .records import CRANKED, GEARED, JOINT, JOINT_STATE, OWN

MAX_SPEED = 2.0
"""A target moves at most this fast, whatever the URDF says [rad/s or m/s]."""


@dataclass(slots=True)
class ServosState(Record):
    """What the servos of a vehicle do."""

    joints: npt.NDArray[np.void]
    """The servo of each joint that moves, (m,) of `records.JOINT_STATE`."""


class Servos:
    """The servos of one vehicle; the joint vector is UWSim's."""

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, robot: RobotSpec, index: int
    ) -> None:
        """Find the joints and actuators of the vehicle number ``index``."""
        from .servo_kernel import aim_at, first_off, take_aim

        self._take_aim, self._aim_at, self._first_off = take_aim, aim_at, first_off
        self._model, self._data = model, data
        self._specs = moving = [joint for joint in robot.joints if joint.moves]
        names = [joint.name for joint in moving]
        self._joints = [model.joint(vehicle_joint(index, name)).id for name in names]
        self._servos = [model.actuator(f"{vehicle_joint(index, name)}/servo").id for name in names]
        self._records = _joint_records(moving)
        self._records["place"] = model.jnt_qposadr[self._joints]
        self._records["dof"] = model.jnt_dofadr[self._joints]
        self._records["control"] = model.actuator_ctrladr[self._servos]
        self._state = np.zeros(len(moving), JOINT_STATE)
        self.state = ServosState(self._state)
        """What they do."""
        self._state["is_on"] = True
        self._vector = np.array(
            [names.index(joint.name) for joint in robot.movable_joints], np.int64
        )  # (n,)
        self._places = self._records["place"][self._vector]
        self._dofs = self._records["dof"][self._vector]

    @property
    def addresses(self) -> tuple[int, int, int]:
        """Of the records of its joints and of their state; how many there are."""
        return self._records.ctypes.data, self._state.ctypes.data, len(self._records)

    @property
    def positions(self) -> Array:
        """Where the joints are, (n,) [rad or m]."""
        positions: Array = self._data.qpos[self._places]
        return positions

    @property
    def velocities(self) -> Array:
        """How fast they move, (n,) [rad/s or m/s]."""
        velocities: Array = self._data.qvel[self._dofs]
        return velocities

    @property
    def efforts(self) -> Array:
        """Forces and torques at the joints, (n,) [N m or N]."""
        acting: Array = self._data.qfrc_actuator[self._dofs] + self._data.qfrc_applied[self._dofs]
        return acting

    def put(self, values: Array) -> None:
        """Set the joints, at rest, and hold them there."""
        leaders = [self._specs[place] for place in self._vector]
        clamped = [joint.clamp(value) for joint, value in zip(leaders, values, strict=False)]
        self.aim(np.arange(len(clamped)), np.array(clamped, dtype=np.float64))
        self._state["target"] = self._state["aim"]
        self._state["integral"] = 0.0
        self._data.qpos[self._records["place"]] = self._state["aim"]
        self._data.qvel[self._records["dof"]] = 0.0

    def aim(self, joints: JointIndices, targets: Array) -> None:
        """Bring these joints to targets, (n,) [rad or m], and hold them there.

        The others keep what they do.
        """
        places = self._vector[joints]
        while (off := self._first_off(self._state, places)) >= 0:
            self._switch(int(joints[off]), is_on=True)
        self._aim_at(self._records, self._state, places, targets)

    def drive(self, joints: JointIndices, speeds: Array) -> None:
        """Move the targets of these joints at speeds, (n,) [rad/s or m/s]; the others stay."""
        self._state["speed"] = 0.0
        for number, speed in zip(joints.tolist(), speeds.tolist(), strict=True):
            self._switch(number, is_on=True)
            place = self._vector[number]
            most = float(self._records["max_speed"][place])
            self._state["speed"][place] = min(max(speed, -most), most)
        own = self._state[self._vector]
        self._state["wanted"][self._vector] = np.where(own["is_on"], own["target"], self.positions)
        self._take_aim(self._records, self._state)

    def push(self, joints: JointIndices, efforts: Array) -> None:
        """Apply efforts, (n,) [N m or N], to these joints, limited to the strength of their servos.

        The others keep what they do.
        """
        for number, effort in zip(joints.tolist(), efforts.tolist(), strict=True):
            place = self._vector[number]
            self._state["speed"][place] = 0.0
            self._switch(number, is_on=False)
            most = float(self._records["max_effort"][place])
            self._data.qfrc_applied[self._dofs[number]] = min(max(effort, -most), most)
        self._take_aim(self._records, self._state)

    def _switch(self, number: int, *, is_on: bool) -> None:
        """Switch a servo on or off; where it is off, the stops are at the limits."""
        place = self._vector[number]
        if is_on and self._state["is_on"][place]:
            return
        record, servo = self._records[place], self._servos[place]
        stiffness, damping = float(record["stiffness"]) * is_on, float(record["damping"]) * is_on
        self._state["is_on"][place] = is_on
        self._model.actuator_gainprm[servo, 0] = stiffness
        self._model.actuator_biasprm[servo, 1:3] = -stiffness, -damping
        stop = stops(self._specs[place], is_held=is_on)
        self._model.jnt_range[self._joints[place]] = stop
        self._data.qfrc_applied[self._dofs[number]] = 0.0
        self._state["target"][place] = self._data.qpos[self._places[number]]
        self._state["integral"][place] = 0.0


def _joint_records(moving: list[JointSpec]) -> npt.NDArray[np.void]:
    """The parameters of joints that move, without their places in the engine, (m,)."""
    names = [joint.name for joint in moving]
    found = np.zeros(len(moving), JOINT)
    for record, joint in zip(found, moving, strict=True):
        record["lower"], record["upper"] = joint.lower, joint.upper
        record["stiffness"], record["damping"] = servo_gains(joint)
        record["max_effort"] = joint.effort
        record["max_speed"] = min(joint.velocity, MAX_SPEED)
        record["kind"] = OWN
        if joint.mimic is not None:
            record["kind"] = CRANKED if joint.is_crank else GEARED
            leads = [one.name for one in moving if one.mimic is None]
            leader = joint.mimic.joint
            record["leader"] = names.index(leader) if leader in leads else -1
            record["multiplier"], record["offset"] = joint.mimic.multiplier, joint.mimic.offset
    return found

"""Joint servos of a simulated vehicle: position, velocity and effort control.

A servo pulls its joint to a target (`servo_kernel`), with a stiffness and damping that follow from
its strength, and carries what hangs on the joint. How strong it is and how fast its target moves at
most is said by the URDF. A position sets where the target goes, a velocity moves it until the next
command, both within the limits of the URDF. An effort switches the servo off and acts on the joint
alone; its limits are then stops. Joints that mimic follow the targets, or where the leader has no
servo, its position. Not modelled: play, friction of the gear.
"""

from __future__ import annotations

from collections.abc import Mapping

import mujoco
import numpy as np

from ...geometry import Array
from ...scene.kinematics import joint_positions
from ...scene.urdf import RobotSpec
from ..compile import servo_gains, vehicle_joint

MAX_SPEED = 2.0
"""A target moves at most this fast, whatever the URDF says [rad/s or m/s]."""
AIM, TARGET, INTEGRAL = range(3)
"""Columns of the servos' memory."""


class Servos:
    """The servos of one vehicle; the joint vector is UWSim's."""

    STATE = ("_memory", "_wanted", "_speeds", "_is_on", "_moves_on")
    """What of it changes as time goes by."""

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, robot: RobotSpec, index: int
    ) -> None:
        """Find the joints and actuators of the vehicle number ``index``."""
        from .servo_kernel import pull

        self._law = pull
        self._model, self._data, self._robot = model, data, robot
        moving = [joint for joint in robot.joints if joint.moves]
        self._all = [joint.name for joint in moving]
        self._names = [joint.name for joint in robot.movable]
        self._joints = [model.joint(vehicle_joint(index, name)).id for name in self._all]
        servos = [model.actuator(f"{vehicle_joint(index, name)}/servo").id for name in self._all]
        self._servos = servos
        places = model.jnt_qposadr[self._joints]
        dofs = model.jnt_dofadr[self._joints]
        self._addresses = np.column_stack([places, dofs, model.actuator_ctrladr[servos]]).astype(
            np.int64
        )  # (m, 3): of all that move, in qpos, among the degrees of freedom, in ctrl
        self._traits = np.array(
            [[*servo_gains(one.effort), one.effort, min(one.velocity, MAX_SPEED)] for one in moving]
        ).reshape(-1, 4)
        self._memory = np.zeros((len(moving), 3))
        self._engine = (
            data.qpos,
            data.qfrc_bias,
            data.qfrc_passive,
            data.qfrc_spring,
            data.qfrc_damper,
            data.qfrc_actuator,
            data.ctrl,
        )
        # of the joint vector, (n,)
        self._vector = [self._all.index(name) for name in self._names]
        self._places, self._dofs = places[self._vector], dofs[self._vector]
        self._wanted = np.zeros(len(self._names))  # [rad or m]
        self._speeds = np.zeros(len(self._names))  # [rad/s or m/s]
        self._is_on = np.ones(len(self._names), dtype=bool)
        self._moves_on = False  # whether what is wanted changes by itself

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
        self.aim(dict(enumerate(values.tolist())))
        self._memory[:, TARGET] = self._memory[:, AIM]
        self._memory[:, INTEGRAL] = 0.0
        self._data.qpos[self._addresses[:, 0]] = self._memory[:, AIM]
        self._data.qvel[self._addresses[:, 1]] = 0.0

    def aim(self, targets: Mapping[int, float]) -> None:
        """Bring these joints to [rad or m] and hold them; the others keep what they do."""
        for number, value in targets.items():
            self._wanted[number] = value
            self._speeds[number] = 0.0
            self._switch(number, is_on=True)
        self._take_aim()

    def drive(self, speeds: Mapping[int, float]) -> None:
        """Move the targets of these joints at [rad/s or m/s]; the others stay where they are."""
        self._speeds[:] = 0.0
        for number, speed in speeds.items():
            self._switch(number, is_on=True)
            most = self._traits[self._vector[number], 3]
            self._speeds[number] = min(max(speed, -most), most)
        self._wanted[:] = np.where(self._is_on, self._memory[self._vector, TARGET], self.positions)
        self._take_aim()

    def push(self, efforts: Mapping[int, float]) -> None:
        """Apply efforts [N m or N] to these joints, limited to the strength of their servos.

        The others keep what they do.
        """
        for number, effort in efforts.items():
            self._speeds[number] = 0.0
            self._switch(number, is_on=False)
            most = self._traits[self._vector[number], 2]
            self._data.qfrc_applied[self._dofs[number]] = min(max(effort, -most), most)
        self._take_aim()

    def step(self, dt: float) -> None:
        """Advance the targets by ``dt`` [s] and set the servos' controls."""
        if self._moves_on:
            self._wanted = np.where(self._is_on, self._wanted + self._speeds * dt, self.positions)
            self._take_aim()
        self._law(dt, self._addresses, self._traits, self._memory, *self._engine)

    def _take_aim(self) -> None:
        """Clamp the targets to the limits, and set those of joints that mimic."""
        positions = joint_positions(self._robot, self._wanted.tolist())
        self._memory[:, AIM] = [positions[name] for name in self._all]
        self._wanted = self._memory[self._vector, AIM]
        self._moves_on = bool(self._speeds.any()) or not self._is_on.all()

    def _switch(self, number: int, *, is_on: bool) -> None:
        """Switch a servo on or off; one that is off is replaced by stops at the limits."""
        if is_on and self._is_on[number]:
            return
        place = self._vector[number]
        stiffness, damping = (self._traits[place, :2] * is_on).tolist()
        servo = self._servos[place]
        self._is_on[number] = is_on
        self._model.actuator_gainprm[servo, 0] = stiffness
        self._model.actuator_biasprm[servo, 1:3] = -stiffness, -damping
        self._model.jnt_limited[self._joints[place]] = not is_on
        self._data.qfrc_applied[self._dofs[number]] = 0.0
        self._memory[place, TARGET] = self._data.qpos[self._places[number]]
        self._memory[place, INTEGRAL] = 0.0

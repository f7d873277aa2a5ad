"""The joints of a simulated vehicle: servos that hold, follow or let go.

A servo pulls its joint to a target like a spring and a damper (`SERVO`). A position sets the
target, a velocity moves it on until the next command, both within the limits of the URDF. An
effort switches the servo off and acts on the joint alone; its limits are then stops. Joints that
mimic follow the targets, or where the leader has no servo, its position. Not modelled: greatest
torque and speed of a servo, play.
"""

from __future__ import annotations

from collections.abc import Mapping

import mujoco
import numpy as np

from ..geometry import Array
from ..scene.kinematics import joint_positions
from ..scene.urdf import RobotSpec
from .compile import SERVO, vehicle_joint


class Servos:
    """The servos of one vehicle; the joint vector is UWSim's."""

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, robot: RobotSpec, index: int
    ) -> None:
        """Find the joints and actuators of the vehicle number ``index``."""
        self._model, self._data, self._robot = model, data, robot
        self._joints = {
            joint.name: model.joint(vehicle_joint(index, joint.name)).id
            for joint in robot.joints
            if joint.moves
        }
        self._servos = {
            name: model.actuator(f"{vehicle_joint(index, name)}/servo").id for name in self._joints
        }
        self._names = [joint.name for joint in robot.movable]
        self._targets = np.zeros(len(self._names))  # (n,) [rad or m]
        self._speeds = np.zeros(len(self._names))  # (n,) [rad/s or m/s]
        self._is_on = np.ones(len(self._names), dtype=bool)

    @property
    def positions(self) -> Array:
        """Where the joints are, (n,) [rad or m]."""
        adr = self._model.jnt_qposadr
        return np.array([self._data.qpos[adr[self._joints[name]]] for name in self._names])

    @property
    def velocities(self) -> Array:
        """How fast they move, (n,) [rad/s or m/s]."""
        adr = self._model.jnt_dofadr
        return np.array([self._data.qvel[adr[self._joints[name]]] for name in self._names])

    @property
    def efforts(self) -> Array:
        """What acts on them, (n,) [N m or N]."""
        adr = self._model.jnt_dofadr
        dofs = [adr[self._joints[name]] for name in self._names]
        acting: Array = self._data.qfrc_actuator[dofs] + self._data.qfrc_applied[dofs]
        return acting

    def put(self, values: Array) -> None:
        """Put the joints somewhere, at rest, and hold them there."""
        positions = joint_positions(self._robot, values.tolist())
        for name, value in positions.items():
            self._data.qpos[self._model.jnt_qposadr[self._joints[name]]] = value
            self._data.qvel[self._model.jnt_dofadr[self._joints[name]]] = 0.0
        self.aim(dict(enumerate(values.tolist())))

    def aim(self, targets: Mapping[int, float]) -> None:
        """Hold these joints at [rad or m]; the others keep what they do."""
        for number, value in targets.items():
            self._targets[number] = value
            self._speeds[number] = 0.0
            self._switch(number, is_on=True)
        self._pull()

    def drive(self, speeds: Mapping[int, float]) -> None:
        """Move the targets of these joints at [rad/s or m/s]; the others stay where they are."""
        self._speeds[:] = 0.0
        here = self.positions
        for number, speed in speeds.items():
            if not self._is_on[number]:
                self._targets[number] = here[number]
                self._switch(number, is_on=True)
            self._speeds[number] = speed
        self._pull()

    def push(self, efforts: Mapping[int, float]) -> None:
        """Let these joints go and act on them with [N m or N]; the others keep what they do."""
        for number, effort in efforts.items():
            self._speeds[number] = 0.0
            self._switch(number, is_on=False)
            dof = self._model.jnt_dofadr[self._joints[self._names[number]]]
            self._data.qfrc_applied[dof] = effort

    def step(self, dt: float) -> None:
        """Move the targets on by ``dt`` [s]."""
        if self._speeds.any() or not self._is_on.all():
            self._targets += self._speeds * dt
            self._pull()

    def _pull(self) -> None:
        """Set the servos' targets, within the limits."""
        wanted = np.where(self._is_on, self._targets, self.positions)
        positions = joint_positions(self._robot, wanted.tolist())
        self._targets = np.array([positions[name] for name in self._names])
        for name, value in positions.items():
            self._data.ctrl[self._model.actuator_ctrladr[self._servos[name]]] = value

    def _switch(self, number: int, *, is_on: bool) -> None:
        """Switch a servo on or off; one that is off is replaced by stops at the limits."""
        name = self._names[number]
        joint, servo = self._joints[name], self._servos[name]
        stiffness, damping = SERVO if is_on else (0.0, 0.0)
        self._is_on[number] = is_on
        self._model.actuator_gainprm[servo, 0] = stiffness
        self._model.actuator_biasprm[servo, 1:3] = -stiffness, -damping
        self._model.jnt_limited[joint] = not is_on
        self._data.qfrc_applied[self._model.jnt_dofadr[joint]] = 0.0

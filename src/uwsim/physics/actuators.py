"""Actuators: what the thrusters and joints of a simulated vehicle do now, and what they draw.

Read from the engine's state after a step, not integrated: the thrust that the rotors, as they
turn now, give in the water around them, and the effort of the servos in that step. Joints that
mimic have a servo and so a motor of their own.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import mujoco

from ..scene.urdf import RobotSpec
from .compile import vehicle_joint, vehicle_thruster
from .hydrodynamics import ThrusterSpec, VehicleHydrodynamics
from .hydrodynamics.columns import WATER_COLUMNS
from .hydrodynamics.spec import JointDrive
from .power import ThrusterPower, joint_power

if TYPE_CHECKING:
    from .hydrodynamics.hydrodynamics import Hydrodynamics


class Actuators:
    """The thrusters of a vehicle in the order of its side file, then its joints in the URDF's."""

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        water: Hydrodynamics,
        vehicle: VehicleHydrodynamics,
        robot: RobotSpec,
        index: int,
        refresh: Callable[[], None],
    ) -> None:
        """Find them in the model.

        Args:
            model: the engine's.
            data: its state.
            water: around the vehicle.
            vehicle: what its side file says.
            robot: its links and joints.
            index: number of the vehicle.
            refresh: brings the places in ``data`` up to date.
        """
        from .hydrodynamics.kernel import curve

        self._refresh, self._curve = refresh, curve
        self._ctrl, self._act, self._userdata = data.ctrl, data.act, data.userdata
        self._qpos, self._qvel, self._applied = data.qpos, data.qvel, data.qfrc_applied
        self._places, self._water, self._still = data.site_xpos, water.water(data), water.surface
        self._rotors = [
            _Rotor(model, model.actuator(vehicle_thruster(index, spec.name)).id, spec, water)
            for spec in vehicle.thrusters
        ]
        moving = [joint.name for joint in robot.joints if joint.moves]
        names = [vehicle_joint(index, name) for name in moving]
        self._motors = [
            _Motor(
                model,
                model.joint(name).id,
                model.actuator(f"{name}/servo").id,
                vehicle.drive(joint),
            )
            for name, joint in zip(names, moving, strict=True)
        ]
        self._timestep = float(model.opt.timestep)
        self.thrusters = tuple(spec.name for spec in vehicle.thrusters)
        """Names of its thrusters."""
        self.joints = tuple(moving)
        """Names of its joints, those that mimic included."""

    def thrusts(self) -> list[float]:
        """Along their directions, as the water has it [N]."""
        self._refresh()
        thrusts = []
        for one in self._rotors:
            command = self._ctrl.item(one.control) if one.state < 0 else self._act.item(one.state)
            surface = self._still + self._water.item(one.body, 6)
            wet = 0.5 + 0.5 * (surface - self._places.item(one.site, 2)) / one.radius
            healthy = 1.0 - self._userdata.item(one.loss)
            thrust = self._curve(one.table, min(max(command, one.least), one.most))
            thrusts.append(healthy * thrust * min(max(wet, 0.0), 1.0))
        return thrusts

    def efforts(self) -> list[float]:
        """Of the joints' servos, or what was commanded where those are off [N m or N].

        It is what acted in the last step: the engine pulls towards the target from where the joint
        was, and damps the speed that it has after the step.
        """
        efforts = []
        for one in self._motors:
            speed = self._qvel.item(one.dof)
            before = self._qpos.item(one.position) - speed * self._timestep
            pull = one.gain.item(0) * self._ctrl.item(one.control)
            pull += one.bias.item(1) * before + one.bias.item(2) * speed
            pull = min(max(pull, -one.strongest), one.strongest)
            efforts.append(pull + self._applied.item(one.dof))
        return efforts

    def speeds(self) -> list[float]:
        """Of the joints [rad/s or m/s]."""
        return [self._qvel.item(one.dof) for one in self._motors]

    def powers(self) -> list[float]:
        """What the thrusters draw now, then the joints [W]."""
        rotors = zip(self._rotors, self.thrusts(), strict=True)
        motors = zip(self._motors, self.efforts(), self.speeds(), strict=True)
        return [
            *[one.power(thrust) for one, thrust in rotors],
            *[joint_power(one.drive, effort, speed) for one, effort, speed in motors],
        ]


class _Rotor:
    """Where a thruster's numbers stand in the engine."""

    def __init__(
        self, model: mujoco.MjModel, actuator: int, spec: ThrusterSpec, water: Hydrodynamics
    ) -> None:
        self.radius, self.power = spec.radius, ThrusterPower(spec, water.density)
        self.state = int(model.actuator_actadr[actuator])
        self.control = int(model.actuator_ctrladr[actuator])
        self.least, self.most = model.actuator_ctrlrange[self.control].tolist()
        self.table = model.actuator_user[actuator]
        self.site = int(model.actuator_trnid[actuator, 0])
        self.body = int(model.site_bodyid[self.site])
        self.loss = WATER_COLUMNS * model.nbody + actuator


class _Motor:
    """Where a joint's numbers stand in the engine; views, for servos are switched off and on."""

    def __init__(self, model: mujoco.MjModel, joint: int, servo: int, drive: JointDrive) -> None:
        self.drive = drive
        self.position, self.dof = int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint])
        self.control = int(model.actuator_ctrladr[servo])
        self.gain, self.bias = model.actuator_gainprm[servo], model.actuator_biasprm[servo]
        is_limited = bool(model.actuator_forcelimited[servo])
        self.strongest = float(model.actuator_forcerange[servo, 1]) if is_limited else math.inf

"""Actuators: what the thrusters and joints of a simulated vehicle do now, and what they draw.

Read from the engine's state after a step, not integrated: the thrust that the rotors, as they
turn now, give in the water around them, and the effort of the servos in that step. Joints that
mimic have a servo and so a motor of their own.
"""

from __future__ import annotations

from collections.abc import Callable
from math import inf
from typing import TYPE_CHECKING

import mujoco
import numpy as np

from ..geometry import Array
from ..scene.urdf import RobotSpec
from .compile import vehicle_joint, vehicle_thruster
from .hydrodynamics import ThrusterSpec, VehicleHydrodynamics
from .hydrodynamics.columns import WATER_COLUMNS
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

        self._data, self._water, self._refresh, self._curve = data, water, refresh, curve
        self._rotors = [
            _Rotor(model, model.actuator(vehicle_thruster(index, spec.name)).id, spec, water)
            for spec in vehicle.thrusters
        ]
        moving = [joint.name for joint in robot.joints if joint.moves]
        self._drives = [vehicle.drive(name) for name in moving]
        joints = [model.joint(vehicle_joint(index, name)).id for name in moving]
        servos = [model.actuator(f"{vehicle_joint(index, name)}/servo").id for name in moving]
        self._timestep = float(model.opt.timestep)
        self._gains, self._biases = model.actuator_gainprm, model.actuator_biasprm
        self._motors = [
            (
                servo,
                int(model.actuator_ctrladr[servo]),
                int(model.jnt_qposadr[joint]),
                int(model.jnt_dofadr[joint]),
                _strongest(model, servo),
            )
            for servo, joint in zip(servos, joints, strict=True)
        ]
        self.thrusters = tuple(spec.name for spec in vehicle.thrusters)
        """Names of its thrusters."""
        self.joints = tuple(moving)
        """Names of its joints, those that mimic included."""

    def thrusts(self) -> list[float]:
        """Along their directions, as the water has it [N]."""
        self._refresh()
        data, still, water = self._data, self._water.surface, self._water.water(self._data)
        ctrl, act, places, userdata = data.ctrl, data.act, data.site_xpos, data.userdata
        thrusts = []
        for one in self._rotors:
            command = float(ctrl[one.control] if one.state < 0 else act[one.state])
            surface = still + float(water[one.body, 6])
            wet = 0.5 + 0.5 * (surface - float(places[one.site, 2])) / one.radius
            healthy = 1.0 - float(userdata[one.loss])
            thrust = self._curve(one.table, min(max(command, one.least), one.most))
            thrusts.append(healthy * thrust * min(max(wet, 0.0), 1.0))
        return thrusts

    def efforts(self) -> list[float]:
        """Of the joints' servos, or what was commanded where those are off [N m or N].

        It is what acted in the last step: the engine pulls towards the target from where the joint
        was, and damps the speed that it has after the step.
        """
        data = self._data
        ctrl, qpos, qvel, applied = data.ctrl, data.qpos, data.qvel, data.qfrc_applied
        efforts = []
        for servo, control, position, dof, strongest in self._motors:
            gain, bias = float(self._gains[servo, 0]), self._biases[servo]
            pull = gain * float(ctrl[control])
            speed = float(qvel[dof])
            before = float(qpos[position]) - speed * self._timestep
            pull += float(bias[1]) * before + float(bias[2]) * speed
            efforts.append(min(max(pull, -strongest), strongest) + float(applied[dof]))
        return efforts

    def speeds(self) -> list[float]:
        """Of the joints [rad/s or m/s]."""
        qvel = self._data.qvel
        return [float(qvel[dof]) for _, _, _, dof, _ in self._motors]

    def powers(self) -> Array:
        """What the thrusters draw now, then the joints, (n,) [W]."""
        powers = [
            one.power(thrust) for one, thrust in zip(self._rotors, self.thrusts(), strict=True)
        ]
        for drive, effort, speed in zip(self._drives, self.efforts(), self.speeds(), strict=True):
            powers.append(joint_power(drive, effort, speed))
        return np.array(powers)


def _strongest(model: mujoco.MjModel, servo: int) -> float:
    """The greatest effort of a servo [N m or N]."""
    return float(model.actuator_forcerange[servo, 1]) if model.actuator_forcelimited[servo] else inf


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

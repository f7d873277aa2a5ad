"""Actuators of a simulated vehicle: present thrusts, efforts and electric power.

Read from the engine's state after a step, not integrated: the thrust that the rotors, as they
turn now, give in the water around them, and the effort of the servos in that step. Joints that
mimic have a servo and so a motor of their own.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import mujoco
import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.calls import CompiledFunction, address_of, function_address
from ...model.body_names import vehicle_joint, vehicle_thruster
from ...scene.hydrodynamics import VehicleHydrodynamics
from ...scene.hydrodynamics.spec import JointDrive
from ...scene.urdf.robot import RobotSpec
from ..hydrodynamics.columns import WATER_COLUMNS
from .power import greatest_power, power_table

if TYPE_CHECKING:
    from ..hydrodynamics.hydrodynamics import Hydrodynamics
    from .power_kernel import Motors, Rotors


class Actuators:
    """The thrusters of a vehicle as in its hydrodynamics file, then its joints as in the URDF."""

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
            vehicle: its hydrodynamics.
            robot: its links and joints.
            index: number of the vehicle.
            refresh: brings the places in ``data`` up to date.
        """
        from . import power_kernel

        self._law, self._refresh = power_kernel, refresh
        moving = [joint for joint in robot.joints if joint.moves]
        self.thrusters = tuple(spec.name for spec in vehicle.thrusters)
        """Names of its thrusters."""
        self.joints = tuple(joint.name for joint in moving)
        """Names of its joints, those that mimic included."""
        powers = [greatest_power(one, water.density) for one in vehicle.thrusters]
        self.greatest_power = math.fsum(powers)
        """Electric power of all thrusters at their greatest thrusts [W]."""
        terms = max((power_table(one, 1.0).shape[1] - 1 for one in vehicle.thrusters), default=0)
        self._tables = np.array(
            [power_table(one, water.density, terms) for one in vehicle.thrusters]
        ).reshape(-1, 2, 1 + terms)
        rotors = [model.actuator(vehicle_thruster(index, name)).id for name in self.thrusters]
        radii = [spec.radius for spec in vehicle.thrusters]
        self._rotors = _rotors(model, data, water, rotors, radii)
        names = [vehicle_joint(index, name) for name in self.joints]
        drives = [vehicle.drive(joint.name) for joint in moving]
        self._motors = _motors(model, data, names, drives)

    def thrusts(self) -> Array:
        """Along their directions, as the water has it, (n,) [N]."""
        self._refresh()
        return self._law.thrusts(*self._rotors)

    def efforts(self) -> Array:
        """Of the joints' servos, or what was commanded where those are off, (m,) [N m or N]."""
        return self._law.efforts(*self._motors)

    @cached_property
    def compiled_powers(self) -> CompiledFunction:
        """The function that writes `powers` for compiled code."""
        row = self._law.powers_record(self._tables, self._rotors, self._motors)
        return CompiledFunction(
            addresses=(function_address(self._law.write_powers), address_of(row)),
            prepare=lambda _: self._refresh(),
            memory_owners=(self, row),
        )

    def powers(self) -> Array:
        """Electric power of the thrusters, then of the joints, (n + m,) [W]."""
        self._refresh()
        return self._law.powers(self._tables, self._rotors, self._motors)


# What the laws take. Views into the engine's memory: servos are switched off and on there.


def _rotors(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    water: Hydrodynamics,
    rotors: Sequence[int],
    radii: Sequence[float],
) -> Rotors:
    """Return what the law of thrust takes of some actuators with propellers of some radii [m]."""
    sites = model.actuator_trnid[rotors, 0]
    controls = model.actuator_ctrladr[rotors]
    losses = WATER_COLUMNS * model.nbody + np.array(rotors, dtype=np.int64)
    addresses = [model.actuator_actadr[rotors], controls, sites, model.site_bodyid[sites]]
    return (
        _columns([*addresses, losses, losses + model.nactuator, rotors], np.int64),
        _columns([*model.actuator_ctrlrange[controls].T, radii], np.float64),
        model.actuator_user,
        water.surface,
        data.ctrl,
        data.act,
        data.userdata,
        data.site_xpos,
    )


def _motors(
    model: mujoco.MjModel, data: mujoco.MjData, names: Sequence[str], drives: Sequence[JointDrive]
) -> Motors:
    """Return what the law of efforts takes of the servos of some joints."""
    joints = [model.joint(name).id for name in names]
    servos = [model.actuator(f"{name}/servo").id for name in names]
    is_limited = model.actuator_forcelimited[servos].astype(bool)
    strongest = np.where(is_limited, model.actuator_forcerange[servos, 1], math.inf)
    places = [model.jnt_qposadr[joints], model.jnt_dofadr[joints]]
    efficiencies = [drive.efficiency for drive in drives]
    copper_losses = [drive.copper_loss for drive in drives]
    return (
        float(model.opt.timestep),
        _columns([*places, model.actuator_ctrladr[servos], servos], np.int64),
        _columns([strongest, efficiencies, copper_losses], np.float64),
        model.actuator_gainprm,
        model.actuator_biasprm,
        data.ctrl,
        data.qpos,
        data.qvel,
        data.qfrc_applied,
    )


def _columns(columns: list[Any], dtype: type) -> npt.NDArray[Any]:
    """The columns side by side, (n, k); n may be 0."""
    return np.array([np.asarray(column) for column in columns], dtype=dtype).T.copy()

"""The present thrusts, joint efforts and electric power of a vehicle with dynamics.

All are computed from the engine's state after a step: the thrust of each rotor at its present speed
in the water around it, and the effort of each servo in that step. Mimic joints also have a servo,
and therefore a motor.
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
    """The thrusters of a vehicle in the order of its hydrodynamics file, then its moving joints."""

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
        """Find the actuators in the model.

        Args:
            model: the engine's model.
            data: the engine's state.
            water: the hydrodynamics of the engine.
            vehicle: the spec of the vehicle's hydrodynamics.
            robot: the links and joints of the vehicle.
            index: the index of the vehicle in the scene.
            refresh: the function that updates the poses in ``data``.
        """
        from . import power_kernel

        self._kernel, self._refresh = power_kernel, refresh
        moving_joints = [joint for joint in robot.joints if joint.moves]
        self.thrusters = tuple(spec.name for spec in vehicle.thrusters)
        """The names of the thrusters."""
        self.joints = tuple(joint.name for joint in moving_joints)
        """The names of the joints that move, including mimic joints."""
        powers = [greatest_power(thruster, water.density) for thruster in vehicle.thrusters]
        self.greatest_power = math.fsum(powers)
        """The electric power of all thrusters at their greatest thrusts [W]."""
        n_terms = max(
            (power_table(spec, 1.0).shape[1] - 1 for spec in vehicle.thrusters), default=0
        )
        self._tables = np.array(
            [power_table(thruster, water.density, n_terms) for thruster in vehicle.thrusters]
        ).reshape(-1, 2, 1 + n_terms)
        rotors = [model.actuator(vehicle_thruster(index, name)).id for name in self.thrusters]
        radii = [spec.radius for spec in vehicle.thrusters]
        self._rotors = _rotors(model, data, water, rotors, radii)
        names = [vehicle_joint(index, name) for name in self.joints]
        drives = [vehicle.drive(joint.name) for joint in moving_joints]
        self._motors = _motors(model, data, names, drives)

    def thrusts(self) -> Array:
        """Compute the thrusts along the thrusters' directions in the present water, (n,) [N].

        The inflow into the thrusters is that of the engine's last evaluation of forces.
        """
        self._refresh()
        return self._kernel.thrusts(*self._rotors)

    def efforts(self) -> Array:
        """Compute the efforts of the servos, or the commanded efforts where servos are off.

        Returns:
            The efforts, (m,) [N m or N].
        """
        return self._kernel.efforts(*self._motors)

    @cached_property
    def compiled_powers(self) -> CompiledFunction:
        """The compiled function that writes `powers`."""
        row = self._kernel.powers_record(self._tables, self._rotors, self._motors)
        return CompiledFunction(
            addresses=(function_address(self._kernel.write_powers), address_of(row)),
            prepare=lambda _: self._refresh(),
            memory_owners=(self, row),
        )

    def powers(self) -> Array:
        """Compute the electric power of the thrusters, then of the joints, (n + m,) [W]."""
        self._refresh()
        return self._kernel.powers(self._tables, self._rotors, self._motors)


# The arrays of gains and of the state are views into the engine's memory, because they change; the
# gains change when a servo is switched on or off. The arrays of indices and properties are copies.


def _rotors(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    water: Hydrodynamics,
    rotors: Sequence[int],
    radii: Sequence[float],
) -> Rotors:
    """Return the arguments of `power_kernel.thrusts`.

    Args:
        model: the engine's model.
        data: the engine's state.
        water: the hydrodynamics of the engine.
        rotors: the actuator ids of the thrusters, n of them.
        radii: the radius of each propeller [m].
    """
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
    """Return the arguments of `power_kernel.efforts` for the servos of some joints."""
    joints = [model.joint(name).id for name in names]
    servos = [model.actuator(f"{name}/servo").id for name in names]
    is_limited = model.actuator_forcelimited[servos].astype(bool)
    max_efforts = np.where(is_limited, model.actuator_forcerange[servos, 1], math.inf)
    addresses = [model.jnt_qposadr[joints], model.jnt_dofadr[joints]]
    efficiencies = [drive.efficiency for drive in drives]
    copper_losses = [drive.copper_loss for drive in drives]
    return (
        float(model.opt.timestep),
        _columns([*addresses, model.actuator_ctrladr[servos], servos], np.int64),
        _columns([max_efforts, efficiencies, copper_losses], np.float64),
        model.actuator_gainprm,
        model.actuator_biasprm,
        data.ctrl,
        data.qpos,
        data.qvel,
        data.qfrc_applied,
    )


def _columns(columns: list[Any], dtype: type) -> npt.NDArray[Any]:
    """Return k columns of length n side by side, (n, k); n may be 0."""
    return np.array([np.asarray(column) for column in columns], dtype=dtype).T.copy()

"""The actuation of a vehicle with dynamics: autopilot, thrusters, fins and joint servos."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import mujoco
import numpy as np

from ...base.geometry import Array, Pose
from ...base.record import Record
from ...model.balance import balance_of
from ...model.body_names import vehicle_body, vehicle_fin, vehicle_joint, vehicle_thruster
from ...model.scene_model import SceneModel
from ...scene.hydrodynamics import VehicleHydrodynamics
from ...scene.urdf.robot import RobotSpec
from ..poses import Poses
from .actuators import Actuators
from .allocation import thrusters_on_base
from .autopilot import Autopilot, AutopilotModel, AutopilotState, BaseAddresses, autopilot_model
from .servos import Servos, ServosState

if TYPE_CHECKING:
    from ..hydrodynamics.hydrodynamics import Hydrodynamics


@dataclass(slots=True)
class ActuationState(Record):
    """The state of the actuation of a vehicle."""

    autopilot: AutopilotState
    """The state of the autopilot."""
    servos: ServosState
    """The state of the joint servos."""


class VehicleActuation:
    """The actuation of one vehicle with dynamics.

    Args:
        index: the index of the vehicle in the scene.
        autopilot: the parameters of the autopilot.
        robot: the links and joints of the vehicle.
        dynamics: the hydrodynamics of the vehicle.
        data: the engine's state.
        water: the hydrodynamics of the engine.
        poses: the poses of all bodies.
    """

    def __init__(
        self,
        index: int,
        autopilot: AutopilotModel,
        robot: RobotSpec,
        dynamics: VehicleHydrodynamics,
        data: mujoco.MjData,
        water: Hydrodynamics,
        poses: Poses,
    ) -> None:
        self._index, self._robot, self._dynamics = index, robot, dynamics
        self._data, self._water, self._refresh = data, water, poses.refresh
        self.thrusters = tuple(thruster.name for thruster in dynamics.thrusters)
        """The names of the thrusters, in the order of the hydrodynamics file."""
        self.fins = tuple(fin.name for fin in dynamics.fins)
        """The names of the fins, in the order of the hydrodynamics file."""
        self._thrusters = [water.thruster(vehicle_thruster(index, name)) for name in self.thrusters]
        self._fins = [vehicle_fin(index, name) for name in self.fins]
        self.servos = Servos(water.model, data, robot, index)
        """The servos of the joints."""
        self.autopilot = Autopilot(autopilot)
        """The autopilot of the vehicle."""
        self.state = ActuationState(self.autopilot.state, self.servos.state)
        """The state of the autopilot and of the servos."""
        self.autopilot.hold(poses.vehicle(index))

    def hold(self, world_from_base: Pose) -> None:
        """Stop the thrusters, set the fins to 0, and hold the depth and heading of a pose."""
        for thruster in self._thrusters:
            self._water.stop_thruster(self._data, thruster)
        for fin in self._fins:
            self._water.stop_fin(self._data, fin)
        self.autopilot.hold(world_from_base)

    def turn_fins(self, angles: Array) -> None:
        """Command the angles of the fins, (n,) [rad]."""
        for fin, angle in zip(self._fins, angles.tolist(), strict=True):
            self._water.turn_fin(self._data, fin, angle)

    def set_rotors(self, speeds: Array) -> None:
        """Set the rotors, without their lag, to the commands that they would hold, (n,) [1]."""
        for thruster, speed in zip(self._thrusters, speeds.tolist(), strict=True):
            self._water.set_rotor(self._data, thruster, speed)

    def commands(self) -> Array:
        """Return the commands of the thrusters as shares of the largest command, (n,) [-1..1].

        A command beyond a limit counts as the limit, as in the engine.
        """
        model = self._water.model
        actuators = [self._water.thrusters[index] for index in self._thrusters]
        lower, upper = model.actuator_ctrlrange[actuators].T
        max_commands = np.maximum(np.abs(lower), np.abs(upper))
        commands = np.clip(self._data.ctrl[model.actuator_ctrladr[actuators]], lower, upper)
        shares: Array = commands / np.where(max_commands > 0.0, max_commands, 1.0)
        return shares

    def set_loss(self, thruster: int, loss: float) -> None:
        """Set the fraction of its thrust that a thruster loses, by index: 0 healthy, 1 dead."""
        self._water.set_loss(self._data, self._thrusters[thruster], loss)

    def measure_thrusts(self) -> tuple[Array, Array, Array]:
        """Return the places, directions and present thrusts of the thrusters.

        Returns:
            The centres of the propellers in W, (n, 3) [m], the directions of positive thrust in W,
            (n, 3), and the thrusts, (n,) [N].
        """
        thrusts = self.actuators().thrusts()
        actuators = [self._water.thrusters[index] for index in self._thrusters]
        sites = self._water.model.actuator_trnid[actuators, 0]
        axes = self._data.site_xmat[sites].reshape(-1, 3, 3)[:, :, 0]
        return self._data.site_xpos[sites].copy(), axes.copy(), thrusts

    def actuators(self) -> Actuators:
        """Return the view of the actuators' thrusts, efforts and electric power."""
        return Actuators(
            self._water.model,
            self._data,
            self._water,
            self._dynamics,
            self._robot,
            self._index,
            self._refresh,
        )


def make_actuation(
    scene_model: SceneModel, data: mujoco.MjData, water: Hydrodynamics | None, poses: Poses
) -> dict[int, VehicleActuation]:
    """Return the actuation of each vehicle with dynamics, by index; empty without water."""
    if water is None:
        return {}
    robots, autopilots = scene_model.robots, scene_model.compute_once(_autopilot_models)
    return {
        i: VehicleActuation(i, autopilots[i], robots[i], dynamics, data, water, poses)
        for i, dynamics in scene_model.dynamics.items()
    }


def _autopilot_models(scene_model: SceneModel) -> dict[int, AutopilotModel]:
    """Return the parameters of the autopilot of each vehicle with dynamics, by index."""
    model = scene_model.engine_model
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    models = {}
    for index, dynamics in scene_model.dynamics.items():
        vehicle, robot = scene_model.scene.vehicles[index], scene_model.robots[index]
        base = model.body(vehicle_body(index, robot.root)).id
        free_joint = model.joint(vehicle_joint(index, ""))
        names = [vehicle_thruster(index, thruster.name) for thruster in dynamics.thrusters]
        up = data.xmat[base, 6:]  # the z axis of W in base axes, (3,)
        models[index] = autopilot_model(
            dynamics,
            robot.root,
            float(model.body_subtreemass[base]),
            BaseAddresses(
                qpos_address=int(free_joint.qposadr[0]),
                dof_address=int(free_joint.dofadr[0]),
                body=base,
                ctrl_addresses=[int(model.actuator_ctrladr[model.actuator(n).id]) for n in names],
                is_over_ground=vehicle.velocity_loop == "ground",
            ),
            stiffness=balance_of(robot, dynamics, vehicle.joint_values).stiffness(up),
            thrusters=thrusters_on_base(robot, dynamics.thrusters, vehicle.joint_values),
        )
    return models

"""The physics engine of a scene: MuJoCo's model and data, and the parts that act on them."""

from __future__ import annotations

import copy
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Literal

import mujoco
import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Pose, quaternion_from_rotation
from ..base.numerics.linear import cross, rotate, rotate_back
from ..model.body_names import loose_joint, vehicle_joint
from ..model.scene_model import SceneModel
from ..scene.spec import SceneSpec
from ..scene.urdf.kinematics import joint_positions
from ..scene.urdf.robot import RobotSpec
from .actuation.vehicle_actuation import make_actuation
from .bounce_limit import BounceLimit
from .collision.contacts import EngineContacts, body_name
from .collision.world_tree import place_fixed_shapes
from .engine_memory import EngineMemory
from .engine_state import EngineState, ModelState
from .engine_warnings import StepCheck
from .grips import Grips
from .hydrodynamics.submerged import SubmergedBodies
from .hydrodynamics.water_function import DriftFunction, WaterFunction, apply_drift
from .joint_wrench import JointWrench
from .kinematics.lift import Lift
from .kinematics.link_motion import LinkMotion
from .kinematics.prescribed_motion import PrescribedMotion
from .motion import Motion
from .original_physics import OriginalPhysics
from .poses import Poses
from .scaled import ScaledLinks

if TYPE_CHECKING:
    from .hydrodynamics.hydrodynamics import Hydrodynamics
    from .stepper import Stepper

Kind = Literal["vehicle", "object"]
"""The kinds of scene elements that have a body."""


class Engine:
    """The physics engine of a scene: state, forces and step.

    A joint vector has the movable joints that are not mimic joints, in the order of UWSim; mimic
    joints follow them. Vehicles and objects are identified by their index in the scene. Forces move
    vehicles with hydrodynamics; kinematic vehicles keep their poses until these are set or the
    vehicles drift with the water.

    Args:
        scene_model: the model of the scene.
    """

    def __init__(self, scene_model: SceneModel) -> None:
        scene, robots, dynamics = scene_model.scene, scene_model.robots, scene_model.dynamics
        shapes = scene_model.shapes
        self._robots, self._dynamics = robots, dynamics
        # a copy, as servos, grips and lifts change its numbers
        self._model = model = copy.copy(scene_model.compute_once(_corrected_model))
        self._data = data = mujoco.MjData(model)
        place_fixed_shapes(model, data)
        names = [body_name(scene, model.body(i).name) for i in range(model.nbody)]
        self.motion = Motion(model, data, names)
        """The positions and velocities of all bodies, as one row of numbers."""
        self.poses = Poses(scene_model, model, data)
        """The poses of all bodies."""
        self.link_motion = LinkMotion(model, data, self.poses)
        """The motion of points on the links of vehicles."""
        self.grips = Grips(model, data, self.poses, shapes)
        """The objects that vehicles hold."""
        self.contacts = EngineContacts(scene_model, model, data, self.poses)
        """The contacts of bodies with dynamics."""
        self._check = StepCheck(model, data, names)
        self._kinematic_vehicles = [i for i in robots if i not in dynamics]
        joints = {i: model.joint(vehicle_joint(i, "")).id for i in robots}
        self._base_addresses = {i: int(model.jnt_qposadr[joint]) for i, joint in joints.items()}
        self._base_dofs = {i: int(model.jnt_dofadr[joint]) for i, joint in joints.items()}
        starts = np.array([self._base_addresses[i] for i in self._kinematic_vehicles], np.intp)
        self._kinematic_addresses = starts[:, None] + np.arange(7)  # (n, 7), of poses in ``qpos``
        self._joint_addresses = {i: joint_addresses(model, robots[i], i) for i in robots}
        self._scaled_links = {
            i: ScaledLinks(model, robots[i], i, vehicle.scale_factor)
            for i, vehicle in enumerate(scene.vehicles)
            if i not in dynamics and vehicle.scale_factor != (1.0, 1.0, 1.0)
        }
        self._water: Hydrodynamics | None = _attach_water(model) if dynamics else None
        self.joint_wrench = JointWrench(model, data, self.poses)
        """The wrenches of links on their parent joints."""
        self.actuation = make_actuation(scene_model, data, self._water, self.poses)
        """The actuation of each vehicle with dynamics, by index."""
        self._set_initial_joints(scene)
        self.submerged_bodies = SubmergedBodies(model, self.poses, self._water, dynamics)
        """The bodies that the water acts on."""
        self._bounce_limit = _make_limit(scene, model, data)
        self._stepper = self._make_stepper([joints[i] for i in self._kinematic_vehicles])
        self.lift = Lift(model, data)
        """The bodies that begin in the ground and are lifted out of it."""
        self._original_physics = (
            OriginalPhysics(scene, model, data) if scene.has_original_physics else None
        )
        self.state = EngineState(
            memory=EngineMemory(data, self.contacts.clear_cache),
            model=ModelState.from_model(model),
            n_steps=0,
            actuation={i: actuation.state for i, actuation in self.actuation.items()},
            poses=self.poses.state,
            grips=self.grips.state,
            contacts=self.contacts.state,
            lift=self.lift.state,
            bounces=self._bounce_limit.state if self._bounce_limit else None,
            stepper=self._stepper.state if self._stepper else None,
            original_physics=self._original_physics.state if self._original_physics else None,
        )
        """The state of the physics."""

    @property
    def is_dynamic(self) -> bool:
        """True if at least one vehicle has dynamics."""
        return self._water is not None

    @property
    def needs_single_steps(self) -> bool:
        """True if steps must be taken one by one, as a body is carried or lifted in every step."""
        return self.grips.is_carrying or self.lift.is_active

    def has_dynamics(self, index: int) -> bool:
        """Return whether a vehicle has dynamics: forces move it."""
        return index in self.actuation

    @property
    def n_steps(self) -> int:
        """The number of steps taken, including one that failed."""
        return self.state.n_steps

    def step(
        self,
        n: int,
        water: WaterFunction | None,
        samples: npt.NDArray[np.void] | None = None,
        step: int = 0,
        *,
        samples_last: bool = False,
        drift: DriftFunction | None = None,
    ) -> bool:
        """Advance all bodies that forces move by some steps.

        Args:
            n: the number of steps.
            water: the motion of the water at the bodies that it acts on; None in still water.
            samples: the samples to take after each step but the last, a record of
                `sampling.TABLE`, (1,).
            step: the number of the first step, as the timers of the samples count steps.
            samples_last: take samples after the last step, too.
            drift: moves the kinematic vehicles with the water; None: they do not drift.

        Returns:
            True if a timer of the samples was due after the last step, and they were taken.

        Raises:
            SimulationFailed: the engine warned, or a body exceeds its speed limit, so that results
                would be invalid.
        """
        if self._stepper is None:
            return False
        if water is not None and water.needs_points:
            self.poses.refresh()
        self.grips.follow()
        self.lift.begin_step()
        if self._bounce_limit is not None:
            self._bounce_limit.is_on = not self.grips.is_holding
        try:
            is_sampled = self._stepper.run(
                n,
                self.state.n_steps,
                water,
                samples,
                step,
                samples_last=samples_last,
                drift=drift,
            )
        finally:
            self.state.n_steps = self._stepper.n_steps
        self.lift.end_step()
        self.contacts.invalidate(are_current=True)
        self.poses.mark_stale()
        return is_sampled

    def apply_wrenches(self, wrenches: Iterable[tuple[int, Array, Array]]) -> None:
        """Set the external wrenches on bodies, which act in all steps until the next call.

        Args:
            wrenches: for each wrench, the MuJoCo ID of the body, a point in the body's frame
                (3,) [m], and the force and the torque about this point, in W, (6,) [N, N m].
        """
        self.poses.refresh()
        axes, middles = self._data.xmat.reshape(-1, 3, 3), self._model.body_ipos
        applied = self._data.xfrc_applied
        applied[:] = 0.0
        for body, point, wrench in wrenches:
            applied[body] += wrench
            applied[body, 3:] += cross(rotate(axes[body], point - middles[body]), wrench[:3])

    def step_original_physics(self) -> None:
        """Advance the physics of UWSim (`OriginalPhysics`) by one step, if the scene uses it.

        Raises:
            SimulationFailed: the engine warned, so that results would be invalid.
        """
        if self._original_physics is None:
            return
        self.grips.follow()
        self.lift.begin_step()
        self._original_physics.step()
        self.lift.end_step()
        if self._bounce_limit is not None:
            self._bounce_limit.is_on = not self.grips.is_holding
            self._bounce_limit.apply()
        self.state.n_steps += 1
        self._check.end_if_warned(self.state.n_steps)
        self.contacts.invalidate(are_current=True)
        self.poses.mark_stale()

    def find_deep_bodies(self, depth: float) -> list[tuple[Kind, int]]:
        """Return the vehicles with dynamics and loose objects that now penetrate a fixed body.

        Args:
            depth: the minimum depth of the penetration along the contact normal [m].
        """
        data = copy.copy(self._data)
        mujoco.mj_kinematics(self._model, data)
        mujoco.mj_collision(self._model, data)
        bodies = self._model.geom_bodyid[data.contact.geom[data.contact.dist < -depth]]
        is_fixed = self._model.body_weldid[bodies] == 0  # (n, 2)
        moving_bodies = bodies[(is_fixed.sum(axis=1) == 1)[:, None] & ~is_fixed]
        names = {self._model.body(int(body)).name for body in moving_bodies}
        owners = {(kind, int(index)) for kind, index in (name.split("/")[:2] for name in names)}
        keys: list[tuple[Kind, int]] = [("vehicle", i) for i in self.actuation]
        keys += [("object", i) for k, i in sorted(owners) if k == "object"]
        return [key for key in keys if key in owners]

    def begin_lift(self, kind: Kind, index: int, rise: float) -> None:
        """Lift a vehicle with dynamics or a loose object from its present pose by a height [m]."""
        poses = self.poses
        body = poses.base(index) if kind == "vehicle" else poses.loose_body(index)
        if body is not None:
            self.lift.add(body, rise)

    def vehicle_velocity(self, index: int) -> Array:
        """Return the twist of a vehicle's base over ground, in base axes, (6,) [m/s, rad/s]."""
        dof = self._base_dofs[index]
        twist: Array = self._data.qvel[dof : dof + 6].copy()
        twist[:3] = rotate_back(self.poses.vehicle(index).rotation, twist[:3])
        return twist

    def place_vehicle(
        self,
        index: int,
        world_from_base: Pose,
        twist: Array | None = None,
        *,
        stops_actuators: bool = True,
    ) -> None:
        """Set the pose of a vehicle.

        Args:
            index: the index of the vehicle.
            world_from_base: the pose of its base in W.
            twist: the twist of the base over ground, in base axes, (6,) [m/s, rad/s], of a vehicle
                with dynamics; None: at rest.
            stops_actuators: stop thrusters and fins, and hold the new depth and heading; False:
                the vehicle keeps its commands.
        """
        start, dof = self._base_addresses[index], self._base_dofs[index]
        self._data.qpos[start : start + 3] = world_from_base.position
        self._data.qpos[start + 3 : start + 7] = quaternion_from_rotation(world_from_base.rotation)
        if index in self.actuation:
            self._data.qvel[dof : dof + 6] = 0.0
            if twist is not None:
                self._data.qvel[dof : dof + 3] = rotate(world_from_base.rotation, twist[:3])
                self._data.qvel[dof + 3 : dof + 6] = twist[3:]
            if stops_actuators:
                self.actuation[index].hold(world_from_base)
            self.contacts.invalidate(are_current=False)
        self.poses.mark_stale()

    def drift(self, drift: DriftFunction, time: float) -> None:
        """Move kinematic vehicles with the water, by a step that ends at ``time`` [s]."""
        poses: Array = self._data.qpos[self._kinematic_addresses]
        apply_drift(drift.function, drift.address, poses, time)
        self._data.qpos[self._kinematic_addresses] = poses
        self.poses.mark_stale()

    def prescribed_motion(self, index: int) -> PrescribedMotion:
        """Return the prescribed motion of a kinematic vehicle, which records from now on."""
        model, prefix = self._model, vehicle_joint(index, "")
        joints = [i for i in range(model.njnt) if model.joint(i).name.startswith(prefix)]
        return PrescribedMotion(model, self._data, joints, index, self.link_motion)

    def joints(self, index: int) -> Array:
        """Return a copy of the joint vector of a vehicle, (n,) [rad or m]."""
        joints: Array = self._data.qpos[self._joint_addresses[index]]
        return joints

    def set_joints(self, index: int, values: Array) -> None:
        """Set the joint vector of a vehicle (n,) [rad or m]; clamped to the limits.

        The servos of a vehicle with dynamics hold the joints there from now on.
        """
        if index in self.actuation:
            self.actuation[index].servos.set_positions(values)
        else:
            positions = joint_positions(self._robots[index], values.tolist())
            for name, value in positions.items():
                joint = self._model.joint(vehicle_joint(index, name))
                self._data.qpos[joint.qposadr[0]] = value
            if index in self._scaled_links:
                self._scaled_links[index].set_poses(values)
        self.poses.mark_stale()

    def _set_initial_joints(self, scene: SceneSpec) -> None:
        for index, vehicle in enumerate(scene.vehicles):
            n_joints = len(self._robots[index].movable_joints)
            values = np.zeros(n_joints)  # (n,) [rad or m]
            joint_values = vehicle.joint_values[:n_joints]
            values[: len(joint_values)] = joint_values
            self.set_joints(index, values)

    def _make_stepper(self, kinematic_joints: Sequence[int]) -> Stepper | None:
        """Return the stepper of a scene with dynamics; None for a scene without."""
        if self._water is None:
            return None
        from .stepper import Stepper

        return Stepper(
            self._data,
            self._water,
            [vehicle.autopilot for vehicle in self.actuation.values()],
            [vehicle.servos for vehicle in self.actuation.values()],
            kinematic_joints,
            self.submerged_bodies.bodies.tolist(),
            self.submerged_bodies.reference_points,
            self._check,
            self._bounce_limit,
        )


def joint_addresses(model: mujoco.MjModel, robot: RobotSpec, index: int) -> npt.NDArray[np.intp]:
    """Return the addresses of a vehicle's joint vector in ``qpos``, (n,)."""
    names = [vehicle_joint(index, joint.name) for joint in robot.movable_joints]
    return np.array([model.joint(name).qposadr[0] for name in names], dtype=np.intp)


def _make_limit(scene: SceneSpec, model: mujoco.MjModel, data: mujoco.MjData) -> BounceLimit | None:
    """Return the limit on the energy of loose objects; None if no object has a restitution."""
    if all(spec.solid.restitution is None for spec in scene.objects):
        return None
    body_numbers = {model.joint(i).name: int(model.jnt_bodyid[i]) for i in range(model.njnt)}
    joint_names = [loose_joint(i) for i in range(len(scene.objects))]
    bodies = [body_numbers[name] for name in joint_names if name in body_numbers]
    return BounceLimit(model, data, bodies) if bodies else None


def _corrected_model(scene_model: SceneModel) -> mujoco.MjModel:
    """Return the engine's model with added mass in its inverse weights; engines copy it."""
    if not scene_model.dynamics:
        return scene_model.engine_model
    from .hydrodynamics.hydrodynamics import install

    model = copy.copy(scene_model.engine_model)
    install(model)
    return model


def _attach_water(model: mujoco.MjModel) -> Hydrodynamics:
    """Return the hydrodynamics of an engine's model."""
    from .hydrodynamics.hydrodynamics import attach

    return attach(model)

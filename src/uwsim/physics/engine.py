"""The physics engine of a scene: MuJoCo's model and data, read as copies."""

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
from .hydrodynamics.water_function import DriftFunction, WaterFunction, move_placed
from .joint_wrench import JointWrench
from .kinematics.lift import Lift
from .kinematics.link_motion import LinkMotion
from .kinematics.placed_motion import PlacedMotion
from .motion import Motion
from .poses import Poses
from .scaled import ScaledLinks
from .uwsim_physics import UwsimPhysics

if TYPE_CHECKING:
    from .hydrodynamics.hydrodynamics import Hydrodynamics
    from .stepper import Stepper

Kind = Literal["vehicle", "object"]
"""Of what has a body."""


class Engine:
    """The physics engine of a scene: state, forces and step.

    Joint vectors hold the movable, non-mimic joints in UWSim's order; mimic joints follow.
    Vehicles with hydrodynamics are simulated, the others stay where they are put.

    Args:
        scene_model: the model of the scene.
    """

    def __init__(self, scene_model: SceneModel) -> None:
        scene, robots, dynamics = scene_model.scene, scene_model.robots, scene_model.dynamics
        shapes = scene_model.shapes
        self._robots, self._dynamics = robots, dynamics
        # its own: servos, grips and lifts change numbers of it
        self._model = model = copy.copy(scene_model.compute_once(_corrected_model))
        self._data = data = mujoco.MjData(model)
        place_fixed_shapes(model, data)
        names = [body_name(scene, model.body(i).name) for i in range(model.nbody)]
        self.motion = Motion(model, data, names)
        """Positions and velocities of all bodies, as one row of numbers."""
        self.poses = Poses(scene_model, model, data)
        """Where everything is, as frames."""
        self.link_motion = LinkMotion(model, data, self.poses)
        """How the links of vehicles move."""
        self.grips = Grips(model, data, self.poses, dynamics, shapes)
        """Objects that vehicles hold."""
        self.contacts = EngineContacts(scene_model, model, data, self.poses)
        """Contacts between what it simulates."""
        self._check = StepCheck(model, data, names)
        self._placed = [i for i in robots if i not in dynamics]
        free = {i: model.joint(vehicle_joint(i, "")).id for i in robots}
        self._free_places = {i: int(model.jnt_qposadr[joint]) for i, joint in free.items()}
        self._free_dofs = {i: int(model.jnt_dofadr[joint]) for i, joint in free.items()}
        places = [range(self._free_places[i], self._free_places[i] + 7) for i in self._placed]
        self._placed_places = np.array(places, np.intp).reshape(-1, 7)  # of poses in ``qpos``
        self._joint_places = {i: joint_places(model, robots[i], i) for i in robots}
        self._scaled = {
            i: ScaledLinks(model, robots[i], i, vehicle.scale_factor)
            for i, vehicle in enumerate(scene.vehicles)
            if i not in dynamics and vehicle.scale_factor != (1.0, 1.0, 1.0)
        }
        self._water: Hydrodynamics | None = _water_of(model) if dynamics else None
        self.joint_wrench = JointWrench(model, data, self.poses)
        """What links do to the joints that carry them."""
        self.actuation = make_actuation(scene_model, data, self._water, self.poses)
        """What moves each simulated vehicle, by its number."""
        self._set_first_joints(scene)
        self.submerged = SubmergedBodies(model, self.poses, self._water, dynamics)
        """The bodies that the water acts on."""
        self._bounces = _bounces_of(scene, model, data)
        self._stepper = self._make_stepper([free[i] for i in self._placed])
        self.lift = Lift(model, data)
        """Bodies that begin in the ground, on their way out of it."""
        self._uwsim_physics = UwsimPhysics(scene, model, data) if scene.has_uwsim_physics else None
        self.state = EngineState(
            memory=EngineMemory(data, self.contacts.clear_cache),
            model=ModelState.of(model),
            n_steps=0,
            actuation={i: each.state for i, each in self.actuation.items()},
            poses=self.poses.state,
            grips=self.grips.state,
            contacts=self.contacts.state,
            lift=self.lift.state,
            bounces=self._bounces.state if self._bounces else None,
            stepper=self._stepper.state if self._stepper else None,
            uwsim_physics=self._uwsim_physics.state if self._uwsim_physics else None,
        )
        """What changes of the physics."""

    @property
    def is_dynamic(self) -> bool:
        """Whether anything is simulated."""
        return self._water is not None

    @property
    def moves_by_step(self) -> bool:
        """Whether something is placed at every step: it is carried, or lifted."""
        return self.grips.is_carrying or self.lift.is_active

    def is_simulated(self, index: int) -> bool:
        """Whether a vehicle is moved by forces."""
        return index in self.actuation

    @property
    def n_steps(self) -> int:
        """Steps taken; one that failed counts."""
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
        """Advance all simulated bodies by some steps.

        Args:
            n: how many.
            water: how it moves at the bodies that it acts on; None: it is still.
            samples: taken after each step but the last, a record of `sampling.TABLE`, (1,).
            step: the number of the first step by the clock of the samples.
            samples_last: take them after the last step, too.
            drift: moves the vehicles that are not simulated; None: they stay.

        Returns:
            Whether a timer of the samples was due after the last step, and they were taken.

        Raises:
            SimulationFailed: the engine warned, or a body moves faster than can be: what follows
                would not be true.
        """
        if self._stepper is None:
            return False
        if water is not None and water.needs_points:
            self.poses.refresh()
        self.grips.follow()
        self.lift.begin_step()
        if self._bounces is not None:
            self._bounces.is_on = not self.grips.is_holding
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
        self.poses.moved()
        return is_sampled

    def push(self, wrenches: Iterable[tuple[int, Array, Array]]) -> None:
        """Let wrenches act on bodies in the steps from now on, in place of those before.

        Args:
            wrenches: the number of a body of the engine, a point in its frame (3,) [m], and the
                force and the torque about this point, in W, (6,) [N, N m].
        """
        self.poses.refresh()
        axes, middles = self._data.xmat.reshape(-1, 3, 3), self._model.body_ipos
        applied = self._data.xfrc_applied
        applied[:] = 0.0
        for body, point, wrench in wrenches:
            applied[body] += wrench
            applied[body, 3:] += cross(rotate(axes[body], point - middles[body]), wrench[:3])

    def fall(self) -> None:
        """Advance the original's physics by one step, if the scene uses it.

        Raises:
            SimulationFailed: the engine warned: what follows would not be true.
        """
        if self._uwsim_physics is None:
            return
        self.grips.follow()
        self.lift.begin_step()
        self._uwsim_physics.step()
        self.lift.end_step()
        if self._bounces is not None:
            self._bounces.is_on = not self.grips.is_holding
            self._bounces.apply()
        self.state.n_steps += 1
        self._check.end_if_warned(self.state.n_steps)
        self.contacts.invalidate(are_current=True)
        self.poses.moved()

    def deep_at_start(self, depth: float) -> list[tuple[Kind, int]]:
        """Return the simulated vehicles and loose objects that are in something fixed now.

        Args:
            depth: of at least this [m], in any direction.
        """
        data = copy.copy(self._data)
        mujoco.mj_kinematics(self._model, data)
        mujoco.mj_collision(self._model, data)
        bodies = self._model.geom_bodyid[data.contact.geom[data.contact.dist < -depth]]
        is_fixed = self._model.body_weldid[bodies] == 0  # (n, 2)
        moving = bodies[(is_fixed.sum(axis=1) == 1)[:, None] & ~is_fixed]
        names = {self._model.body(int(body)).name for body in moving}
        owners = {(kind, int(index)) for kind, index in (name.split("/")[:2] for name in names)}
        simulated: list[tuple[Kind, int]] = [("vehicle", i) for i in self.actuation]
        loose: list[tuple[Kind, int]] = [("object", i) for k, i in sorted(owners) if k == "object"]
        return [each for each in (*simulated, *loose) if each in owners]

    def begin_lift(self, kind: Kind, index: int, rise: float) -> None:
        """Lift a simulated vehicle or a loose object from where it is by some height [m]."""
        poses = self.poses
        body = poses.base(index) if kind == "vehicle" else poses.loose_body(index)
        if body is not None:
            self.lift.add(body, rise)

    def vehicle_velocity(self, index: int) -> Array:
        """Return the twist of a vehicle's base over ground, base axes, (6,) [m/s, rad/s]."""
        first = self._free_dofs[index]
        twist: Array = self._data.qvel[first : first + 6].copy()
        twist[:3] = rotate_back(self.poses.vehicle(index).rotation, twist[:3])
        return twist

    def place_vehicle(self, index: int, world_from_base: Pose) -> None:
        """Set the pose of a vehicle, at rest."""
        place, dof = self._free_places[index], self._free_dofs[index]
        self._data.qpos[place : place + 3] = world_from_base.position
        self._data.qpos[place + 3 : place + 7] = quaternion_from_rotation(world_from_base.rotation)
        if index in self.actuation:
            self._data.qvel[dof : dof + 6] = 0.0
            self.actuation[index].hold(world_from_base)
            self.contacts.invalidate(are_current=False)
        self.poses.moved()

    def drift(self, drift: DriftFunction, time: float) -> None:
        """Move the vehicles that are not simulated by a step that ends at ``time`` [s]."""
        poses: Array = self._data.qpos[self._placed_places]
        move_placed(drift.function, drift.address, poses, time)
        self._data.qpos[self._placed_places] = poses
        self.poses.moved()

    def placed_motion(self, index: int) -> PlacedMotion:
        """Return how a vehicle that is not simulated moves; it records from now on."""
        model, prefix = self._model, vehicle_joint(index, "")
        joints = [i for i in range(model.njnt) if model.joint(i).name.startswith(prefix)]
        return PlacedMotion(model, self._data, joints, index, self.link_motion)

    def joints(self, index: int) -> Array:
        """Return a copy of the joint vector of a vehicle, (n,) [rad or m]."""
        joints: Array = self._data.qpos[self._joint_places[index]]
        return joints

    def set_joints(self, index: int, values: Array) -> None:
        """Set the joint vector of a vehicle (n,) [rad or m]; clamped to the limits.

        A simulated vehicle's servos hold the joints there from now on.
        """
        if index in self.actuation:
            self.actuation[index].servos.set_positions(values)
        else:
            positions = joint_positions(self._robots[index], values.tolist())
            for name, value in positions.items():
                joint = self._model.joint(vehicle_joint(index, name))
                self._data.qpos[joint.qposadr[0]] = value
            if index in self._scaled:
                self._scaled[index].follow(values)
        self.poses.moved()

    def _set_first_joints(self, scene: SceneSpec) -> None:
        for index, vehicle in enumerate(scene.vehicles):
            n_joints = len(self._robots[index].movable_joints)
            values = np.zeros(n_joints)  # (n,) [rad or m]
            given = vehicle.joint_values[:n_joints]
            values[: len(given)] = given
            self.set_joints(index, values)

    def _make_stepper(self, placed: Sequence[int]) -> Stepper | None:
        """Make the stepper of a scene with simulated vehicles; ``placed`` joints are fixed."""
        if self._water is None:
            return None
        from .stepper import Stepper

        return Stepper(
            self._data,
            self._water,
            [each.autopilot for each in self.actuation.values()],
            [each.servos for each in self.actuation.values()],
            placed,
            self.submerged.bodies.tolist(),
            self.submerged.felt_at,
            self._check,
            self._bounces,
        )


def joint_places(model: mujoco.MjModel, robot: RobotSpec, index: int) -> npt.NDArray[np.intp]:
    """Where the joint vector of a vehicle lies in ``qpos``, (n,)."""
    names = [vehicle_joint(index, joint.name) for joint in robot.movable_joints]
    return np.array([model.joint(name).qposadr[0] for name in names], dtype=np.intp)


def _bounces_of(scene: SceneSpec, model: mujoco.MjModel, data: mujoco.MjData) -> BounceLimit | None:
    """The bound on the energy of loose objects; None where nothing has a restitution."""
    if all(thing.solid.restitution is None for thing in scene.objects):
        return None
    names = {model.joint(i).name: int(model.jnt_bodyid[i]) for i in range(model.njnt)}
    loose = [loose_joint(i) for i in range(len(scene.objects))]
    bodies = [names[name] for name in loose if name in names]
    return BounceLimit(model, data, bodies) if bodies else None


def _corrected_model(scene_model: SceneModel) -> mujoco.MjModel:
    """Return the model that the engines of a scene copy: with the water in its inverse weights."""
    if not scene_model.dynamics:
        return scene_model.engine_model
    from .hydrodynamics.hydrodynamics import install

    model = copy.copy(scene_model.engine_model)
    install(model)
    return model


def _water_of(model: mujoco.MjModel) -> Hydrodynamics:
    """Return the hydrodynamics of an engine's model."""
    from .hydrodynamics.hydrodynamics import attach

    return attach(model)

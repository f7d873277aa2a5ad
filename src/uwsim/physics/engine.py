"""The physics engine of a scene: MuJoCo's model and data, read as copies."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Literal

import mujoco
import numpy as np
import numpy.typing as npt

from ..errors import RunFailed, UwsimError
from ..geometry import Array, Pose, quaternion_from_rotation
from ..linear import points_of, product, turned, turned_back
from ..scene.kinematics import joint_positions
from ..scene.spec import SceneSpec
from ..scene.urdf import RobotSpec
from ..world import Contact
from .actuation.actuators import Actuators
from .actuation.allocation import thrusters_on_base
from .actuation.autopilot import Autopilot
from .actuation.servos import Servos
from .balance import balance_of
from .compile import (
    compile_scene,
    object_body,
    vehicle_body,
    vehicle_fin,
    vehicle_joint,
    vehicle_thruster,
)
from .contacts import contacts_of
from .engine_warnings import say_too_fast, speeds_of, too_fast, why_untrue
from .hydrodynamics import VehicleHydrodynamics
from .motion import Motion
from .scaled import ScaledLinks, stretched_axes
from .shapes import CollisionShape
from .uwsim_physics import UwsimPhysics

if TYPE_CHECKING:
    from .hydrodynamics.hydrodynamics import Hydrodynamics

AUTOPILOT_PERIOD = 0.02
"""An autopilot thinks this often [s]."""


class Engine:
    """The physics engine of a scene: state, forces and step.

    Joint vectors hold the movable, non-mimic joints in UWSim's order; mimic joints follow.
    Vehicles with hydrodynamics are simulated, the others stay where they are put.
    """

    STATE = (
        "_engine",
        "_autopilots",
        "_servos",
        "_uwsim_physics",
        "_n_steps",
        "version",
        "_contacts_hold",
        "_is_stale",
    )
    """What of it changes as time goes by."""

    def __init__(
        self,
        scene: SceneSpec,
        robots: Mapping[int, RobotSpec],
        dynamics: Mapping[int, VehicleHydrodynamics],
        timestep: float,
        shapes: Mapping[str, Sequence[CollisionShape]],
    ) -> None:
        self._model = compile_scene(scene, robots, dynamics, timestep, shapes)
        self._owners = np.array(
            [_owner(self._model.geom(i).name) for i in range(self._model.ngeom)]
        )
        self._owner_names = [_named(scene, owner) for owner in self._owners.tolist()]
        self._touchable = frozenset(_owner(name) for name in shapes)
        self._contacts_hold = False  # whether the contacts are those of the state
        self._data = mujoco.MjData(self._model)
        # Views into MuJoCo's memory: to look them up by name costs more than the step.
        ids = {self._model.body(i).name: i for i in range(self._model.nbody)}
        self._bases = {i: ids[vehicle_body(i, robots[i].root)] for i in robots}
        self._links = {
            (i, link.name): ids[vehicle_body(i, link.name)]
            for i in robots
            for link in robots[i].links
        }
        self._objects = {
            i: ids[name] for i in range(len(scene.objects)) if (name := object_body(i)) in ids
        }
        self._fixed = {
            i: standing_pose(scene.world_from_localized @ thing.localized_from_object)
            for i, thing in enumerate(scene.objects)
            if i not in self._objects
        }
        self._warnings = self._data.warning.number
        self._velocities = self._data.qvel
        self._speeds = speeds_of(self._model)
        self._origins = self._data.xpos  # (nbody, 3) [m]
        self._axes = self._data.xmat.reshape(-1, 3, 3)  # (nbody, 3, 3)
        free = {i: self._model.joint(vehicle_joint(i, "")) for i in range(len(scene.vehicles))}
        self._frees = {
            i: self._data.qpos[joint.qposadr[0] : joint.qposadr[0] + 7] for i, joint in free.items()
        }
        self._free_velocities = {
            i: self._data.qvel[joint.dofadr[0] : joint.dofadr[0] + 6] for i, joint in free.items()
        }
        bodies = [self._model.body(i).name for i in range(self._model.nbody)]
        self._body_names = [_called(scene, name) for name in bodies]
        self.motion = Motion(self._model, self._data, self._body_names)
        """Where everything is and how it moves, as numbers."""
        self._scene = scene
        self._robots = robots
        self._dynamics = dynamics
        self._timestep = timestep
        scales = {i: vehicle.scale_factor for i, vehicle in enumerate(scene.vehicles)}
        self._scales = {i: scale for i, scale in scales.items() if scale != (1.0, 1.0, 1.0)}
        self._scaled = {
            i: ScaledLinks(self._model, robots[i], i, scale)
            for i, scale in self._scales.items()
            if i not in dynamics
        }
        self._joint_places = {i: self._places_of(i, robots[i]) for i in robots}
        self._servos = {i: Servos(self._model, self._data, robots[i], i) for i in dynamics}
        self._is_stale = True
        self._n_steps = 0
        self._autopilot_steps = max(1, round(AUTOPILOT_PERIOD / timestep))
        self._water: Hydrodynamics | None = _water_of(self._model) if dynamics else None
        bases = {self._bases[i] for i in dynamics}  # autopilots feel the water there
        self._wet = np.array(sorted({*(self._water.bodies if self._water else ()), *bases}), int)
        self._felt_at = np.array(
            [self._water.felt_at(body) for body in self._wet] if self._water else []
        ).reshape(-1, 3)
        self._set_current = (
            self._water.current_setter(self._data, self._wet) if self._water else None
        )
        self._base_rows = {i: self._wet.tolist().index(self._bases[i]) for i in dynamics}
        self._over_ground = {i: scene.vehicles[i].velocity_loop == "ground" for i in dynamics}
        self._kinematic = [i for i in robots if i not in dynamics]
        self.version = 0
        """Grows whenever something was moved."""
        for index, vehicle in enumerate(scene.vehicles):
            n_joints = len(robots[index].movable)
            values = np.zeros(n_joints)  # (n,) [rad or m]
            given = vehicle.joint_values[:n_joints]
            values[: len(given)] = given
            self.set_joints(index, values)
        self._autopilots = {i: self._make_autopilot(i) for i in dynamics}
        self._thrusters = {
            i: [
                self._water.thruster(vehicle_thruster(i, thruster.name))
                for thruster in dynamics[i].thrusters
            ]
            for i in dynamics
            if self._water is not None
        }
        self._uwsim_physics = (
            UwsimPhysics(scene, self._model, self._data) if scene.has_uwsim_physics else None
        )

    @property
    def _engine(self) -> tuple[mujoco.MjData, Array, Array, Array]:
        """MuJoCo's data, and the model parameters that servos change."""
        model = self._model
        return (
            copy.copy(self._data),
            model.jnt_limited.copy(),
            model.actuator_gainprm.copy(),
            model.actuator_biasprm.copy(),
        )

    @_engine.setter
    def _engine(self, kept: tuple[mujoco.MjData, Array, Array, Array]) -> None:
        model, (data, limited, gains, biases) = self._model, kept
        if (data.model.nq, data.nbuffer) != (model.nq, self._data.nbuffer):
            raise UwsimError("The saved simulation is not of this scene.")
        mujoco.mj_copyData(self._data, model, data)
        model.jnt_limited[:] = limited
        model.actuator_gainprm[:] = gains
        model.actuator_biasprm[:] = biases

    @property
    def is_dynamic(self) -> bool:
        """Whether anything is simulated."""
        return self._water is not None

    def is_simulated(self, index: int) -> bool:
        """Whether a vehicle is moved by forces."""
        return index in self._dynamics

    def submerged_positions(self) -> Array:
        """Return where the water acts on bodies, in W, (n, 3) [m].

        At the centre of buoyancy; for a body that displaces nothing, where its matrices are about.
        """
        self._refresh()
        return points_of(self._origins, self._axes, self._wet, self._felt_at)

    def submerged_vehicles(self) -> tuple[int | None, ...]:
        """Return the number of the vehicle that each of them belongs to."""
        numbers: list[int | None] = []
        for i in self._wet.tolist():
            parts = self._model.body(i).name.split("/")
            numbers.append(int(parts[1]) if parts[0] == "vehicle" else None)
        return tuple(numbers)

    def step(self, velocity: Array, acceleration: Array, rotation: Array | None = None) -> None:
        """Advance all simulated bodies by one step.

        Args:
            velocity: of the water at each body that it acts on, in W, (n, 3) [m/s].
            acceleration: of the water there, in W, (n, 3) [m/s2].
            rotation: half its vorticity, in W, (n, 3) [rad/s]; None for none.

        Raises:
            RunFailed: the engine warned, or a body moves faster than can be: what follows would
                not be true.
        """
        if self._water is None or self._set_current is None:
            return
        self._set_current(velocity, acceleration, rotation)
        is_due = self._n_steps % self._autopilot_steps == 0
        for index, autopilot in self._autopilots.items():
            if is_due or autopilot.has_news:
                self._update_autopilot(index, autopilot, velocity)
        for servos in self._servos.values():
            servos.step(self._timestep)
        before = {i: self._frees[i].copy() for i in self._kinematic}
        self._water.step(self._data)
        if any(self._warnings.tolist()):
            raise RunFailed(self._why_untrue())
        dof = too_fast(self._velocities, self._speeds)
        if dof >= 0:
            raise RunFailed(self._say_too_fast(dof))
        self._contacts_hold = True
        for index, pose in before.items():
            self._frees[index][:] = pose
            self._free_velocities[index][:] = 0.0
        self._n_steps += 1
        self._moved()

    def fall(self) -> None:
        """Advance the original's physics by one step, if the scene uses it.

        Raises:
            RunFailed: the engine warned: what follows would not be true.
        """
        if self._uwsim_physics is None:
            return
        self._uwsim_physics.step()
        if any(self._warnings.tolist()):
            raise RunFailed(self._why_untrue())
        self._contacts_hold = True
        self._n_steps += 1
        self._moved()

    def _why_untrue(self) -> str:
        return why_untrue(self._data, self._next_time(), self._timestep, self._dof_names())

    def _say_too_fast(self, dof: int) -> str:
        return say_too_fast(
            self._velocities, self._speeds, dof, self._next_time(), self._dof_names()
        )

    def _dof_names(self) -> list[str]:
        return [self._body_names[body] for body in self._model.dof_bodyid]

    def _next_time(self) -> float:
        return (self._n_steps + 1) * self._timestep

    def contacts(self, kind: Literal["vehicle", "object"], index: int) -> list[Contact] | None:
        """Where a vehicle or object touches others; None if it has no shape to be touched."""
        owner = f"{kind}/{index}"
        if owner not in self._touchable:
            return None
        if not self._contacts_hold:
            return []
        return contacts_of(self._model, self._data, self._owners == owner, self._owner_names)

    def autopilot(self, index: int) -> Autopilot:
        """Return the autopilot of a simulated vehicle."""
        return self._autopilots[index]

    def servos(self, index: int) -> Servos:
        """Return the servos of a simulated vehicle's joints."""
        return self._servos[index]

    def actuators(self, index: int) -> Actuators | None:
        """Return the actuators of a vehicle; None if it is not simulated."""
        if self._water is None or index not in self._dynamics:
            return None
        return Actuators(
            self._model,
            self._data,
            self._water,
            self._dynamics[index],
            self._robots[index],
            index,
            self._refresh,
        )

    def thrusters(self, index: int) -> tuple[str, ...]:
        """Names of the thrusters of a vehicle, in the order of its hydrodynamics file."""
        if index not in self._dynamics:
            return ()
        return tuple(thruster.name for thruster in self._dynamics[index].thrusters)

    def fins(self, index: int) -> tuple[str, ...]:
        """Names of the fins of a vehicle, in the order of its hydrodynamics file."""
        return (
            tuple(fin.name for fin in self._dynamics[index].fins)
            if self.is_simulated(index)
            else ()
        )

    def turn_fins(self, index: int, angles: Array) -> None:
        """Let the fins of a vehicle turn to these angles, (n,) [rad]."""
        assert self._water is not None
        for name, angle in zip(self.fins(index), angles.tolist(), strict=True):
            self._water.turn_fin(self._data, vehicle_fin(index, name), angle)

    def set_loss(self, index: int, thruster: int, loss: float) -> None:
        """Let a thruster lose a part of its thrust: 0 healthy, 1 dead."""
        assert self._water is not None
        self._water.set_loss(self._data, self._thrusters[index][thruster], loss)

    def vehicle_pose(self, index: int) -> Pose:
        """Return ``world_from_base`` of a vehicle."""
        return self._body_pose(self._bases[index])

    def vehicle_velocity(self, index: int) -> Array:
        """Return the twist of a vehicle's base over ground, base axes, (6,) [m/s, rad/s]."""
        return self._twist(index, self.vehicle_pose(index))

    def place_vehicle(self, index: int, world_from_base: Pose) -> None:
        """Set the pose of a vehicle, at rest."""
        qpos = self._frees[index]
        qpos[:3] = world_from_base.position
        qpos[3:] = quaternion_from_rotation(world_from_base.rotation)
        if index in self._dynamics:
            self._free_velocities[index][:] = 0.0
            for thruster in self._thrusters[index]:
                self._stop_thruster(thruster)
            for name in self.fins(index):
                assert self._water is not None
                self._water.stop_fin(self._data, vehicle_fin(index, name))
            self._autopilots[index].hold(world_from_base)
            self._contacts_hold = False
        self._moved()

    def joints(self, index: int) -> Array:
        """Return a copy of the joint vector of a vehicle, (n,) [rad or m]."""
        if index in self._servos:
            return self._servos[index].positions
        joints: Array = self._data.qpos[self._joint_places[index]]
        return joints

    def _places_of(self, index: int, robot: RobotSpec) -> npt.NDArray[np.intp]:
        """Where the joint vector of a vehicle lies among all positions, (n,)."""
        names = [vehicle_joint(index, joint.name) for joint in robot.movable]
        return np.array([self._model.joint(name).qposadr[0] for name in names], dtype=np.intp)

    def set_joints(self, index: int, values: Array) -> None:
        """Set the joint vector of a vehicle (n,) [rad or m]; clamped to the limits.

        A simulated vehicle's servos hold the joints there from now on.
        """
        if index in self._servos:
            self._servos[index].put(values)
        else:
            positions = joint_positions(self._robots[index], values.tolist())
            for name, value in positions.items():
                joint = self._model.joint(vehicle_joint(index, name))
                self._data.qpos[joint.qposadr[0]] = value
            if index in self._scaled:
                self._scaled[index].follow(values)
        self._moved()

    def link_pose(self, index: int, link: str) -> Pose:
        """Return ``world_from_link`` (the kinematic frame) of a vehicle's link."""
        return self._body_pose(self._links[index, link])

    def link_frame(self, index: int, link: str) -> Array:
        """Return ``world_from_link`` with the vehicle's scale in it, (4, 4) [m]."""
        pose = self.link_pose(index, link)
        frame = pose.matrix
        if index in self._scales:
            frame[:3, :3] = stretched_axes(self.vehicle_pose(index), pose, self._scales[index])
        return frame

    def mounted_pose(self, index: int, link: str, link_from_part: Pose) -> Pose:
        """Return where something on a link is; the vehicle's scale moves it and does not turn it.

        Args:
            index: number of the vehicle.
            link: name of the link.
            link_from_part: where the file puts it on the link.
        """
        pose = self.link_pose(index, link)
        if index not in self._scales:
            return pose @ link_from_part
        axes = stretched_axes(self.vehicle_pose(index), pose, self._scales[index])
        position = pose.position + turned(axes, link_from_part.position)
        return Pose(position, product(pose.rotation, link_from_part.rotation))

    def object_pose(self, index: int) -> Pose:
        """Return ``world_from_object`` (before its offsets and its scale)."""
        if index in self._fixed:
            return self._fixed[index].copy()
        return self._body_pose(self._objects[index])

    def is_fixed(self, index: int) -> bool:
        """Whether an object stays where it is."""
        return index in self._fixed

    def _make_autopilot(self, index: int) -> Autopilot:
        pose = self.vehicle_pose(index)
        robot, dynamics = self._robots[index], self._dynamics[index]
        mass = float(self._model.body_subtreemass[self._bases[index]])
        values = self._scene.vehicles[index].joint_values
        autopilot = Autopilot(
            dynamics,
            robot.root,
            mass,
            stiffness=balance_of(robot, dynamics, values).stiffness(pose.rotation[2]),
            thrusters=thrusters_on_base(robot, dynamics.thrusters, values),
        )
        autopilot.hold(pose)
        return autopilot

    def _twist(self, index: int, world_from_base: Pose) -> Array:
        twist: Array = self._free_velocities[index].copy()
        twist[:3] = turned_back(world_from_base.rotation, twist[:3])
        return twist

    def _update_autopilot(self, index: int, autopilot: Autopilot, velocity: Array) -> None:
        """Update an autopilot and set the commands of its thrusters."""
        assert self._water is not None
        pose = self.vehicle_pose(index)
        twist = self._twist(index, pose)
        if not self._over_ground[index] and not autopilot.is_over_ground:
            twist[:3] -= turned_back(pose.rotation, velocity[self._base_rows[index]])
        commands = autopilot.commands(pose, twist, self._autopilot_steps * self._timestep)
        self._water.set_thrusters(self._data, commands, self._thrusters[index])

    def _stop_thruster(self, thruster: int) -> None:
        assert self._water is not None
        self._water.set_thruster(self._data, thruster, 0.0)
        actuator = self._water.thrusters[thruster]
        address = int(self._model.actuator_actadr[actuator])
        if address >= 0:
            self._data.act[address] = 0.0

    def _moved(self) -> None:
        self._is_stale = True
        self.version += 1

    def _refresh(self) -> None:
        if self._is_stale:
            mujoco.mj_kinematics(self._model, self._data)
            self._is_stale = False

    def _body_pose(self, body: int) -> Pose:
        self._refresh()
        return Pose(self._origins[body].copy(), self._axes[body].copy())


def _water_of(model: mujoco.MjModel) -> Hydrodynamics:
    """Install the hydrodynamics of a model."""
    from .hydrodynamics.hydrodynamics import install

    return install(model)


def standing_pose(pose: Pose) -> Pose:
    """Return a pose as the engine has it: by way of a quaternion."""
    rotation, quaternion = np.zeros(9), quaternion_from_rotation(pose.rotation)
    mujoco.mju_normalize4(quaternion)
    mujoco.mju_quat2Mat(rotation, quaternion)
    return Pose(pose.position.copy(), rotation.reshape(3, 3))


def _owner(name: str) -> str:
    """``vehicle/1`` or ``object/1``, what the body or shape of that name belongs to."""
    return "/".join(name.split("/")[:2])


def _called(scene: SceneSpec, body: str) -> str:
    """How the scene calls a body of the model: ``girona500/part0``, an object's name."""
    link = body.split("/")[2:]
    return "/".join([_named(scene, _owner(body)), *link])


def _named(scene: SceneSpec, owner: str) -> str:
    """How the scene calls it."""
    kind, _, index = owner.partition("/")
    if kind == "vehicle":
        return scene.vehicles[int(index)].name
    return scene.objects[int(index)].name if kind == "object" else ""

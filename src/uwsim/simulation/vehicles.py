"""Vehicles as sensors, devices and topics see them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from ..base.geometry import Array, Pose
from ..base.numerics.linear import rotate_back
from ..base.record import LazyPart, Record
from ..base.sampling import Sampler
from ..bus import Bus
from ..devices.sway import displace_pose, rest_pose
from ..errors import UnknownName
from ..model.scene_model import SceneModel
from ..physics.actuation.vehicle_actuation import VehicleActuation
from ..physics.engine import Engine
from ..physics.kinematics.placed_motion import PlacedMotion, Source
from ..physics.poses import Mount
from ..scene.mounts import MountFrames
from ..sensors.sensor import Mounted
from ..vehicle import Autopilot, Servos
from ..world import Actuators
from .moving_bodies import CompiledVehicle, MountedBody, MovingBody, MovingLink


@dataclass(slots=True)
class VehicleState(Record):
    """What changes of a vehicle besides the engine's."""

    placed: LazyPart[PlacedMotion]
    """Its motion where it is not simulated and a sensor reads it, or it follows a recording."""
    centre: tuple[Sequence[float], Sequence[float]] | None = None
    """The position [m] and angles [rad] that it is displaced from; None: those of the file."""
    offsets: list[tuple[int, float]] = field(default_factory=list)
    """The axis of each displacer, and the displacement [m or rad]."""
    losses: dict[int, list[float]] = field(default_factory=dict)
    """The losses of each thruster, one a setter [1]."""


class SceneVehicle:
    """One vehicle of a scene (`uwsim.vehicle.Vehicle`, `uwsim.sensors.sensor.Carrier`).

    It is known by its number: of several that share a name each is one of these.

    Args:
        index: its number in the scene.
        frames: the vehicle at its pose in the file.
        engine: where its links are.
        step: returns how many steps the simulation has taken.
    """

    def __init__(
        self, index: int, frames: MountFrames, engine: Engine, step: Callable[[], int]
    ) -> None:
        self._frames, self._engine, self._step = frames, engine, step
        self.index = index
        """Its number in the scene."""
        self.name = frames.vehicle.name
        """Its name in the scene."""
        self.joint_names = tuple(joint.name for joint in frames.robot.movable_joints)
        """Names of the joints of the joint vector."""
        self._lazy_motion = LazyPart(lambda: engine.placed_motion(index))
        self.state = VehicleState(self._lazy_motion)
        """What changes of it besides the engine's."""

    @property
    def _placed(self) -> PlacedMotion | None:
        return self._lazy_motion.part

    @property
    def autopilot(self) -> Autopilot | None:
        """Its autopilot; None if it is not simulated."""
        return self._actuation.autopilot if self._actuation else None

    @property
    def servos(self) -> Servos | None:
        """Its joint servos; None if it is not simulated."""
        return self._actuation.servos if self._actuation else None

    @property
    def _actuation(self) -> VehicleActuation | None:
        return self._engine.actuation.get(self.index)

    @property
    def thrusters(self) -> tuple[str, ...]:
        """Names of its thrusters as in its hydrodynamics file; none if it is not simulated."""
        return self._actuation.thrusters if self._actuation else ()

    @property
    def fins(self) -> tuple[str, ...]:
        """Names of its fins as in its hydrodynamics file; none if it is not simulated."""
        return self._actuation.fins if self._actuation else ()

    def turn_fins(self, angles: Array) -> None:
        """Let its fins turn to these angles, (n,) [rad]."""
        self._engine.actuation[self.index].turn_fins(angles)

    @property
    def world_from_base(self) -> Pose:
        """Where its base is now."""
        return self._engine.poses.vehicle(self.index)

    @property
    def velocity(self) -> Array:
        """Twist of its base over ground, base axes, (6,) [m/s, rad/s]."""
        if self._placed is None:
            return self._engine.vehicle_velocity(self.index)
        twist = self._placed.twist(self._step())
        return np.concatenate([rotate_back(self.world_from_base.rotation, twist[:3]), twist[3:]])

    @property
    def joints(self) -> Array:
        """A copy of its joint vector, (n,) [rad or m]."""
        return self._engine.joints(self.index)

    def place(self, world_from_base: Pose) -> None:
        """Set its pose; a simulated one is at rest there, another has come there from the last.

        It is displaced from there from now on.
        """
        self.lead(world_from_base, None)

    def follow(self) -> None:
        """From now on it moves as `lead` says, not as it is simulated: velocities are of that."""
        self._lazy_motion.get_or_make()

    def lead(
        self, world_from_base: Pose | None, joints: Array | None, starts: Collection[Source] = ()
    ) -> None:
        """Set its pose and its joint vector, as far as given: it has come there from the last.

        Args:
            world_from_base: its pose.
            joints: its joint vector, (n,) [rad or m].
            starts: what was never led before: it has not come there, its motion starts there.
        """
        if world_from_base is not None:
            self.state.centre = self._centre_of(world_from_base)
            self._engine.place_vehicle(self.index, world_from_base)
        if joints is not None:
            self._engine.set_joints(self.index, joints)
        if self._placed is not None:
            self._placed.record(self._step(), starts)

    def _come_to(self, world_from_base: Pose) -> None:
        self._engine.place_vehicle(self.index, world_from_base)
        if self._placed is not None:
            self._placed.record(self._step())

    def set_joints(self, values: Array) -> None:
        """Set its joint vector, (n,) [rad or m]; clamped to the limits."""
        self.lead(None, values)

    def put(self, world_from_base: Pose | None) -> None:
        """Set its pose, at rest; it is displaced from there from now on.

        None puts it where the scene puts it now.
        """
        if world_from_base is None:
            self.state.centre = None
            world_from_base = self._displaced_pose()
        else:
            self.state.centre = self._centre_of(world_from_base)
        self._rest_at(world_from_base)

    def _rest_at(self, world_from_base: Pose) -> None:
        self._engine.place_vehicle(self.index, world_from_base)
        if self._placed is not None:
            self._placed.record_at_rest()

    def _centre_of(self, world_from_base: Pose) -> tuple[Sequence[float], Sequence[float]] | None:
        """What it is displaced from where it is displaced to a pose now; None: never displaced."""
        if not self.state.offsets:
            return None
        localized_from_base = self._frames.world_from_localized.inverse() @ world_from_base
        return rest_pose(localized_from_base, self.state.offsets)

    def _displaced_pose(self) -> Pose:
        """Where it is by the displacements of now, ``world_from_base``."""
        spec = self._frames.vehicle
        position, angles = self.state.centre or (spec.position, spec.orientation)
        return self._frames.world_from_localized @ displace_pose(
            position, angles, self.state.offsets
        )

    def displacer(self, axis: int) -> Callable[[float], None]:
        """Return a function that displaces it along or about an axis; displacements add up."""
        own = len(self.state.offsets)
        self.state.offsets.append((axis, 0.0))

        def displace(offset: float) -> None:
            self.state.offsets[own] = (axis, offset)
            if own == len(self.state.offsets) - 1:
                self._come_to(self._displaced_pose())

        return displace

    def loss_setter(self, thruster: str) -> Callable[[float], None]:
        """Return a setter of the loss of a thruster [0..1]; of several the greatest counts."""
        if thruster not in self.thrusters:
            raise UnknownName("thruster", thruster, self.thrusters)
        number = self.thrusters.index(thruster)
        losses = self.state.losses.setdefault(number, [])
        own = len(losses)
        losses.append(0.0)

        def lose(loss: float) -> None:
            self.state.losses[number][own] = loss
            self._engine.actuation[self.index].set_loss(number, max(self.state.losses[number]))

        return lose

    def hold(self, object_index: int, link: str) -> None:
        """Fix an object, by its index, to a link of the vehicle at its present pose."""
        self._engine.grips.hold(object_index, self.index, link)

    def release(self, object_index: int) -> None:
        """Release a held object."""
        self._engine.grips.release(object_index)

    @property
    def compiled_vehicle(self) -> CompiledVehicle:
        """The vehicle as compiled code reads it."""
        root = self._frames.robot.root
        return CompiledVehicle(
            f"{self.name}/{root}",
            root,
            self.joint_names,
            self.index,
            self._engine,
            lambda: None if self._placed is None else self._placed.twist(self._step()),
        )

    def mount(self, spec: Mounted, *, visual: bool = False) -> MountedBody:
        """Fix something to its link; raises UnknownName if there is no such link."""
        name = f"{self.name}/{spec.relative_to}"
        return MountedBody(name, self._engine.poses, self._record_of(spec, visual))

    def moving_mount(self, spec: Mounted, *, visual: bool = False) -> MovingBody:
        """Fix something to its link whose motion is read; UnknownName if there is no such link."""
        record, link, engine = self._record_of(spec, visual), spec.relative_to, self._engine
        body = engine.poses.link_body(self.index, link)
        if self._actuation is None:
            self.follow()
        moving = MovingLink(
            index=self.index,
            body=body,
            motion=engine.link_motion,
            led=lambda: self._lazy_motion.part,
            step=self._step,
        )
        return MovingBody(f"{self.name}/{link}", engine.poses, record, moving)

    def wrench_sampler(
        self, spec: Mounted, *, at_joint: bool = False, visual: bool = False
    ) -> Sampler:
        """Return a sampler of a wrench at a link; raise UnknownName if there is no such link.

        See `uwsim.devices.device.DeviceVehicle`.
        """
        record, engine = self._record_of(spec, visual), self._engine
        is_simulated = self._actuation is not None
        if not is_simulated:
            self.follow()  # as for a sensor of motion: its velocity stays the same
        body = engine.poses.link_body(self.index, spec.relative_to)
        if at_joint:
            return engine.joint_wrench.sampler(body, record, is_simulated=is_simulated)
        return engine.contacts.wrench_sampler(body, record)

    def _record_of(self, spec: Mounted, visual: bool) -> Mount:
        """Return the record of something on a link."""
        link, robot = spec.relative_to, self._frames.robot
        if robot.link(link) is None:
            raise UnknownName("link", link, [each.name for each in robot.links])
        link_from_part = self._frames.link_from_mounted(spec, visual=visual)
        return self._engine.poses.mount(self.index, link, link_from_part)


class SceneVehicles:
    """The vehicles of a scene, in the file's order, which may share names.

    Args:
        model: of the scene.
        engine: where their links are.
        bus: counts the steps.
    """

    def __init__(self, model: SceneModel, engine: Engine, bus: Bus) -> None:
        self.names = tuple(vehicle.name for vehicle in model.scene.vehicles)
        """Their names, by number."""
        self._actuation = engine.actuation
        self._vehicles = tuple(
            SceneVehicle(index, frames, engine, lambda: bus.state.step)
            for index, frames in enumerate(model.mount_frames)
        )

    def find(self, name: str) -> SceneVehicle:
        """Find the first vehicle of a name; UnknownName if there is none."""
        if name not in self.names:
            raise UnknownName("vehicle", name, self.names)
        return self._vehicles[self.names.index(name)]

    def actuators(self, name: str) -> Actuators | None:
        """The actuators of a vehicle; None if it is not simulated; UnknownName if there is none."""
        actuation = self._actuation.get(self.find(name).index)
        return None if actuation is None else actuation.actuators()

    def __getitem__(self, index: int) -> SceneVehicle:
        """Return a vehicle by its number in the file."""
        return self._vehicles[index]

    def __iter__(self) -> Iterator[SceneVehicle]:
        """Iterate over all vehicles."""
        return iter(self._vehicles)

    def __len__(self) -> int:
        """Return how many there are."""
        return len(self._vehicles)

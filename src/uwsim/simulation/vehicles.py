"""The vehicles of a running scene, which sensors, devices and topics read and command."""

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
from ..physics.kinematics.prescribed_motion import PrescribedMotion, Source
from ..physics.poses import Mount
from ..scene.mounts import MountFrames
from ..sensors.sensor import MountedPart
from ..vehicle import Autopilot, Servos
from ..world import Actuators
from .moving_bodies import CompiledVehicle, MountedBody, MovingBody, MovingLink


@dataclass(slots=True)
class VehicleState(Record):
    """The state of a vehicle that is not part of the engine's state."""

    prescribed_motion: LazyPart[PrescribedMotion]
    """The prescribed motion of a vehicle; it exists for a kinematic vehicle whose motion a sensor
    reads, and for a vehicle that follows a recording."""
    rest_pose: tuple[Sequence[float], Sequence[float]] | None = None
    """The base pose without displacements, in L: position [m] and Rx Ry Rz angles [rad]; None: the
    pose in the scene file."""
    offsets: list[tuple[int, float]] = field(default_factory=list)
    """The axis index and the displacement [m or rad] of each device that displaces the vehicle."""
    losses: dict[int, list[float]] = field(default_factory=dict)
    """The losses of thrust [1] by thruster number: one loss for each device that sets it."""


class SceneVehicle:
    """One vehicle of a scene (`uwsim.vehicle.Vehicle`, `uwsim.sensors.sensor.Carrier`).

    The index of a vehicle identifies it: several vehicles may share a name.

    Args:
        index: the index of the vehicle in the scene.
        frames: the frames of the vehicle's links and mounts at its pose in the scene file.
        engine: the engine, which stores the poses of the links.
        step: returns the number of steps taken so far.
    """

    def __init__(
        self, index: int, frames: MountFrames, engine: Engine, step: Callable[[], int]
    ) -> None:
        self._frames, self._engine, self._step = frames, engine, step
        self.index = index
        """The index of the vehicle in the scene."""
        self.name = frames.vehicle.name
        """The name of the vehicle in the scene."""
        self.joint_names = tuple(joint.name for joint in frames.robot.movable_joints)
        """The names of the joints in the joint vector."""
        self._lazy_prescribed_motion = LazyPart(lambda: engine.prescribed_motion(index))
        self.state = VehicleState(self._lazy_prescribed_motion)
        """The state of the vehicle that is not part of the engine's state."""

    @property
    def _prescribed_motion(self) -> PrescribedMotion | None:
        return self._lazy_prescribed_motion.part

    @property
    def autopilot(self) -> Autopilot | None:
        """The autopilot; None for a kinematic vehicle."""
        return self._actuation.autopilot if self._actuation else None

    @property
    def servos(self) -> Servos | None:
        """The joint servos; None for a kinematic vehicle."""
        return self._actuation.servos if self._actuation else None

    @property
    def _actuation(self) -> VehicleActuation | None:
        return self._engine.actuation.get(self.index)

    @property
    def thrusters(self) -> tuple[str, ...]:
        """The names of the thrusters in the hydrodynamics file; none for a kinematic vehicle."""
        return self._actuation.thrusters if self._actuation else ()

    @property
    def fins(self) -> tuple[str, ...]:
        """The names of the fins in the hydrodynamics file; none for a kinematic vehicle."""
        return self._actuation.fins if self._actuation else ()

    def turn_fins(self, angles: Array) -> None:
        """Turn the fins towards these angles, (n,) [rad]."""
        self._engine.actuation[self.index].turn_fins(angles)

    @property
    def world_from_base(self) -> Pose:
        """The present pose of the base in W."""
        return self._engine.poses.vehicle(self.index)

    @property
    def velocity(self) -> Array:
        """The twist of the base over ground, in base axes, (6,) [m/s, rad/s]."""
        if self._prescribed_motion is None:
            return self._engine.vehicle_velocity(self.index)
        twist = self._prescribed_motion.twist(self._step())
        return np.concatenate([rotate_back(self.world_from_base.rotation, twist[:3]), twist[3:]])

    @property
    def joints(self) -> Array:
        """The joint vector, (n,) [rad or m]; a copy."""
        return self._engine.joints(self.index)

    def place(self, world_from_base: Pose) -> None:
        """Set the pose of the base. A vehicle with dynamics is at rest there.

        A kinematic vehicle counts as moved there: its velocity is the distance per time. Later
        displacements (``<u:sway>``) are relative to this pose.
        """
        self.set_configuration(world_from_base, None)

    def start_prescribed_motion(self) -> None:
        """Compute velocities from the poses that are set (prescribed motion), not from forces."""
        self._lazy_prescribed_motion.get_or_make()

    def set_configuration(
        self,
        world_from_base: Pose | None,
        joints: Array | None,
        starting_sources: Collection[Source] = (),
    ) -> None:
        """Set the pose and the joint vector; a prescribed motion counts the change as movement.

        Args:
            world_from_base: the pose of the base in W; None: no change.
            joints: the joint vector, (n,) [rad or m]; None: no change.
            starting_sources: the quantities that are set for the first time: their prescribed
                motion starts here, at rest.
        """
        if world_from_base is not None:
            self.state.rest_pose = self._compute_rest_pose(world_from_base)
            self._engine.place_vehicle(self.index, world_from_base)
        if joints is not None:
            self._engine.set_joints(self.index, joints)
        if self._prescribed_motion is not None:
            self._prescribed_motion.record(self._step(), starting_sources)

    def _move_base(self, world_from_base: Pose) -> None:
        self._engine.place_vehicle(self.index, world_from_base)
        if self._prescribed_motion is not None:
            self._prescribed_motion.record(self._step())

    def set_joints(self, values: Array) -> None:
        """Set the joint vector, (n,) [rad or m], clamped to the joint limits."""
        self.set_configuration(None, values)

    def reset_pose(self, world_from_base: Pose | None) -> None:
        """Set the pose of the base in W, at rest; later displacements are relative to it.

        None: the pose in the scene file, with the present displacements.
        """
        if world_from_base is None:
            self.state.rest_pose = None
            world_from_base = self._displaced_pose()
        else:
            self.state.rest_pose = self._compute_rest_pose(world_from_base)
        self._place_at_rest(world_from_base)

    def _place_at_rest(self, world_from_base: Pose) -> None:
        self._engine.place_vehicle(self.index, world_from_base)
        if self._prescribed_motion is not None:
            self._prescribed_motion.record_at_rest()

    def _compute_rest_pose(
        self, world_from_base: Pose
    ) -> tuple[Sequence[float], Sequence[float]] | None:
        """Return the rest pose for a displaced pose in W; None if no device displaces it."""
        if not self.state.offsets:
            return None
        localized_from_base = self._frames.world_from_localized.inverse() @ world_from_base
        return rest_pose(localized_from_base, self.state.offsets)

    def _displaced_pose(self) -> Pose:
        """Return the rest pose with the present displacements, in W."""
        spec = self._frames.vehicle
        position, angles = self.state.rest_pose or (spec.position, spec.orientation)
        return self._frames.world_from_localized @ displace_pose(
            position, angles, self.state.offsets
        )

    def displacer(self, axis: int) -> Callable[[float], None]:
        """Return a function that sets a displacement from the rest pose along or about an axis.

        Displacements of several functions are added; the call of the last one sets the pose.

        Args:
            axis: the index of the axis in `uwsim.devices.sway.AXES`.
        """
        index = len(self.state.offsets)
        self.state.offsets.append((axis, 0.0))

        def displace(offset: float) -> None:
            self.state.offsets[index] = (axis, offset)
            if index == len(self.state.offsets) - 1:
                self._move_base(self._displaced_pose())

        return displace

    def loss_setter(self, thruster: str) -> Callable[[float], None]:
        """Return a function that sets a loss of thrust [0..1]; the greatest of several applies."""
        if thruster not in self.thrusters:
            raise UnknownName("thruster", thruster, self.thrusters)
        thruster_index = self.thrusters.index(thruster)
        losses = self.state.losses.setdefault(thruster_index, [])
        loss_index = len(losses)
        losses.append(0.0)

        def set_loss(loss: float) -> None:
            self.state.losses[thruster_index][loss_index] = loss
            self._engine.actuation[self.index].set_loss(
                thruster_index, max(self.state.losses[thruster_index])
            )

        return set_loss

    def hold(self, object_index: int, link: str) -> None:
        """Fix the object with a number, at its present pose, to a link of the vehicle."""
        self._engine.grips.hold(object_index, self.index, link)

    def release(self, object_index: int) -> None:
        """Release the held object with a number."""
        self._engine.grips.release(object_index)

    @property
    def compiled_vehicle(self) -> CompiledVehicle:
        """The samplers of the vehicle for compiled code."""
        root = self._frames.robot.root
        return CompiledVehicle(
            f"{self.name}/{root}",
            root,
            self.joint_names,
            self.index,
            self._engine,
            lambda: (
                None
                if self._prescribed_motion is None
                else self._prescribed_motion.twist(self._step())
            ),
        )

    def mount(self, spec: MountedPart, *, visual: bool = False) -> MountedBody:
        """Return the frame of a part on its link; raise UnknownName if there is no such link."""
        name = f"{self.name}/{spec.relative_to}"
        return MountedBody(name, self._engine.poses, self._make_mount(spec, visual))

    def moving_mount(self, spec: MountedPart, *, visual: bool = False) -> MovingBody:
        """Return the frame of a part with its motion; raise UnknownName without its link."""
        mount, link, engine = self._make_mount(spec, visual), spec.relative_to, self._engine
        body = engine.poses.link_body(self.index, link)
        if self._actuation is None:
            self.start_prescribed_motion()
        moving_link = MovingLink(
            index=self.index,
            body=body,
            motion=engine.link_motion,
            prescribed_motion=lambda: self._lazy_prescribed_motion.part,
            step=self._step,
        )
        return MovingBody(f"{self.name}/{link}", engine.poses, mount, moving_link)

    def wrench_sampler(
        self, spec: MountedPart, *, at_joint: bool = False, visual: bool = False
    ) -> Sampler:
        """Return a sampler of the wrench at a link; raise UnknownName if there is no such link.

        See `uwsim.devices.device.DeviceVehicle`.
        """
        mount, engine = self._make_mount(spec, visual), self._engine
        has_dynamics = self._actuation is not None
        if not has_dynamics:
            self.start_prescribed_motion()  # as for sensors of motion: `velocity` stays the same
        body = engine.poses.link_body(self.index, spec.relative_to)
        if at_joint:
            return engine.joint_wrench.sampler(body, mount, has_dynamics=has_dynamics)
        return engine.contacts.wrench_sampler(body, mount)

    def _make_mount(self, spec: MountedPart, visual: bool) -> Mount:
        link, robot = spec.relative_to, self._frames.robot
        if robot.link(link) is None:
            raise UnknownName("link", link, [robot_link.name for robot_link in robot.links])
        link_from_part = self._frames.link_from_mounted(spec, visual=visual)
        return self._engine.poses.mount(self.index, link, link_from_part)


class SceneVehicles:
    """The vehicles of a scene, in the file's order; several may share a name."""

    def __init__(self, model: SceneModel, engine: Engine, bus: Bus) -> None:
        self.names = tuple(vehicle.name for vehicle in model.scene.vehicles)
        """The names of the vehicles, in the file's order."""
        self._actuation = engine.actuation
        self._vehicles = tuple(
            SceneVehicle(index, frames, engine, lambda: bus.state.step)
            for index, frames in enumerate(model.mount_frames)
        )

    def find(self, name: str) -> SceneVehicle:
        """Return the first vehicle with a name; raise UnknownName if there is none."""
        if name not in self.names:
            raise UnknownName("vehicle", name, self.names)
        return self._vehicles[self.names.index(name)]

    def actuators(self, name: str) -> Actuators | None:
        """Return the actuators of a vehicle, None if it is kinematic; raise UnknownName."""
        actuation = self._actuation.get(self.find(name).index)
        return None if actuation is None else actuation.actuators()

    def __getitem__(self, index: int) -> SceneVehicle:
        """Return a vehicle by its index in the file."""
        return self._vehicles[index]

    def __iter__(self) -> Iterator[SceneVehicle]:
        """Iterate over all vehicles."""
        return iter(self._vehicles)

    def __len__(self) -> int:
        """Return the number of vehicles."""
        return len(self._vehicles)

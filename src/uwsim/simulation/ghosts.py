"""Ghosts: vehicles whose poses and joints follow recorded messages instead of their dynamics."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from ..base.geometry import Array, Pose
from ..messages import JointState, Odometry
from ..physics.kinematics.prescribed_motion import Source
from ..topics.arm_to_ros_joint_state import ArmToROSJointStateSpec
from ..topics.pat_to_ros_odom import PATToROSOdomSpec
from ..topics.ros_pose_to_pat import pose_in_localized
from .simulation import Simulation
from .vehicles import SceneVehicle


class Ghost:
    """A vehicle that follows recorded poses and joint positions."""

    def __init__(self, vehicle: SceneVehicle, world_from_localized: Pose) -> None:
        self._vehicle, self._world_from_localized = vehicle, world_from_localized
        vehicle.start_prescribed_motion()
        self._pose: Pose | None = None
        self._joints: Array | None = None  # the joint vector (n,) [rad or m]
        self._recorded_sources = frozenset[Source]()  # the quantities with a message so far

    def receive_odometry(self, message: Odometry) -> None:
        """Store the recorded pose, which the message has in L."""
        pose = pose_in_localized(message.pose.pose)
        if pose is not None:
            self._pose = self._world_from_localized @ pose

    def receive_joints(self, message: JointState) -> None:
        """Store the finite positions of joints in a message; other joints keep their positions."""
        last_joints = self._vehicle.joints if self._joints is None else self._joints
        pairs = zip(message.name, message.position.tolist(), strict=False)
        positions = {name: value for name, value in pairs if math.isfinite(value)}
        pairs_before = zip(self._vehicle.joint_names, last_joints.tolist(), strict=True)
        self._joints = np.array([positions.get(name, value) for name, value in pairs_before])

    def place(self) -> None:
        """Set the vehicle to the stored pose and joint positions; called in every step."""
        values: dict[Source, object] = {"base": self._pose, "joints": self._joints}
        sources = frozenset(source for source, value in values.items() if value is not None)
        self._vehicle.set_configuration(self._pose, self._joints, sources - self._recorded_sources)
        self._recorded_sources = sources


def follow_recorded(simulation: Simulation, recorded_topics: Mapping[str, str]) -> tuple[str, ...]:
    """Make the vehicles follow recorded odometry and joint states.

    Args:
        simulation: the simulation, whose scene publishes odometry (``PATToROSOdom``).
        recorded_topics: the topic on the bus that carries the recording of each topic, by the name
            of the recorded topic with a leading slash.

    Returns:
        The names of the vehicles that follow a recording.
    """
    world, ghosts = simulation.world, dict[str, Ghost]()
    for spec in world.model.scene.ros_interfaces:
        if isinstance(spec, PATToROSOdomSpec) and (
            topic := _recording(spec.topic, recorded_topics)
        ):
            ghost = Ghost(
                world.vehicles.find(spec.vehicle_name), world.model.scene.world_from_localized
            )
            ghosts[spec.vehicle_name] = ghost
            world.bus.subscribe(topic, Odometry, ghost.receive_odometry)
    for spec in world.model.scene.ros_interfaces:
        if isinstance(spec, ArmToROSJointStateSpec) and spec.vehicle_name in ghosts:
            receive: Callable[[JointState], None] = ghosts[spec.vehicle_name].receive_joints
            if topic := _recording(spec.topic, recorded_topics):
                world.bus.subscribe(topic, JointState, receive)
    for ghost in ghosts.values():
        simulation.watch(ghost.place)
    return tuple(ghosts)


def commanded_topics(simulation: Simulation, vehicles: tuple[str, ...]) -> frozenset[str]:
    """Return the topics on which these vehicles receive commands, with a leading slash."""
    return frozenset(
        f"/{getattr(spec, field).strip('/')}"
        for spec in simulation.world.model.scene.ros_interfaces
        if spec.subscribes and getattr(spec, "vehicle_name", None) in vehicles
        for field in spec.message_types()
    )


def odometry_vehicles(simulation: Simulation, recorded_topics: frozenset[str]) -> tuple[str, ...]:
    """Return the vehicles whose odometry is among topics with a leading slash."""
    return tuple(
        spec.vehicle_name
        for spec in simulation.world.model.scene.ros_interfaces
        if isinstance(spec, PATToROSOdomSpec) and f"/{spec.topic.strip('/')}" in recorded_topics
    )


def _recording(topic: str, recorded_topics: Mapping[str, str]) -> str | None:
    return recorded_topics.get(f"/{topic.strip('/')}")

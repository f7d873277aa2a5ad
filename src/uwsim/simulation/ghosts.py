"""Ghosts: vehicles that follow recorded odometry and joint states, whatever their dynamics say."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from ..base.geometry import Array, Pose
from ..messages import JointState, Odometry
from ..physics.kinematics.placed_motion import Source
from ..topics.arm_to_ros_joint_state import ArmToROSJointStateSpec
from ..topics.pat_to_ros_odom import PATToROSOdomSpec
from ..topics.ros_pose_to_pat import pose_in_localized
from .simulation import Simulation
from .vehicles import SceneVehicle


class Ghost:
    """A vehicle that is where a recording says."""

    def __init__(self, vehicle: SceneVehicle, world_from_localized: Pose) -> None:
        self._vehicle, self._world_from_localized = vehicle, world_from_localized
        vehicle.follow()
        self._pose: Pose | None = None
        self._joints: Array | None = None  # the joint vector (n,) [rad or m]
        self._led = frozenset[Source]()  # what was led before

    def see_odometry(self, message: Odometry) -> None:
        """Take a pose in L."""
        pose = pose_in_localized(message.pose.pose)
        if pose is not None:
            self._pose = self._world_from_localized @ pose

    def see_joints(self, message: JointState) -> None:
        """Take the finite positions of joints; the others stay where they were."""
        before = self._vehicle.joints if self._joints is None else self._joints
        pairs = zip(message.name, message.position.tolist(), strict=False)
        known = {name: value for name, value in pairs if math.isfinite(value)}
        now = zip(self._vehicle.joint_names, before.tolist(), strict=True)
        self._joints = np.array([known.get(name, value) for name, value in now])

    def place(self) -> None:
        """Put the vehicle there; called in every step."""
        known: dict[Source, object] = {"base": self._pose, "joints": self._joints}
        now = frozenset(source for source, value in known.items() if value is not None)
        self._vehicle.lead(self._pose, self._joints, now - self._led)
        self._led = now


def follow_recorded(simulation: Simulation, recorded: Mapping[str, str]) -> tuple[str, ...]:
    """Have the vehicles follow what was recorded of them.

    Args:
        simulation: whose scene publishes odometry (``PATToROSOdom``).
        recorded: topic, with a leading slash -> topic on the bus with what was recorded of it.

    Returns:
        Names of the vehicles that follow.
    """
    world, ghosts = simulation.world, dict[str, Ghost]()
    for spec in world.model.scene.ros_interfaces:
        if isinstance(spec, PATToROSOdomSpec) and (topic := _of(spec.topic, recorded)):
            ghost = Ghost(
                world.vehicles.find(spec.vehicle_name), world.model.scene.world_from_localized
            )
            ghosts[spec.vehicle_name] = ghost
            world.bus.subscribe(topic, Odometry, ghost.see_odometry)
    for spec in world.model.scene.ros_interfaces:
        if isinstance(spec, ArmToROSJointStateSpec) and spec.vehicle_name in ghosts:
            see: Callable[[JointState], None] = ghosts[spec.vehicle_name].see_joints
            if topic := _of(spec.topic, recorded):
                world.bus.subscribe(topic, JointState, see)
    for ghost in ghosts.values():
        simulation.watch(ghost.place)
    return tuple(ghosts)


def commanded_topics(simulation: Simulation, vehicles: tuple[str, ...]) -> frozenset[str]:
    """Topics, with a leading slash, by which these vehicles take commands."""
    return frozenset(
        f"/{getattr(spec, field).strip('/')}"
        for spec in simulation.world.model.scene.ros_interfaces
        if spec.subscribes and getattr(spec, "vehicle_name", None) in vehicles
        for field in spec.message_types()
    )


def odometry_vehicles(simulation: Simulation, recorded: frozenset[str]) -> tuple[str, ...]:
    """Vehicles whose odometry is among recorded topics (with a leading slash)."""
    return tuple(
        spec.vehicle_name
        for spec in simulation.world.model.scene.ros_interfaces
        if isinstance(spec, PATToROSOdomSpec) and f"/{spec.topic.strip('/')}" in recorded
    )


def _of(topic: str, recorded: Mapping[str, str]) -> str | None:
    return recorded.get(f"/{topic.strip('/')}")

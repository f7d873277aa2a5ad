"""PATToROSOdom: the odometry of a vehicle on a topic.

As in the original, the names of the frames are empty, the covariances are zero, and the twist of a
vehicle without ``u:dynamics`` is zero.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import ClassVar

import numpy as np

from ..base.geometry import Array, quaternion_from_rotation
from ..base.geometry import Pose as BodyPose
from ..base.numerics.linear import rotate_back
from ..messages import (
    Odometry,
    Point,
    Pose,
    PoseWithCovariance,
    Quaternion,
    Twist,
    TwistWithCovariance,
    Vector3,
    header,
)
from .interface import SampledTopic, TopicWorld, VehiclePublisherSpec


@dataclass(frozen=True, kw_only=True)
class PATToROSOdomSpec(VehiclePublisherSpec):
    """A publisher of the pose and twist of a vehicle as nav_msgs/Odometry."""

    messages: ClassVar[Mapping[str, type]] = {"topic": Odometry}

    def bind(self, world: TopicWorld) -> SampledTopic:
        """Start to publish; raise UnknownName if there is no such vehicle."""
        vehicle = world.vehicle(self.vehicle_name)
        localized_from_world = world.world_from_localized.inverse()
        make_message = partial(odometry, localized_from_world, vehicle.autopilot is not None)
        publish = world.bus.publisher(self.topic, Odometry)
        topic = SampledTopic(
            self.topic, vehicle.compiled_vehicle.base_sampler(), make_message, publish
        )
        topic.begin(self.rate, world)
        return topic


def odometry(
    localized_from_world: BodyPose, has_dynamics: bool, time: float, values: Array
) -> Odometry:
    """Create the message of a sample: the pose of the base in L, its twist over ground.

    The twist has the axes of the base; it is zero for a vehicle without ``u:dynamics``.

    Args:
        localized_from_world: the pose of the world W in the localized world L.
        has_dynamics: True if the vehicle has ``u:dynamics``.
        time: the time of the sample [s].
        values: the sample of `CompiledVehicle.base_sampler`, (18,).
    """
    world_from_base = BodyPose(values[:3].copy(), values[3:12].reshape(3, 3).copy())
    pose = localized_from_world @ world_from_base
    w, x, y, z = quaternion_from_rotation(pose.rotation).tolist()
    px, py, pz = pose.position.tolist()
    linear, angular = np.zeros(3), np.zeros(3)
    if has_dynamics:
        linear, angular = rotate_back(world_from_base.rotation, values[12:15]), values[15:]
    return Odometry(
        header=header(time),
        child_frame_id="",
        pose=PoseWithCovariance(
            pose=Pose(position=Point(x=px, y=py, z=pz), orientation=Quaternion(x=x, y=y, z=z, w=w)),
            covariance=np.zeros(36),
        ),
        twist=TwistWithCovariance(
            twist=Twist(linear=Vector3(*linear.tolist()), angular=Vector3(*angular.tolist())),
            covariance=np.zeros(36),
        ),
    )

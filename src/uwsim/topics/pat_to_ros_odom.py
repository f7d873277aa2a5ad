"""PATToROSOdom: publishes the odometry of a vehicle.

As in the original the frames have no name, the covariances are zero, and the twist of a vehicle
that is not simulated is zero.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import ClassVar

import numpy as np

from ..base.geometry import quaternion_from_rotation
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
from ..vehicle import Vehicle
from .interface import Interface, TopicWorld, VehiclePublisherSpec, is_needed, sample_rate


@dataclass(frozen=True, kw_only=True)
class PATToROSOdomSpec(VehiclePublisherSpec):
    """Publishes the pose of a vehicle as nav_msgs/Odometry."""

    messages: ClassVar[Mapping[str, type]] = {"topic": Odometry}

    def bind(self, world: TopicWorld) -> OdometryPublisher:
        """Publish from now on; raises UnknownName if there is no such vehicle."""
        publisher = OdometryPublisher(self.topic, world.vehicle(self.vehicle_name), world)
        needed = partial(is_needed, world.bus, self.topic)
        world.every(sample_rate(self.rate, world), publisher.publish, is_needed=needed)
        return publisher


class OdometryPublisher(Interface):
    """Publishes the base in L and, of a simulated vehicle, its twist over ground, base axes."""

    def __init__(self, topic: str, vehicle: Vehicle, world: TopicWorld) -> None:
        self._vehicle, self._world = vehicle, world
        self._localized_from_world = world.world_from_localized.inverse()
        self._is_simulated = vehicle.autopilot is not None
        self._publish = world.bus.publisher(topic, Odometry)

    def publish(self) -> None:
        """Publish the state as it is now."""
        pose = self._localized_from_world @ self._vehicle.world_from_base
        w, x, y, z = quaternion_from_rotation(pose.rotation).tolist()
        px, py, pz = pose.position.tolist()
        twist = self._vehicle.velocity if self._is_simulated else np.zeros(6)
        vx, vy, vz, wx, wy, wz = twist.tolist()
        self._publish(
            Odometry(
                header=header(self._world.time),
                child_frame_id="",
                pose=PoseWithCovariance(
                    pose=Pose(
                        position=Point(x=px, y=py, z=pz),
                        orientation=Quaternion(x=x, y=y, z=z, w=w),
                    ),
                    covariance=np.zeros(36),
                ),
                twist=TwistWithCovariance(
                    twist=Twist(
                        linear=Vector3(x=vx, y=vy, z=vz), angular=Vector3(x=wx, y=wy, z=wz)
                    ),
                    covariance=np.zeros(36),
                ),
            )
        )

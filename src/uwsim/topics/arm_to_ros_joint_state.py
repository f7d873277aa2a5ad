"""ArmToROSJointState: publishes the joints of a vehicle.

As in the original the velocities of a vehicle that is not simulated are missing and its efforts
are zero.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import ClassVar

import numpy as np

from ..messages import JointState, header
from ..vehicle import Vehicle
from .interface import Interface, TopicWorld, VehiclePublisherSpec, is_needed, sample_rate


@dataclass(frozen=True, kw_only=True)
class ArmToROSJointStateSpec(VehiclePublisherSpec):
    """Publishes the joints of a vehicle as sensor_msgs/JointState."""

    messages: ClassVar[Mapping[str, type]] = {"topic": JointState}

    def bind(self, world: TopicWorld) -> JointPublisher:
        """Publish from now on; raises UnknownName if there is no such vehicle."""
        publisher = JointPublisher(self.topic, world.vehicle(self.vehicle_name), world)
        needed = partial(is_needed, world.bus, self.topic)
        world.every(sample_rate(self.rate, world), publisher.publish, is_needed=needed)
        return publisher


class JointPublisher(Interface):
    """Publishes the joint vector and, of a simulated vehicle, its velocities and efforts."""

    def __init__(self, topic: str, vehicle: Vehicle, world: TopicWorld) -> None:
        self._vehicle, self._world = vehicle, world
        self._publish = world.bus.publisher(topic, JointState)

    def publish(self) -> None:
        """Publish the state as it is now."""
        names, servos = list(self._vehicle.joint_names), self._vehicle.servos
        velocity, effort = np.zeros(0), np.zeros(len(names))
        if servos is not None:
            velocity, effort = servos.velocities, servos.efforts
        self._publish(
            JointState(
                header=header(self._world.time),
                name=names,
                position=self._vehicle.joints,
                velocity=velocity,
                effort=effort,
            )
        )

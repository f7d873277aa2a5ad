"""ArmToROSJointState: the joints of a vehicle on a topic.

As in the original, the message of a vehicle without ``u:dynamics`` has no velocities, and its
efforts are zero.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import ClassVar

import numpy as np

from ..base.geometry import Array
from ..messages import JointState, header
from .interface import SampledTopic, TopicWorld, VehiclePublisherSpec


@dataclass(frozen=True, kw_only=True)
class ArmToROSJointStateSpec(VehiclePublisherSpec):
    """A publisher of the joints of a vehicle as sensor_msgs/JointState."""

    messages: ClassVar[Mapping[str, type]] = {"topic": JointState}

    def bind(self, world: TopicWorld) -> SampledTopic:
        """Start to publish; raise UnknownName if there is no such vehicle."""
        vehicle = world.vehicle(self.vehicle_name)
        make_message = partial(joint_state, tuple(vehicle.joint_names))
        publish = world.bus.publisher(self.topic, JointState)
        topic = SampledTopic(
            self.topic, vehicle.compiled_vehicle.joint_sampler(), make_message, publish
        )
        topic.begin(self.rate, world)
        return topic


def joint_state(names: Sequence[str], time: float, values: Array) -> JointState:
    """Create the message of a sample of n joints.

    Args:
        names: the names of the joints.
        time: the time of the sample [s].
        values: the sample of `CompiledVehicle.joint_sampler`: n positions [rad or m], and for a
            vehicle with ``u:dynamics`` n velocities and two parts of n efforts.
    """
    n = len(names)
    position, velocity, effort = values[:n].copy(), values[n : 2 * n].copy(), np.zeros(n)
    if len(values) > n:
        effort = values[2 * n : 3 * n] + values[3 * n :]
    return JointState(
        header=header(time), name=list(names), position=position, velocity=velocity, effort=effort
    )

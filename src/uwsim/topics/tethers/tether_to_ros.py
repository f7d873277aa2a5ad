"""u:tetherToROS: the length and the tensions of a tether on a topic, and its status on another.

.. code-block:: xml

    <u:tetherToROS>
      <name>tether</name> <topic>/tether</topic> <statusTopic>/tether/status</statusTopic>
      <rate>10</rate>
    </u:tetherToROS>

The message is a sensor_msgs/JointState with the two ends, ``tether/from`` and ``tether/to``. At
``to``, where the winch is, the position is the unstretched length that is paid out [m], and the
velocity the speed of the winch, positive to pay out [m/s]; at ``from`` both are 0. The effort is
the tension at that end [N]. The status is a std_msgs/String: ``whole``, or a sentence with the
time, the tension and the segment of the break.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...messages import JointState, String, header
from ...world import TetherControl
from ..interface import Interface, InterfaceSpec, TopicWorld, rate_element, sample_rate

WHOLE_STATUS = "whole"
"""The status of a tether that has not broken."""


@dataclass(frozen=True, kw_only=True)
class TetherToROSSpec(InterfaceSpec):
    """A publisher of a tether's length and tensions as sensor_msgs/JointState."""

    sources: ClassVar[tuple[str, ...]] = ("u:tether",)
    source_kind: ClassVar[str] = "u:tetherToROS"
    messages: ClassVar[Mapping[str, type]] = {"topic": JointState, "status_topic": String}

    name: str
    """The name of the tether."""
    topic: str
    """The topic of the length and the tensions: a joint for each end of the tether."""
    status_topic: str | None = None
    """The topic of the status: ``whole``, or a sentence about the break."""
    rate: float = rate_element()
    """The rate of publication [Hz]."""

    def bind(self, world: TopicWorld) -> TetherPublisher:
        """Start to publish; raise UnknownName if there is no such tether."""
        publisher = TetherPublisher(self, world)
        world.create_timer(sample_rate(self.rate, world), publisher.publish)
        return publisher


class TetherPublisher(Interface):
    """A publisher of a tether's length and tensions."""

    def __init__(self, spec: TetherToROSSpec, world: TopicWorld) -> None:
        self._tether: TetherControl = world.tether(spec.name)
        self._world = world
        self._publish = world.bus.publisher(spec.topic, JointState)
        self._publish_status = (
            None if spec.status_topic is None else world.bus.publisher(spec.status_topic, String)
        )

    def publish(self) -> None:
        """Publish the present length, tensions and status."""
        tether = self._tether
        self._publish(
            JointState(
                header=header(self._world.time),
                name=[f"{tether.name}/from", f"{tether.name}/to"],
                position=np.array([0.0, tether.length]),
                velocity=np.array([0.0, tether.winch_speed]),
                effort=np.array(tether.end_tensions),
            )
        )
        if self._publish_status is not None:
            self._publish_status(String(data=tether.break_report or WHOLE_STATUS))

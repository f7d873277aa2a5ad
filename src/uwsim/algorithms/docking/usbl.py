"""``docking-usbl`` and ``docking-girona-usbl``: guidance into a dock by sensors of a real vehicle.

``docking-usbl-p`` and ``docking-girona-usbl-p`` have no integral action against the current.

A beacon at the back of the dock replies to a USBL (`beacon`). With IMU, DVL and depth sensor the
vehicle knows where it is relative to the beacon between replies, and moves by the law of
`guidance`. The heading of the dock, and the place of the beacon in it, are known.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ...bus import Node
from ...messages import TwistStamped
from ..parametric import ParametricAlgorithm, start_benchmark, velocity_command
from .beacon import BEACON_PARAMETERS, SENSOR_TOPICS, BeaconNavigator
from .guidance import GAINS, GIRONA_GAINS, DockingGains, DockingGuidance


class DockingUsbl(ParametricAlgorithm):
    """A guidance into a dock by an acoustic beacon, IMU, DVL and depth sensor."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "axis": 0.0,
        **GAINS,
        **BEACON_PARAMETERS,
        "beacon_ahead": 0.235,
        "beacon_below": 0.03,
        "period": 0.05,
        "usbl_x": 0.23,
        "dvl_x": -0.1,
        "dvl_z": 0.1,
        **SENSOR_TOPICS,
        "twist_topic": "/bluerov2/twist",
    }
    """The heading of the dock's ``axis`` [rad], the gains (`DockingGains`), the numbers of
    `beacon`, the place of the beacon ahead of and below the base of the docked vehicle [m], the
    ``period`` of the commands [s], and the topics."""

    def start(self, node: Node) -> None:
        """Read the parameters, connect to topics, and start the benchmark."""
        self._read_parameters(node.parameters)
        self._node, self._axis, self._period = node, self._number("axis"), self._number("period")
        gains = DockingGains(**{name: self._number(name) for name in GAINS})
        self._guidance, distance = DockingGuidance(gains), self._number("beacon_ahead")
        self._beacon_from_goal = np.array(
            [
                distance * math.cos(self._axis),
                distance * math.sin(self._axis),
                self._number("beacon_below"),
            ]
        )  # north, east, down (3,) [m]
        self._publish = node.publisher(self._text("twist_topic"), TwistStamped)
        self._navigator = BeaconNavigator(node, self.parameters)
        node.create_timer(self._period, self._send_command)
        start_benchmark(node)

    def _send_command(self) -> None:
        if not self._navigator.is_ready:
            return
        north, east, down = (self._navigator.offset - self._beacon_from_goal).tolist()
        heading = self._navigator.heading
        cosine, sine = math.cos(heading), math.sin(heading)
        error = np.array([cosine * north + sine * east, cosine * east - sine * north, down])
        velocity, rate = self._guidance.command(error, self._axis - heading, self._period)
        self._publish(velocity_command(velocity, rate, time=self._node.now))


class DockingGironaUsbl(DockingUsbl):
    """The guidance of ``docking-usbl`` for a Girona 500 in the dock of ``docking-girona``."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **DockingUsbl.PARAMETERS,
        **GIRONA_GAINS,
        "beacon_ahead": 1.0,
        "beacon_below": 0.395,
        "usbl_x": 0.7,
        "usbl_z": 0.395,
        "dvl_x": 0.5,
        "dvl_z": 0.8,
        "imu_topic": "/girona500/imu",
        "dvl_topic": "/girona500/dvl",
        "depth_topic": "/girona500/depth",
        "usbl_topic": "/girona500/usbl",
        "twist_topic": "/girona500/twist",
    }
    """The parameters of `DockingUsbl`, with the numbers and topics of the larger vehicle."""


class DockingUsblProportional(DockingUsbl):
    """The guidance of ``docking-usbl`` without integral action: it stays beside the axis."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {**DockingUsbl.PARAMETERS, "ki": 0.0}
    """The parameters of `DockingUsbl`, with ``ki`` 0."""


class DockingGironaUsblProportional(DockingGironaUsbl):
    """The guidance of ``docking-girona-usbl`` without integral action."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {**DockingGironaUsbl.PARAMETERS, "ki": 0.0}
    """The parameters of `DockingGironaUsbl`, with ``ki`` 0."""

r"""The position of a beacon relative to a vehicle, from a USBL, an IMU, a DVL and a depth sensor.

The motion of the vehicle is that of a `Navigator`. The beacon is at rest, at a position b in the
navigation frame. Each reply measures b with the covariance

.. math:: C = \sigma_a^2 r^2 (I - u u^T) + \sigma_r^2 u u^T + \sigma_0^2 I

with the distance r and the direction u. A Kalman filter estimates b as a random walk, so that the
drift of the navigation is followed.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import inverse, length, product, rotate
from ...bus import Node
from ...messages import PointStamped
from ..navigation.ekf import NavigationSpec
from ..navigation.navigator import Navigator

BEACON_PARAMETERS: Mapping[str, float | str] = {
    "range_std": 0.05,
    "angle_std": 0.02,
    "drift": 0.01,
    "usbl_x": 0.0,
    "usbl_z": 0.0,
    "dvl_x": 0.0,
    "dvl_z": 0.0,
}
"""The noise of the USBL [m, rad], the random walk of the navigation [m/sqrt(s)], and the places of
transceiver and DVL in the vehicle's plane of symmetry, in base axes [m]."""
SENSOR_TOPICS: Mapping[str, float | str] = {
    "imu_topic": "/bluerov2/imu",
    "dvl_topic": "/bluerov2/dvl",
    "depth_topic": "/bluerov2/depth",
    "usbl_topic": "/bluerov2/usbl",
}
"""The topics of the sensors."""
FLOOR_STD = 0.01
"""The error of a position that does not depend on the distance [m]."""


class BeaconFilter:
    """A Kalman filter of the position of a beacon that is nearly at rest.

    Args:
        range_std: the standard deviation of the distance [m].
        angle_std: the standard deviation of the direction, about each axis [rad].
        drift: the random walk of the position [m/sqrt(s)].
    """

    def __init__(self, range_std: float, angle_std: float, drift: float) -> None:
        self._range_std, self._angle_std, self._drift = range_std, angle_std, drift
        self._time = 0.0  # of the last reply [s]
        self.position: Array | None = None
        """The position of the beacon in the navigation frame (3,) [m]; None before a reply."""
        self.covariance: Array = np.zeros((3, 3))
        """The covariance of the position, (3, 3) [m2]."""

    def update(self, time: float, origin: Array, offset: Array) -> None:
        """Add a reply.

        Args:
            time: the time of the reply [s].
            origin: the position of the transceiver in the navigation frame, (3,) [m].
            offset: the measured vector to the beacon, navigation axes, (3,) [m].
        """
        distance = length(offset)
        direction = offset / max(distance, 1e-6)
        variance = (self._angle_std * distance) ** 2
        radial = np.outer(direction, direction)
        noise = (variance + FLOOR_STD**2) * np.eye(3) + (self._range_std**2 - variance) * radial
        if self.position is None:
            self.position, self.covariance = origin + offset, noise
        else:
            prior = self.covariance + self._drift**2 * (time - self._time) * np.eye(3)
            gain = product(prior, inverse(prior + noise))
            self.position = self.position + rotate(gain, origin + offset - self.position)
            self.covariance = product(np.eye(3) - gain, prior)
        self._time = time


class BeaconNavigator:
    """A navigator that also estimates where a beacon is."""

    def __init__(self, node: Node, parameters: Mapping[str, float | str]) -> None:
        """Subscribe to the topics of the sensors; ``parameters`` has those of this module."""
        number = {name: float(parameters[name]) for name in BEACON_PARAMETERS}
        topics = {name: str(parameters[name]) for name in SENSOR_TOPICS}
        spec = NavigationSpec(dvl_place=(number["dvl_x"], 0.0, number["dvl_z"]))
        self._node = node
        self._navigator = Navigator(node, topics, spec)
        self._usbl_place = np.array([number["usbl_x"], 0.0, number["usbl_z"]])
        self._filter = BeaconFilter(number["range_std"], number["angle_std"], number["drift"])
        node.subscribe(topics["usbl_topic"], PointStamped, self._on_reply)

    @property
    def is_ready(self) -> bool:
        """True if the beacon has replied."""
        return self._filter.position is not None

    @property
    def offset(self) -> Array:
        """The vector from the base to the beacon, north, east, down, (3,) [m]."""
        assert self._filter.position is not None
        offset: Array = self._filter.position - self._navigator.pose.position
        return offset

    @property
    def velocity(self) -> Array:
        """The velocity of the base over ground, north, east, down, (3,) [m/s]."""
        return self._navigator.velocity

    @property
    def heading(self) -> float:
        """The heading of the base, from north towards east [rad]."""
        return self._navigator.heading

    @property
    def pitch(self) -> float:
        """The pitch of the base, positive if the bow is up [rad]."""
        sine = -float(self._navigator.filter.rotation[2, 0])
        return math.asin(min(1.0, max(-1.0, sine)))

    @property
    def rates(self) -> Array:
        """The rates of roll, pitch and yaw, base axes, (3,) [rad/s]."""
        return self._navigator.filter.angular_velocity

    def _on_reply(self, message: PointStamped) -> None:
        if not self._navigator.is_ready:
            return
        pose, point = self._navigator.pose, message.point
        offset = rotate(pose.rotation, np.array([point.x, point.y, point.z]))
        origin = pose.position + rotate(pose.rotation, self._usbl_place)
        self._filter.update(self._node.now, origin, offset)

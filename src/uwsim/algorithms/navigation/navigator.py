"""A navigation filter that is connected to the topics of the sensors.

The navigation frame has the axes north, east and down, the base x forward, y to starboard, z down.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ...base.geometry import Array, Pose
from ...bus import Node
from ...messages import DVL, Imu, Pressure, seconds
from .bottom import BottomPlane, parse_ranges
from .ekf import NavigationFilter, NavigationSpec

TOPICS: Mapping[str, str] = {
    "imu_topic": "/girona500/imu",
    "dvl_topic": "/girona500/dvl",
    "depth_topic": "/girona500/pressure",
}
"""The parameters with the topics of the sensors, and their defaults."""


class Navigator:
    """A `NavigationFilter` that reads the topics of an IMU, a DVL and a depth sensor.

    The axes of the IMU are assumed to be parallel to the axes of the base, and so are the axes of
    the DVL to which its ranges belong. Of the velocities in a DVL message, the bottom-track
    velocity in ship axes (``bs_...``) is used, which are the axes of the base. The depth sensor
    must publish a depth, as a ``<pressureSensor>`` does by default, not a pressure.
    Any algorithm can make a navigator in its `start`. Without a spec, the DVL is assumed to be at
    the origin of the base. If it is elsewhere, set ``NavigationSpec(dvl_place=...)``; otherwise the
    estimate drifts.
    """

    def __init__(
        self,
        node: Node,
        topics: Mapping[str, str] = TOPICS,
        spec: NavigationSpec | None = None,
    ) -> None:
        """Subscribe to the topics of the sensors.

        Args:
            node: the node of the algorithm.
            topics: the topics by the names in `TOPICS`.
            spec: the noise and the positions of the sensors; None: the defaults.
        """
        self.filter = NavigationFilter(spec or NavigationSpec())
        """The filter that estimates the motion of the vehicle."""
        self.bottom = BottomPlane()
        """The plane of the seabed below the vehicle, in the navigation frame."""
        node.subscribe(topics["imu_topic"], Imu, self._on_imu)
        node.subscribe(topics["dvl_topic"], DVL, self._on_dvl)
        node.subscribe(topics["depth_topic"], Pressure, self._on_depth)

    @property
    def is_ready(self) -> bool:
        """True if there is an estimate."""
        return self.filter.is_ready

    @property
    def pose(self) -> Pose:
        """The pose ``navigation_from_base``; z of its position is the depth of the base [m]."""
        return Pose(self.filter.position.copy(), self.filter.rotation.copy())

    @property
    def velocity(self) -> Array:
        """The velocity of the base over ground, navigation axes, (3,) [m/s]."""
        return self.filter.velocity.copy()

    @property
    def heading(self) -> float:
        """The heading of the base, from north towards east [rad]."""
        return self.filter.heading

    def _on_imu(self, message: Imu) -> None:
        q, w, f = message.orientation, message.angular_velocity, message.linear_acceleration
        self.filter.update_imu(
            seconds(message.header.stamp),
            np.array([q.w, q.x, q.y, q.z]),
            np.array([w.x, w.y, w.z]),
            np.array([f.x, f.y, f.z]),
        )

    def _on_dvl(self, message: DVL) -> None:
        if message.bs_status != "A":
            return
        self.filter.update_dvl(
            np.array([message.bs_longitudinal, message.bs_transverse, message.bs_normal])
        )
        pose = self.pose
        dvl_position = pose.transform(np.array([self.filter.spec.dvl_place]))[0]
        self.bottom.update(parse_ranges(message), Pose(dvl_position, pose.rotation))

    def _on_depth(self, message: Pressure) -> None:
        self.filter.update_depth(message.pressure)

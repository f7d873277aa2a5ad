"""Drive a vehicle along parallel tracks over the sea floor: an algorithm for ``uwsim run``.

uwsim run survey-scene --program examples/lawn_mower.py --for 4min --record survey.mcap
"""

from __future__ import annotations

import math
from typing import ClassVar

from uwsim import Node
from uwsim.messages import Odometry, TwistStamped

CORNER_TOLERANCE = 0.8  # a corner is reached within this distance [m]


class LawnMower:
    """An algorithm that follows tracks north and south, each further east, at the start depth."""

    PARAMETERS: ClassVar[dict[str, float]] = {
        "speed": 0.4,
        "length": 16.0,
        "spacing": 5.0,
        "tracks": 4.0,
    }

    def start(self, node: Node) -> None:
        """Subscribe to the odometry; each message leads to a command."""
        parameters = {name: float(value) for name, value in node.parameters.items()}
        self.values = {**self.PARAMETERS, **parameters}
        self.corners: list[tuple[float, float]] = []
        self.depth: float | None = None
        self.publish = node.publisher("/g500/twist", TwistStamped)
        node.subscribe("/g500/odom", Odometry, self.steer)

    def plan_corners(self, x: float, y: float) -> list[tuple[float, float]]:
        """Return the corners of the tracks from the start position, north and east [m]."""
        corners = []
        for track in range(round(self.values["tracks"])):
            east, ends = y + track * self.values["spacing"], [x, x + self.values["length"]]
            corners += [(north, east) for north in (ends if track % 2 == 0 else ends[::-1])]
        return corners

    def steer(self, odometry: Odometry) -> None:
        """Turn towards the next corner, slow down by the heading error, and hold the depth."""
        position, q = odometry.pose.pose.position, odometry.pose.pose.orientation
        if self.depth is None:
            self.depth, self.corners = position.z, self.plan_corners(position.x, position.y)
        yaw = math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
        while (
            self.corners and math.dist(self.corners[0], (position.x, position.y)) < CORNER_TOLERANCE
        ):
            self.corners.pop(0)
        command = TwistStamped()
        command.twist.linear.z = 0.5 * (self.depth - position.z)
        if self.corners:
            x, y = self.corners[0]
            heading = math.atan2(y - position.y, x - position.x)
            heading_error = math.remainder(heading - yaw, 2.0 * math.pi)
            command.twist.angular.z = max(-0.3, min(0.3, heading_error))
            command.twist.linear.x = self.values["speed"] * max(0.0, math.cos(heading_error)) ** 3
        self.publish(command)

"""Drive a vehicle along parallel tracks over the sea floor: a program for ``uwsim run``.

uwsim run survey-scene --program examples/lawn_mower.py --for 4min --record survey.mcap
"""

from __future__ import annotations

import math
from typing import ClassVar

from uwsim import Node
from uwsim.messages import Odometry, TwistStamped

NEAR = 0.8  # a corner is reached within this distance [m]


class LawnMower:
    """Follows tracks to the north and back, each further east, at the depth where it begins."""

    PARAMETERS: ClassVar[dict[str, float]] = {
        "speed": 0.4,
        "length": 16.0,
        "spacing": 5.0,
        "tracks": 4.0,
    }

    def start(self, node: Node) -> None:
        """Subscribe; each odometry message gives a command."""
        asked = {name: float(value) for name, value in node.parameters.items()}
        self.values = {**self.PARAMETERS, **asked}
        self.corners: list[tuple[float, float]] = []
        self.depth: float | None = None
        self.publish = node.publisher("/g500/twist", TwistStamped)
        node.subscribe("/g500/odom", Odometry, self.steer)

    def plan(self, x: float, y: float) -> list[tuple[float, float]]:
        """The corners of the tracks, from where it is [m]."""
        corners = []
        for track in range(round(self.values["tracks"])):
            across, ends = y + track * self.values["spacing"], [x, x + self.values["length"]]
            corners += [(end, across) for end in (ends if track % 2 == 0 else ends[::-1])]
        return corners

    def steer(self, odometry: Odometry) -> None:
        """Turn towards the next corner, ahead as far as the heading is right, hold the depth."""
        place, q = odometry.pose.pose.position, odometry.pose.pose.orientation
        if self.depth is None:
            self.depth, self.corners = place.z, self.plan(place.x, place.y)
        yaw = math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
        while self.corners and math.dist(self.corners[0], (place.x, place.y)) < NEAR:
            self.corners.pop(0)
        command = TwistStamped()
        command.twist.linear.z = 0.5 * (self.depth - place.z)
        if self.corners:
            x, y = self.corners[0]
            turn = math.remainder(math.atan2(y - place.y, x - place.x) - yaw, 2.0 * math.pi)
            command.twist.angular.z = max(-0.3, min(0.3, turn))
            command.twist.linear.x = self.values["speed"] * max(0.0, math.cos(turn)) ** 3
        self.publish(command)

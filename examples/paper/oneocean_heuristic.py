r"""The heuristic of OneOcean: a velocity through the water towards the present place.

.. math:: u = k_p (q - p), \qquad |u| \le u_{max}

for the position p and the place q, which is the newest on ``goal_topic``, or else the first
position. The law and its numbers are those of the repository OneOcean-IROS
(benchmark_core/controllers.py): 0.9 1/s towards places, 0.8 1/s for station keeping, 1.2 m/s.
`Heuristic` commands the twist of a vehicle that has velocity loops. `HeuristicForce` commands the
force of the gain of theirs, for the vehicle of oneocean_vehicle.xml.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from uwsim.algorithms.parametric import ParametricAlgorithm, start_benchmark, velocity_command
from uwsim.base.geometry import Array, rotation_from_quaternion
from uwsim.base.numerics.linear import rotate_back
from uwsim.bus import Node
from uwsim.messages import (
    Odometry,
    PoseStamped,
    TwistStamped,
    Vector3,
    Wrench,
    WrenchStamped,
    header,
)


class Heuristic(ParametricAlgorithm):
    """A proportional law from the position to the velocity of a vehicle."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "kp": 0.9,
        "limit": 1.2,
        "period": 0.1,
        "odom_topic": "/auv/odom",
        "goal_topic": "/auv/goal",
        "command_topic": "/auv/twist",
    }
    """The gain ``kp`` [1/s], the greatest speed ``limit`` [m/s], the ``period`` of the commands
    [s], and the topics."""

    def __init__(self) -> None:
        super().__init__()
        self._goal: Array | None = None  # in L (3,) [m]
        self._last_time: float | None = None  # of the last command [s]

    def start(self, node: Node) -> None:
        """Read the parameters, open the topics, and start the benchmark."""
        self._read_parameters(node.parameters)
        self._node = node
        self._open_topic(node)
        node.subscribe(self._text("goal_topic"), PoseStamped, self._on_goal)
        node.subscribe(self._text("odom_topic"), Odometry, self._on_odometry)
        start_benchmark(node)

    def _open_topic(self, node: Node) -> None:
        self._publish_twist = node.publisher(self._text("command_topic"), TwistStamped)

    def _on_goal(self, message: PoseStamped) -> None:
        point = message.pose.position
        self._goal = np.array([point.x, point.y, point.z])

    def _on_odometry(self, message: Odometry) -> None:
        point, turn = message.pose.pose.position, message.pose.pose.orientation
        position = np.array([point.x, point.y, point.z])  # in L
        if self._goal is None:
            self._goal = position
        now = self._node.now
        if self._last_time is not None and now - self._last_time < self._number("period") - 1e-6:
            return
        self._last_time = now
        velocity = self._number("kp") * (self._goal - position)
        speed = math.hypot(*velocity.tolist())
        velocity *= min(1.0, self._number("limit") / max(speed, 1e-9))
        quaternion = np.array([turn.w, turn.x, turn.y, turn.z])
        self._command(rotate_back(rotation_from_quaternion(quaternion), velocity))

    def _command(self, velocity: Array) -> None:
        """Publish the command of a velocity through the water, in base axes (3,) [m/s]."""
        self._publish_twist(velocity_command(velocity, 0.0, time=self._node.now))


class HeuristicForce(Heuristic):
    """The same law for a vehicle whose drag contains the velocity loop: the force k u."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **Heuristic.PARAMETERS,
        "force_gain": 18.0,
        "command_topic": "/auv/wrench",
    }
    """The parameters of `Heuristic`, and the gain k of the velocity loop [N s/m]."""

    def _open_topic(self, node: Node) -> None:
        self._publish_wrench = node.publisher(self._text("command_topic"), WrenchStamped)

    def _command(self, velocity: Array) -> None:
        x, y, z = (self._number("force_gain") * velocity).tolist()
        wrench = Wrench(force=Vector3(x=x, y=y, z=z), torque=Vector3(x=0.0, y=0.0, z=0.0))
        self._publish_wrench(WrenchStamped(header=header(self._node.now), wrench=wrench))

r"""``reach``: resolved-rate control of a vehicle with arm, which brings its tool to a point.

It reads the position :math:`e` of the point in the axes of the tool, the joint positions q and the
twist :math:`(\nu, \omega)` of the base from an observation. With the Jacobian J of the position p
of the tool in base axes, the velocities u of the four joints and of the base are the damped
least-squares solution (Whitney 1969; Nakamura and Hanafusa 1986)

.. math::

    u = W^{-1} A^T (A W^{-1} A^T + \lambda I)^{-1} (v - A u_0) + u_0, \quad A = [J \; I], \quad
    v = K_p R e

with the rotation R from the tool to the base and the weights W, which prefer the arm to the base.
:math:`u_0` moves the joints to the middle of their work, and :math:`|v|` is limited. A joint at its
limit does not move further. As the base does not follow at once, the joints receive the solution of
a second problem, whose base moves as it does: :math:`v - \nu - \omega \times p`.

The tool comes from above: its goal is over the point by as much as it is beside it, at most 0.2 m.
The wrist turns its closing axis across the y axis of the reached body, which is the bar of a
handle.

The base is commanded relative to the water. The velocity of the water is estimated as the filtered
difference of :math:`\nu` and the last command. The base keeps its heading. The arm is the ARM5E
below a Girona 500 (`uwsim.algorithms.grasp.arm`).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ...base.geometry import Array
from ...base.numerics import elementwise
from ...base.numerics.linear import cross, dot, length, product, rotate, solve
from ...bus import Node
from ...messages import JointState, header
from ..grasp.arm import DOWN_POSTURE, JOINT_LIMITS, JOINTS, Arm5e
from .observation_controller import ObservationController

JOINT_STEP = 1e-6
"""The step of the numerical Jacobian [rad]."""
MAX_APPROACH_HEIGHT = 0.2
"""The largest height of the tool's goal over the point [m]."""
LIMIT_MARGIN = 0.02
"""The distance from its limit at which a joint is not moved further [rad]."""
DAMPING = 1e-3
"""The damping of the least squares [m^2]."""


class Reach(ObservationController):
    """A resolved-rate controller of arm and base: brings the tool to a point and keeps it there."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "kp": 1.5,
        "filter_time": 1.0,
        "speed": 0.25,
        "base_weight": 4.0,
        "posture_gain": 0.2,
        "joint_speed": 0.5,
        "part": "handle",
        "state_topic": "/girona500/joint_state",
        "command_topic": "/girona500/joint_command",
        "twist_topic": "/girona500/twist",
    }
    """The gain ``kp`` [1/s], the ``filter_time`` of the estimate of the water's velocity [s], the
    largest ``speed`` of the tool over ground [m/s], the weight of the base relative to the joints
    [rad^2/m^2], the gain of the posture [1/s], the largest ``joint_speed`` [rad/s], the ``part`` of
    the observation with the position, the topic of the joints' state in the observation, and the
    topics of the commands."""
    CHANNELS: ClassVar[tuple[str, ...]] = ("linearVelocity", "angularVelocity", "gravity")

    def __init__(self) -> None:
        super().__init__()
        self._arm = Arm5e()
        self._water_velocity = np.zeros(3)  # estimate, in base axes [m/s]
        self._last_command = np.zeros(3)  # of the base, relative to the water [m/s]

    def start(self, node: Node) -> None:
        """Open the topic of the joints' commands, and start."""
        self._read_parameters(node.parameters)
        topic = str(self._parameters["command_topic"])
        self._publish_joints = node.publisher(topic, JointState)
        super().start(node)

    @property
    def channels(self) -> tuple[str, ...]:
        """The parts of the observation that are needed."""
        state = f"{self._parameters['state_topic']}:position"
        return (str(self._parameters["part"]), state, *self.CHANNELS)

    def command(self, parts: Mapping[str, Array], dt: float) -> tuple[Array, float]:
        """Publish the joints' velocities and return that of the base; see the base class."""
        part, state, linear, angular, gravity = (parts[name] for name in self.channels)
        joints = state[: len(JOINTS)]
        grip = self._arm.grip(joints)
        error = rotate(grip.rotation, part[:3])
        lateral_distance = length(error - dot(error, gravity) * gravity)
        error = error - min(MAX_APPROACH_HEIGHT, lateral_distance) * gravity
        velocity = self._number("kp") * error
        velocity = velocity * min(1.0, self._number("speed") / max(length(velocity), 1e-9))
        share = min(1.0, dt / self._number("filter_time"))
        innovation = linear - self._last_command - self._water_velocity
        self._water_velocity = self._water_velocity + share * innovation
        _, base_velocity = self._resolve(joints, velocity, base_weight=self._number("base_weight"))
        self._last_command = base_velocity - self._water_velocity
        tool_velocity = velocity - linear - cross(angular, grip.position)
        rates, _ = self._resolve(joints, tool_velocity, base_weight=math.inf)
        turn = float(elementwise.arctan2(part[7], part[6])) - math.pi / 2.0
        turn -= math.pi * math.floor(turn / math.pi + 0.5)
        top_speed = self._number("joint_speed")
        rates[3] = min(top_speed, max(-top_speed, self._number("kp") * turn))
        self._publish_joints(
            JointState(
                header=header(self._node.now),
                name=list(JOINTS),
                position=np.zeros(0),
                velocity=rates,
                effort=np.zeros(0),
            )
        )
        return self._last_command, 0.0

    def _resolve(
        self, joints: Array, velocity: Array, *, base_weight: float
    ) -> tuple[Array, Array]:
        """Return the velocities of the joints (4,) [rad/s] and of the base (3,) [m/s]."""
        n, top_speed = len(JOINTS), self._number("joint_speed")
        motion = np.hstack([self._jacobian(joints), np.eye(3)])
        posture_rates = np.zeros(n + 3)
        posture_rates[:n] = self._number("posture_gain") * (DOWN_POSTURE - joints)
        inverse_weights = np.ones(n + 3)
        inverse_weights[n:] = 1.0 / base_weight
        for _ in range(2):  # a second time without the joints that would pass their limits
            scaled_motion = motion * inverse_weights
            normal = product(scaled_motion, motion.T) + DAMPING * np.eye(3)
            residual = velocity - product(motion, posture_rates)
            rates = product(scaled_motion.T, solve(normal, residual)) + posture_rates
            rates[:n] = np.clip(rates[:n], -top_speed, top_speed)
            low = (joints < JOINT_LIMITS[:, 0] + LIMIT_MARGIN) & (rates[:n] < 0.0)
            high = (joints > JOINT_LIMITS[:, 1] - LIMIT_MARGIN) & (rates[:n] > 0.0)
            motion[:, :n][:, low | high] = 0.0
            posture_rates[:n][low | high] = 0.0
        return rates[:n], rates[n:]

    def _jacobian(self, joints: Array) -> Array:
        """Return the Jacobian of the grip's position in base axes, (3, 4) [m/rad]."""
        columns = []
        for k in range(len(JOINTS)):
            step = np.zeros(len(JOINTS))
            step[k] = JOINT_STEP
            difference = self._arm.grip(joints + step).position - (
                self._arm.grip(joints - step).position
            )
            columns.append(difference / (2.0 * JOINT_STEP))
        return np.stack(columns, axis=1)


class ReachProportional(Reach):
    """``reach`` without an estimate of the water's velocity: a current shifts the vehicle."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {**Reach.PARAMETERS, "filter_time": 1e9}
    """The parameters of `Reach`, with a ``filter_time`` [s] that no level reaches."""

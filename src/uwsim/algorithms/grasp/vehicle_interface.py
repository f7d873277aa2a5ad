"""The interface of the state machine to the vehicle, its arm, jaw and wrist.

Positions are in the navigation frame (north, east, down); the frame of the base has x forward, y to
starboard and z down. The *grip* is the point between the fingers of the jaw (`arm`).
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from ...base.geometry import Array, Pose
from ...base.numerics.linear import length, rotate
from ...messages import JointState, Twist, TwistStamped, Vector3, WrenchStamped, header
from .arm import DOWN_POSTURE, JAW, JAW_CLOSED, JAW_OPEN, JOINTS, STOWED_POSTURE, Kinematics
from .station import StationLaw, TrackingState

MAX_COMPENSATION = 0.08
"""The largest position error of the vehicle along an axis that the arm compensates [m]."""
MIN_JOINT_CHANGE = 0.004
"""The minimum change of a joint command that is published [rad]."""
WRIST_WEIGHT = 0.1
"""The weight of a sample in the smoothed force of the wrist [1]; at 50 Hz it gives a time constant
of 0.2 s."""
MIN_GRIP_OPENING = 0.02
"""The minimum opening of fingers, beyond the closed position, when they hold an object [rad]."""
MIN_GRIP_TORQUE = 2.0
"""The minimum torque of the fingers' drive when they hold an object [N m]."""
MAX_REST_SPEED = 0.02
"""The speed below which a joint is at rest [rad/s]."""


class Jaw:
    """The state of the jaw, two fingers with one drive, from joint states."""

    def __init__(self) -> None:
        self.setpoint = JAW_OPEN
        """The commanded position of the joint of the fingers [rad]."""
        self.position = 0.0
        """The position of the joint of the fingers [rad]."""
        self._speed = 0.0  # speed of the fingers [rad/s]
        self._effort = 0.0  # torque of the drive, from its current [N m]

    def update(
        self,
        positions: Mapping[str, float],
        speeds: Mapping[str, float],
        efforts: Mapping[str, float],
    ) -> None:
        """Set the state from positions [rad], speeds [rad/s] and torques [N m] by joint name."""
        self.position, self._speed = positions[JAW], speeds.get(JAW, 0.0)
        self._effort = abs(efforts.get(JAW, 0.0))

    @property
    def is_moving(self) -> bool:
        """True if the fingers move."""
        return abs(self._speed) > MAX_REST_SPEED

    @property
    def holds_object(self) -> bool:
        """True if the drive presses the fingers together and an object keeps them apart."""
        return self.position > JAW_CLOSED + MIN_GRIP_OPENING and self._effort > MIN_GRIP_TORQUE


class Wrist:
    """The smoothed force on the wrist; without the force sensor there is no force."""

    def __init__(self) -> None:
        self._force: Array | None = None  # smoothed, in the sensor's axes, (3,) [N]
        self._tare: Array | None = None  # the force without a load (3,) [N]

    def on_wrist(self, message: WrenchStamped) -> None:
        """Add a sample of the force sensor to the smoothed force."""
        force = message.wrench.force
        sample = np.array([force.x, force.y, force.z])
        self._force = (
            sample if self._force is None else self._force + WRIST_WEIGHT * (sample - self._force)
        )

    def tare(self) -> None:
        """Store the present force as the force without a load."""
        self._tare = self._force

    @property
    def load(self) -> float | None:
        """The size of the change of the force since `tare` [N]; None without a force sensor."""
        if self._force is None or self._tare is None:
            return None
        return length(self._force - self._tare)


class VehicleInterface:
    """A vehicle with an arm: converts goals to twists and joint commands.

    The base moves to the position `goal` and the heading `goal_heading`. If `grip_goal` is set, the
    arm moves the grip there, which compensates the position error of the base up to
    `MAX_COMPENSATION`.

    Args:
        law: the control law of the base.
        kinematics: the kinematics of the arm.
    """

    def __init__(self, law: StationLaw, kinematics: Kinematics) -> None:
        self.law, self.kinematics = law, kinematics
        self.pose = Pose.identity()
        """The pose ``navigation_from_base``."""
        self.velocity: Array = np.zeros(3)
        """The velocity of the base over ground, navigation axes, (3,) [m/s]."""
        self.goal: Array | None = None
        """The goal of the base, navigation frame, (3,) [m]; None: no motion."""
        self.goal_velocity: Array = np.zeros(3)
        """The velocity of the goal, navigation axes, (3,) [m/s]."""
        self.goal_heading = 0.0
        """The goal of the heading, from north towards east [rad]."""
        self.grip_goal: Array | None = None
        """The goal of the grip, navigation frame, (3,) [m]; None: the arm keeps `posture`."""
        self.closing_heading = 0.0
        """The heading of the axis along which the jaw closes, navigation frame [rad]."""
        self.posture: Array = STOWED_POSTURE.copy()
        """The commanded joint positions of the arm, (4,) [rad]."""
        self.joints: Array = STOWED_POSTURE.copy()
        """The measured joint positions of the arm, (4,) [rad]."""
        self.jaw = Jaw()
        """The jaw of the arm."""
        self.wrist = Wrist()
        """The wrist of the arm, with its force sensor."""
        self._sent_command: Array = np.full(5, math.inf)  # last command of arm and jaw [rad]

    @property
    def heading(self) -> float:
        """The heading of the base, from north towards east [rad]."""
        return math.atan2(self.pose.rotation[1, 0], self.pose.rotation[0, 0])

    @property
    def grip(self) -> Array:
        """The position of the grip, navigation frame, (3,) [m]."""
        in_base = self.kinematics.grip(self.joints).position
        position: Array = self.pose.transform(in_base[None])[0]
        return position

    @property
    def is_arm_settled(self) -> bool:
        """True if all joints of the arm are near their commanded positions."""
        return bool(np.abs(self.joints - self.posture).max() < 0.05)

    def base_position_for(self, grip: Array, posture: Array = DOWN_POSTURE) -> Array:
        """Compute the position of the base at which the grip has a given position.

        Args:
            grip: the position of the grip, navigation frame, (3,) [m].
            posture: the joint positions of the arm, (4,) [rad].

        Returns:
            The position of the base at its present attitude, navigation frame, (3,) [m].
        """
        offset = rotate(self.pose.rotation, self.kinematics.grip(posture).position)
        position: Array = grip - offset
        return position

    def wrist_angle_for(self, closing_heading: float) -> float:
        """Return the position of the wrist's joint, nearest to 0, for a closing heading [rad]."""
        angle = closing_heading - self.goal_heading
        return angle - math.pi * math.floor(angle / math.pi + 0.5)

    def on_joints(self, message: JointState) -> None:
        """Set the measured state of arm and jaw."""
        positions = dict(zip(message.name, message.position.tolist(), strict=False))
        speeds = dict(zip(message.name, message.velocity.tolist(), strict=False))
        efforts = dict(zip(message.name, message.effort.tolist(), strict=False))
        if all(name in positions for name in (*JOINTS, JAW)):
            self.joints = np.array([positions[name] for name in JOINTS])
            self.jaw.update(positions, speeds, efforts)

    def twist(self, time: float, dt: float) -> TwistStamped:
        """Compute the twist that moves the base to its goal.

        Args:
            time: the time of the message's stamp [s].
            dt: the time since the last call [s].
        """
        error = np.zeros(3) if self.goal is None else self.goal - self.pose.position
        heading_error = self.goal_heading - self.heading
        heading_error -= 2.0 * math.pi * math.floor(heading_error / (2.0 * math.pi) + 0.5)
        state = TrackingState(
            error=error,
            heading_error=heading_error,
            velocity=self.velocity,
            rotation=self.pose.rotation,
            goal_velocity=self.goal_velocity,
        )
        (x, y, z), rate = self.law.step(state, dt)
        return TwistStamped(
            header=header(time),
            twist=Twist(
                linear=Vector3(x=float(x), y=float(y), z=float(z)),
                angular=Vector3(x=0.0, y=0.0, z=rate),
            ),
        )

    def joint_command(self, time: float) -> JointState | None:
        """Return the position commands of arm and jaw; None if they did not change.

        ``time`` is the time of the message's stamp [s].
        """
        if self.grip_goal is not None:
            self.posture = self._compensating_joints(self.grip_goal)
        command = np.array([*self.posture.tolist(), self.jaw.setpoint])
        if np.abs(command - self._sent_command).max() < MIN_JOINT_CHANGE:
            return None
        self._sent_command = command
        return JointState(
            header=header(time),
            name=[*JOINTS, JAW],
            position=command,
            velocity=np.zeros(0),
            effort=np.zeros(0),
        )

    def _compensating_joints(self, goal: Array) -> Array:
        """Compute the joint positions (4,) [rad] with the grip at its goal (3,) [m].

        The grip moves by at most `MAX_COMPENSATION` along each axis of the base, from its position
        with the lowered arm.
        """
        position = self.pose.inverse().transform(goal[None])[0]
        centre = self.kinematics.grip(DOWN_POSTURE).position
        position = centre + np.clip(position - centre, -MAX_COMPENSATION, MAX_COMPENSATION)
        start = np.array([*DOWN_POSTURE[:3].tolist(), self.wrist_angle_for(self.closing_heading)])
        return self.kinematics.reach(position, self.closing_heading - self.heading, start).joints

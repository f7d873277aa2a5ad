"""The vehicle as the state machine sees it: where it is, where it should go, its arm and jaw."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from ...base.geometry import Array, Pose
from ...base.numerics.linear import length, rotate
from ...messages import JointState, Twist, TwistStamped, Vector3, WrenchStamped, header
from .arm import CLOSED, DOWN, FOLDED, JAW, JOINTS, OPEN, Kinematics
from .station import Motion, StationLaw

MAX_REACH = 0.08
"""The arm makes up for this much of the vehicle's error at most [m]."""
JOINT_STEP = 0.004
"""Smaller changes of the arm's command are not sent [rad]."""
WRIST_SHARE = 0.1
"""Share of a sample of the wrist's force in the smoothed one: 0.2 s at 50 Hz."""
GRIPPED = 0.02
"""Fingers that stand further open than closed by this have something between them [rad]."""
PRESSED = 2.0
"""Least torque of their drive while they press [N m]."""
STILL = 0.02
"""A joint that is slower stands still [rad/s]."""


class Jaw:
    """Two fingers with one drive, as its joint states tell."""

    def __init__(self) -> None:
        self.wanted = OPEN
        """The fingers' position wanted [rad]."""
        self.position = 0.0
        """The fingers' position [rad]."""
        self._speed = 0.0  # of the fingers [rad/s]
        self._effort = 0.0  # torque of the drive, as its current tells [N m]

    def take(
        self,
        positions: Mapping[str, float],
        speeds: Mapping[str, float],
        efforts: Mapping[str, float],
    ) -> None:
        """Take the states of joints: positions [rad], speeds [rad/s] and torques [N m] by name."""
        self.position, self._speed = positions[JAW], speeds.get(JAW, 0.0)
        self._effort = abs(efforts.get(JAW, 0.0))

    @property
    def is_moving(self) -> bool:
        """Whether the fingers move."""
        return abs(self._speed) > STILL

    @property
    def holds_something(self) -> bool:
        """Whether the fingers press, and are kept apart by something."""
        return self.position > CLOSED + GRIPPED and self._effort > PRESSED


class Wrist:
    """The force on the wrist, smoothed; an arm without the sensor has no samples."""

    def __init__(self) -> None:
        self._force: Array | None = None  # smoothed, in the sensor's axes, (3,) [N]
        self._tare: Array | None = None

    def on_wrist(self, message: WrenchStamped) -> None:
        """Take a sample of the force sensor in the wrist."""
        force = message.wrench.force
        sample = np.array([force.x, force.y, force.z])
        self._force = (
            sample if self._force is None else self._force + WRIST_SHARE * (sample - self._force)
        )

    def tare(self) -> None:
        """Take the wrist's force now as that of the arm alone."""
        self._tare = self._force

    @property
    def load(self) -> float | None:
        """Force that hangs on the wrist since `tare` [N]; None without a sensor."""
        if self._force is None or self._tare is None:
            return None
        return length(self._force - self._tare)


class Craft:
    """A vehicle with an arm: goals in, twists and joint commands out.

    It keeps `goal` (base in the navigation frame) and `heading`. With `grip_goal` set, the arm
    makes up for what the vehicle is off, within `MAX_REACH`.
    """

    def __init__(self, law: StationLaw, kinematics: Kinematics) -> None:
        self.law, self.kinematics = law, kinematics
        self.pose = Pose.identity()
        """``navigation_from_base``."""
        self.velocity: Array = np.zeros(3)
        """Over ground, navigation axes, (3,) [m/s]."""
        self.goal: Array | None = None
        """Where the base should be, (3,) [m]; None: where it is."""
        self.goal_velocity: Array = np.zeros(3)
        """How fast the goal moves, (3,) [m/s]."""
        self.heading = 0.0
        """Heading wanted [rad]."""
        self.grip_goal: Array | None = None
        """Where the grip should be, navigation frame, (3,) [m]; None: the arm stays."""
        self.closes = 0.0
        """Heading of the axis along which the jaw closes, navigation frame [rad]."""
        self.posture: Array = FOLDED.copy()
        """The arm's joints wanted, (4,) [rad]."""
        self.joints: Array = FOLDED.copy()
        """The arm's joints, (4,) [rad]."""
        self.jaw = Jaw()
        """What it grips with."""
        self.wrist = Wrist()
        """What the force sensor of the arm feels."""
        self._sent: Array = np.full(5, math.inf)

    @property
    def own_heading(self) -> float:
        """Of the base [rad]."""
        return math.atan2(self.pose.rotation[1, 0], self.pose.rotation[0, 0])

    @property
    def grip(self) -> Array:
        """Where the grip is, navigation frame, (3,) [m]."""
        in_base = self.kinematics.grip(self.joints).position
        place: Array = self.pose.transform(in_base[None])[0]
        return place

    @property
    def is_still(self) -> bool:
        """Whether arm and jaw are where they should be."""
        return bool(np.abs(self.joints - self.posture).max() < 0.05)

    def base_for(self, grip: Array, posture: Array = DOWN) -> Array:
        """Return where the base should be for the grip of a posture to be at a place (3,) [m]."""
        offset = rotate(self.pose.rotation, self.kinematics.grip(posture).position)
        place: Array = grip - offset
        return place

    def wrist_for(self, closes: float) -> float:
        """Return the wrist's joint [rad] for a heading of the jaw's axis, the nearest."""
        turn = closes - self.heading
        return turn - math.pi * math.floor(turn / math.pi + 0.5)

    def on_joints(self, message: JointState) -> None:
        """Take joint states."""
        where = dict(zip(message.name, message.position.tolist(), strict=False))
        speeds = dict(zip(message.name, message.velocity.tolist(), strict=False))
        efforts = dict(zip(message.name, message.effort.tolist(), strict=False))
        if all(name in where for name in (*JOINTS, JAW)):
            self.joints = np.array([where[name] for name in JOINTS])
            self.jaw.take(where, speeds, efforts)

    def twist(self, time: float, dt: float) -> TwistStamped:
        """Return the twist that leads to the goal."""
        error = np.zeros(3) if self.goal is None else self.goal - self.pose.position
        turn = self.heading - self.own_heading
        turn -= 2.0 * math.pi * math.floor(turn / (2.0 * math.pi) + 0.5)
        motion = Motion(
            error=error,
            turn=turn,
            velocity=self.velocity,
            rotation=self.pose.rotation,
            wanted=self.goal_velocity,
        )
        (x, y, z), rate = self.law.step(motion, dt)
        return TwistStamped(
            header=header(time),
            twist=Twist(
                linear=Vector3(x=float(x), y=float(y), z=float(z)),
                angular=Vector3(x=0.0, y=0.0, z=rate),
            ),
        )

    def joint_command(self, time: float) -> JointState | None:
        """Return the command of arm and jaw; None where nothing changed."""
        if self.grip_goal is not None:
            self.posture = self._compensated(self.grip_goal)
        wanted = np.array([*self.posture.tolist(), self.jaw.wanted])
        if np.abs(wanted - self._sent).max() < JOINT_STEP:
            return None
        self._sent = wanted
        return JointState(
            header=header(time),
            name=[*JOINTS, JAW],
            position=wanted,
            velocity=np.zeros(0),
            effort=np.zeros(0),
        )

    def _compensated(self, goal: Array) -> Array:
        """Joints (4,) with the grip as near to its goal as the arm may go."""
        place = self.pose.inverse().transform(goal[None])[0]
        usual = self.kinematics.grip(DOWN).position
        place = usual + np.clip(place - usual, -MAX_REACH, MAX_REACH)
        start = np.array([*DOWN[:3].tolist(), self.wrist_for(self.closes)])
        return self.kinematics.reach(place, self.closes - self.own_heading, start).joints

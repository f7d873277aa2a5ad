r"""The base class of manoeuvring algorithms: approach, programs, steering, and holding of depth.

A manoeuvre begins with an approach: constant thrust on a straight course at a constant depth. Then
a program orders rudder angles, and reads the motion from odometry. Depth is held at all times.

*Fins* turn by the rudder angle. *Thrusters* have no rudder: the ordered angle :math:`\delta` means
the yaw moment :math:`N = \delta \, N_{max} / 35°`. :math:`N_{max}` is the greatest moment that the
thrusters exert beside the thrust of the approach. "Hard over", 35°, is thus all that they can do.

On a straight course the rudder follows from the heading error e and the yaw rate r:

.. math:: \delta = k_p e + k_i \int e \, dt - k_d r

Elevators hold the depth by pitching, at most 20°; thrusters by a heave force that is in proportion
to the error of depth and to its rate. The yaw rate is the difference of two headings, so that noise
of odometry is not filtered.
"""

from __future__ import annotations

import abc
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...base.geometry import Array, rotation_from_quaternion
from ...bus import Node
from ...messages import (
    Float64MultiArray,
    MultiArrayLayout,
    Odometry,
    Vector3,
    Wrench,
    WrenchStamped,
    header,
)
from ..tracker_node import merge_parameters
from .parameters import STEERING, check_numbers, parse_numbers
from .programs import Hold, Motion, Order, Program

MAX_PITCH = math.radians(20.0)
"""The greatest pitch that is ordered to hold the depth [rad]."""
LAYOUT = MultiArrayLayout(dim=[], data_offset=0)


@dataclass(frozen=True, eq=False, kw_only=True)
class Attitude:
    """The attitude and position of a vehicle, of which odometry informs."""

    position: Array
    """The position north, east and down, (3,) [m]."""
    roll: float
    """The roll, positive if starboard is down [rad]."""
    pitch: float
    """The pitch, positive if the bow is up [rad]."""
    heading: float
    """The heading, positive to starboard [rad]."""
    side: float
    """1 if z of the vehicle's base points down, -1 if it points up."""

    @property
    def depth(self) -> float:
        """The depth [m]."""
        return float(self.position[2])

    @property
    def numbers(self) -> tuple[float, float, float]:
        """The numbers whose rates are used: depth [m], roll and pitch [rad]."""
        return self.depth, self.roll, self.pitch


def read_attitude(message: Odometry, *, has_z_down: bool) -> Attitude:
    """Return the attitude in a message, whose frame has z down, or z up with y to port."""
    orientation, point = message.pose.pose.orientation, message.pose.pose.position
    rotation = rotation_from_quaternion(
        np.array([orientation.w, orientation.x, orientation.y, orientation.z])
    )
    down = 1.0 if has_z_down else -1.0
    bow = rotation[:, 0] * (1.0, down, down)
    side = math.copysign(1.0, down * float(rotation[2, 2]))
    return Attitude(
        position=np.array([point.x, down * point.y, down * point.z]),
        roll=math.atan2(side * down * rotation[2, 1], side * down * rotation[2, 2]),
        pitch=-math.asin(min(max(float(bow[2]), -1.0), 1.0)),
        heading=math.atan2(bow[1], bow[0]),
        side=side,
    )


class ManoeuvreNode(abc.ABC):
    """An algorithm that steers a vehicle; derived classes define `make_program`."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = STEERING
    """The parameters with their defaults; other names are rejected."""

    def __init__(self) -> None:
        self.rudder = 0.0
        """The rudder angle that was ordered last, positive to starboard [rad]."""
        self.begin_time: float | None = None
        """The time at which the manoeuvre began, after the approach [s]; None before."""
        self._last_sample: tuple[float, float, Array] | None = None  # time, heading, position
        self._integral = 0.0  # of the heading error [rad s]
        self._first_heading = 0.0
        self._begin_heading = 0.0
        self._last_attitude: Attitude | None = None
        self._depth = self._last_publication = 0.0

    @abc.abstractmethod
    def make_program(self, parameters: Mapping[str, float | str]) -> Program:
        """Make the program of the manoeuvre."""

    @staticmethod
    def check_parameters(parameters: Mapping[str, float | str]) -> None:
        """Raise BadSetting if a list of numbers or a time is invalid."""
        check_numbers(parameters)

    @property
    def is_finished(self) -> bool:
        """The state of the program: True after its last order."""
        return self._program.is_finished

    @property
    def hold_intervals(self) -> tuple[Hold, ...]:
        """The times of steady states, from the beginning of the manoeuvre on."""
        return tuple(self._program.hold_intervals)

    def start(self, node: Node) -> None:
        """Read the parameters and connect to the topics."""
        self._node = node
        self._parameters = parameters = merge_parameters(self.PARAMETERS, node.parameters)
        self._rudders = parse_numbers("rudders", parameters["rudders"])
        self._elevators = parse_numbers("elevators", parameters["elevators"])
        self._limit = math.radians(self._number("limit"))
        self._program = self.make_program(parameters)
        wrench_topic, fins_topic = str(parameters["wrench_topic"]), str(parameters["fins_topic"])
        self._send_wrench = node.publisher(wrench_topic, WrenchStamped) if wrench_topic else None
        self._send_fins = node.publisher(fins_topic, Float64MultiArray) if fins_topic else None
        self._send_rudder = node.publisher(str(parameters["rudder_topic"]), Float64MultiArray)
        node.subscribe(str(parameters["odometry_topic"]), Odometry, self._on_odometry)

    def _number(self, name: str) -> float:
        return float(self._parameters[name])

    def _on_odometry(self, message: Odometry) -> None:
        attitude = read_attitude(message, has_z_down=bool(self._number("z_down")))
        order = self._compute_order(attitude.heading, attitude.position)
        if order is not None:
            self.rudder = min(max(order.rudder, -self._limit), self._limit)
            self._publish(order, attitude)

    def _compute_order(self, heading: float, position: Array) -> Order | None:
        """Return the order of the approach or of the program; None at the first message."""
        now = self._node.now
        if self._last_sample is None:
            self._first_heading, self._begin_time = heading, now
            self._last_sample = now, heading, position
            return None
        last_time, last_heading, last_position = self._last_sample
        if now <= last_time:
            return None
        heading = last_heading + math.remainder(heading - last_heading, 2.0 * math.pi)
        dt = now - last_time
        rate = (heading - last_heading) / dt
        step = (position - last_position) / dt
        speed = float(step[0] * math.cos(heading) + step[1] * math.sin(heading))
        self._last_sample = now, heading, position
        if now - self._begin_time < self._number("approach") - 1e-9:
            return Order(rudder=self._hold_heading(self._first_heading - heading, rate, dt))
        if self.begin_time is None:
            self.begin_time, self._begin_heading = now, heading
        motion = Motion(
            time=now - self.begin_time,
            heading_change=heading - self._begin_heading,
            yaw_rate=rate,
            speed=speed,
        )
        return self._program.step(motion)

    def _hold_heading(self, error: float, rate: float, dt: float) -> float:
        """Return the rudder angle that holds a heading, with anti-windup by clamping [rad]."""
        integral = self._integral + error * dt
        kp, ki, kd = (self._number(f"heading_{term}") for term in ("kp", "ki", "kd"))
        rudder = kp * error + ki * integral - kd * rate
        if abs(rudder) < self._limit or rudder * error < 0.0:
            self._integral = integral
        return rudder

    def _publish(self, order: Order, attitude: Attitude) -> None:
        if self._last_attitude is None:
            self._depth, self._last_attitude = attitude.depth, attitude
            self._last_publication = self._node.now
        dt, last_attitude = self._node.now - self._last_publication, self._last_attitude
        rates = (
            [(x - y) / dt for x, y in zip(attitude.numbers, last_attitude.numbers, strict=True)]
            if dt > 0.0
            else [0.0, 0.0, 0.0]
        )
        self._last_attitude, self._last_publication = attitude, self._node.now
        error = attitude.depth - self._depth
        self._send_rudder(Float64MultiArray(layout=LAYOUT, data=np.array([self.rudder])))
        if self._send_fins is not None:
            angles = self._fin_angles(error, attitude.pitch, rates[2])
            self._send_fins(Float64MultiArray(layout=LAYOUT, data=angles))
        if self._send_wrench is not None:
            sizes = {1.0: self._number("ahead"), -1.0: -self._number("astern")}
            heave = -self._feedback("heave", error, rates[0])
            roll = -self._feedback("roll", attitude.roll, rates[1])
            pitch = -self._feedback("trim", attitude.pitch, rates[2])
            yaw, side = self._number("yaw_moment") * self.rudder, attitude.side
            wrench = Wrench(
                force=Vector3(x=sizes.get(order.thrust, 0.0), y=0.0, z=side * heave),
                torque=Vector3(x=roll, y=side * pitch, z=side * yaw),
            )
            self._send_wrench(WrenchStamped(header=header(self._node.now), wrench=wrench))

    def _feedback(self, name: str, error: float, rate: float) -> float:
        return self._number(f"{name}_kp") * error + self._number(f"{name}_kd") * rate

    def _fin_angles(self, depth_error: float, pitch: float, pitch_rate: float) -> Array:
        """Return the angle of each fin for the rudder, and for the pitch that holds the depth."""
        requested_pitch = self._number("pitch_per_depth") * depth_error
        requested_pitch = min(max(requested_pitch, -MAX_PITCH), MAX_PITCH)
        elevator = (
            self._number("pitch_kp") * (requested_pitch - pitch)
            - self._number("pitch_kd") * pitch_rate
        )
        elevator = min(max(elevator, -self._limit), self._limit)
        return np.array(
            [
                rudder * self.rudder + weight * elevator
                for rudder, weight in zip(self._rudders, self._elevators, strict=True)
            ]
        )

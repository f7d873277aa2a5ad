r"""``homing`` and ``homing-los``: a torpedo-shaped vehicle steers to a beacon in a dock.

The vehicle has one propeller, rudders and elevators. `beacon` estimates the position of the beacon.
The heading error e gives the rudder :math:`\delta = k_\psi e - k_r r` with the yaw rate r. The
error of depth gives a pitch, and the pitch the elevator in the same way.

``homing`` is pure pursuit: it turns its bow to the beacon. ``homing-los`` follows the axis of the
dock, with the heading :math:`\chi`, by line-of-sight guidance. With the distance y to starboard of
the axis, the desired course over ground is

.. math:: \chi_d = \chi - \arctan(y / \Delta)

with the look-ahead distance :math:`\Delta`. The desired heading is :math:`\chi_d - \beta_c` with
the crab angle :math:`\beta_c` from the heading to the course, which the velocity of the DVL gives
(Fossen 2021, *Handbook of Marine Craft*, section 12.5). In a cross current the vehicle thus goes
along the axis with its bow against the current.
"""

from __future__ import annotations

import abc
import math
from collections.abc import Callable, Mapping
from typing import ClassVar

import numpy as np

from ...bus import Node
from ...messages import Float64MultiArray, MultiArrayLayout
from ..parametric import ParametricAlgorithm, start_benchmark
from .beacon import BEACON_PARAMETERS, SENSOR_TOPICS, BeaconNavigator

MAX_PITCH = math.radians(15.0)
"""The greatest pitch that is ordered to change the depth [rad]."""
MIN_SPEED = 0.3
"""The speed over ground below which the course is not used [m/s]."""
MAX_CRAB = math.radians(60.0)
"""The greatest crab angle that is used [rad]."""
MAX_FIN = math.radians(13.5)
"""The greatest angle of a fin [rad]."""


class BeaconSteering(ParametricAlgorithm, abc.ABC):
    """A helmsman of a torpedo-shaped vehicle; derived classes define the course."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "throttle": 1.0,
        "heading_kp": 1.0,
        "heading_kd": 0.8,
        "pitch_kp": 1.0,
        "pitch_kd": 0.6,
        "pitch_per_depth": 0.2,
        "pitch_ki": 0.02,
        **BEACON_PARAMETERS,
        "usbl_x": 0.55,
        "dvl_x": -0.2,
        "dvl_z": 0.09,
        "period": 0.1,
        **SENSOR_TOPICS,
        "imu_topic": "/remus/imu",
        "dvl_topic": "/remus/dvl",
        "depth_topic": "/remus/depth",
        "usbl_topic": "/remus/usbl",
        "propeller_topic": "/remus/propeller",
        "fins_topic": "/remus/fins",
    }
    """The command of the propeller, the gains of heading [1, s], pitch [1, s], depth [rad/m]
    and its integral [rad/(m s)], the numbers of `beacon`, the ``period`` of the commands [s], and
    the topics."""

    def __init__(self) -> None:
        super().__init__()
        self._depth_integral = 0.0  # [m s]

    def start(self, node: Node) -> None:
        """Read the parameters, connect to topics, and start the benchmark."""
        self._read_parameters(node.parameters)
        self._numbers = {
            name: self._number(name) for name in self.PARAMETERS if "topic" not in name
        }
        self._push = node.publisher(self._text("propeller_topic"), Float64MultiArray)
        self._turn_fins = node.publisher(self._text("fins_topic"), Float64MultiArray)
        self._navigator = BeaconNavigator(node, self.parameters)
        node.create_timer(self._numbers["period"], self._steer)
        start_benchmark(node)

    @abc.abstractmethod
    def course(self, north: float, east: float) -> float:
        """Return the desired heading [rad].

        Args:
            north: the distance of the beacon to the north of the base [m].
            east: the distance of the beacon to the east of the base [m].
        """

    def _steer(self) -> None:
        if not self._navigator.is_ready:
            return
        numbers, (_, pitch_rate, yaw_rate) = self._numbers, self._navigator.rates.tolist()
        north, east, down = self._navigator.offset.tolist()
        error = math.remainder(self.course(north, east) - self._navigator.heading, math.tau)
        rudder = _limit(numbers["heading_kp"] * error - numbers["heading_kd"] * yaw_rate, MAX_FIN)
        pitch = self._desired_pitch(down)
        pitch_error = pitch - self._navigator.pitch
        elevator = _limit(
            numbers["pitch_kp"] * pitch_error - numbers["pitch_kd"] * pitch_rate, MAX_FIN
        )
        # positive angles of the fins turn the bow to port and down
        _send(self._turn_fins, [-rudder, -rudder, -elevator, -elevator])
        _send(self._push, [numbers["throttle"]])

    def _desired_pitch(self, down: float) -> float:
        """Return the pitch that brings the vehicle to the depth of a beacon ``down`` below it."""
        numbers = self._numbers
        pitch = -numbers["pitch_per_depth"] * down - numbers["pitch_ki"] * self._depth_integral
        if abs(pitch) < MAX_PITCH:
            self._depth_integral += down * numbers["period"]
        return _limit(pitch, MAX_PITCH)


class Homing(BeaconSteering):
    """A pure pursuit of a beacon by a torpedo-shaped vehicle: the bow points to it."""

    def course(self, north: float, east: float) -> float:
        """Return the bearing of the beacon [rad]."""
        return math.atan2(east, north)


class HomingLineOfSight(BeaconSteering):
    """A line-of-sight guidance along the axis of a dock, with a crab angle against a current."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **BeaconSteering.PARAMETERS,
        "axis": 0.0,
        "look_ahead": 5.0,
    }
    """The parameters of `BeaconSteering`, the heading of the dock's ``axis`` [rad] and the
    look-ahead distance [m]."""

    def course(self, north: float, east: float) -> float:
        """Return the heading of the law in this module [rad]."""
        axis = self._numbers["axis"]
        offset = math.sin(axis) * north - math.cos(axis) * east  # to starboard of the axis
        course = axis - math.atan2(offset, self._numbers["look_ahead"])
        return course - self._crab_angle()

    def _crab_angle(self) -> float:
        """Return the angle from the heading to the course over ground, 0 when slow [rad]."""
        north, east, _ = self._navigator.velocity.tolist()
        if math.hypot(north, east) < MIN_SPEED:
            return 0.0
        angle = math.remainder(math.atan2(east, north) - self._navigator.heading, math.tau)
        return _limit(angle, MAX_CRAB)


def _limit(value: float, limit: float) -> float:
    return min(limit, max(-limit, value))


def _send(publish: Callable[[Float64MultiArray], None], numbers: list[float]) -> None:
    layout = MultiArrayLayout(dim=[], data_offset=0)
    publish(Float64MultiArray(layout=layout, data=np.array(numbers)))

"""A vehicle that goes to places by its own navigation: IMU, DVL, depth and satellite fixes.

Positions are in L of a scene with the usual offset: north, east, down. The navigation filter begins
at an unknown place, which is the mean of all fixes less the way since its start.
"""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import length
from ...bus import Node
from ...messages import NavSatFix, TwistStamped
from ..grasp.station import StationController, TrackingState
from ..navigation.navigator import Navigator
from ..parametric import velocity_command

PERIOD = 0.1
"""The time between two commands [s]."""
MIN_FIXES = 3
"""The number of fixes from which on the vehicle knows its position."""
KP = 0.4
"""The gain from a position error to a velocity [1/s]."""


class GuidedVehicle:
    """A vehicle with the topics ``/NAME/imu``, ``dvl``, ``depth``, ``gps`` and ``twist``.

    Args:
        node: the node of the algorithm.
        name: the name of the vehicle.
        speed: the largest speed through the water, apart from the compensation of the current
            [m/s].
    """

    def __init__(self, node: Node, name: str, *, speed: float) -> None:
        topics = {f"{sensor}_topic": f"/{name}/{sensor}" for sensor in ("imu", "dvl", "depth")}
        self.name = name
        """The name of the vehicle."""
        self._node, self._navigator = node, Navigator(node, topics)
        self._law = StationController(kp=KP, ki=0.0, feeds_forward=True, limit=speed)
        self._start_sum, self._n_fixes = np.zeros(2), 0  # of the estimates of the start [m]
        self._goal: Array | None = None  # (3,) [m]
        self._heading: float | None = None  # the heading that is kept [rad]
        self._publish = node.publisher(f"/{name}/twist", TwistStamped)
        node.subscribe(f"/{name}/gps", NavSatFix, self._on_fix)
        node.create_timer(PERIOD, self._command)

    @property
    def is_ready(self) -> bool:
        """True if the vehicle knows its position."""
        return self._n_fixes >= MIN_FIXES

    @property
    def position(self) -> Array:
        """The estimated position, north, east, down, (3,) [m]."""
        position = self._navigator.pose.position
        position[:2] += self._start_sum / self._n_fixes
        return position

    @property
    def velocity(self) -> Array:
        """The estimated velocity over ground, north, east, down, (3,) [m/s]."""
        return self._navigator.velocity

    def go_to(self, goal: Array) -> None:
        """Set the place to go to, north, east, down, (3,) [m]."""
        self._goal = goal

    def _on_fix(self, fix: NavSatFix) -> None:
        """Add a fix, which has x and y of L in a scene without ``<nedOrigin>``."""
        if fix.status.status < 0 or not self._navigator.is_ready:
            return
        place = np.array([fix.latitude, fix.longitude])
        self._start_sum = self._start_sum + place - self._navigator.pose.position[:2]
        self._n_fixes += 1

    def _command(self) -> None:
        if not self.is_ready:
            return
        rotation, heading = self._navigator.pose.rotation, self._navigator.heading
        if self._heading is None:
            self._heading = heading
        goal = self.position if self._goal is None else self._goal
        state = TrackingState(
            error=goal - self.position,
            heading_error=math.atan2(*_sine_and_cosine(self._heading - heading)),
            velocity=self.velocity,
            rotation=rotation,
            goal_velocity=np.zeros(3),
        )
        velocity, turn_rate = self._law.step(state, PERIOD)
        self._publish(velocity_command(velocity, turn_rate, time=self._node.now))


def place_beside(place: Array, origin: Array, distance: float) -> Array:
    """Return the place at a horizontal distance from another, on the side of an origin.

    Args:
        place: the other place, (3,) [m].
        origin: the place from which one comes, (3,) [m]; its depth is kept.
        distance: the horizontal distance [m].
    """
    direction = origin - place
    direction[2] = 0.0
    norm = length(direction)
    neighbour_place: Array = place + direction * (distance / norm if norm > distance else 1.0)
    neighbour_place[2] = origin[2]
    return neighbour_place


def _sine_and_cosine(angle: float) -> tuple[float, float]:
    return float(np.sin(angle)), float(np.cos(angle))

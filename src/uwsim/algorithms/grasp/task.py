"""The state that the phases of a grasp share: vehicle, target, time and parameters.

Positions are in the navigation frame (north, east, down). The *grip* is the point between the
fingers of the jaw at which they close (`arm`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from ...base.geometry import Array
from .arm import DOWN_POSTURE
from .perception import GraspModel, ObjectPerception, grasp_point_of
from .station import horizontal_length
from .target import TargetEstimate
from .vehicle_interface import VehicleInterface

APPROACH_HEIGHT = 0.30
"""The height over the handle from which the grip descends [m]."""


class Task:
    """The state that the phases of a grasp share.

    Args:
        vehicle: the interface to the vehicle.
        perception: the part that estimates the pose of the object from images.
        model: the model of the object.
        parameters: the parameters of the algorithm, `Grasp.PARAMETERS`.
        publish_status: the function that publishes a text on ``algorithmStatus``.
    """

    def __init__(
        self,
        vehicle: VehicleInterface,
        perception: ObjectPerception,
        model: GraspModel,
        parameters: Mapping[str, float | str],
        publish_status: Callable[[str], None],
    ) -> None:
        self.vehicle, self.perception, self.model = vehicle, perception, model
        self._grasp_point = grasp_point_of(model)
        self.publish_status = publish_status
        """The function that publishes a text on ``algorithmStatus``."""
        self.target = TargetEstimate()
        """The estimate of the object's pose."""
        self.now = 0.0
        """The simulation time [s]."""
        self.phase_start = 0.0
        """The start time of the present phase [s]."""
        self.failure = ""
        """The reason for the last failure."""
        self.failures = 0
        """The number of failed attempts."""
        self.pattern: list[tuple[float, float]] = []
        """The remaining corners of the search pattern: north and east [m]."""
        self.search_depth = 0.0
        """The depth of the base during the search [m]."""
        numbers = {name: float(value) for name, value in parameters.items() if _is_number(value)}
        self.attempts = int(numbers["attempts"])
        """The greatest number of attempts."""
        self.lift, self.settle, self.hold = numbers["lift"], numbers["settle"], numbers["hold"]
        """The height of the lift [m], the duration of the pause during the lift [s], and the
        duration of the hold [s]."""
        self.descent = numbers["descent"]
        """The speed at which the grip descends [m/s]."""
        self._tolerance, self._min_load = numbers["tolerance"], numbers["min_load"]

    @property
    def phase_time(self) -> float:
        """The duration of the present phase [s]."""
        return self.now - self.phase_start

    @property
    def tolerance(self) -> float:
        """The largest accepted horizontal error of the grip [m]; it increases with the current."""
        return self._tolerance + 0.04 * horizontal_length(self.vehicle.law.current)

    @property
    def grasp_point(self) -> Array:
        """The point of the target that the jaw grasps, navigation frame, (3,) [m]."""
        assert self.target.pose is not None
        return self._grasp_point(self.target.pose)

    @property
    def closing_heading(self) -> float:
        """The heading of the axis along which the jaw closes, modulo half a turn [rad]."""
        assert self.target.pose is not None
        return self.model.closing_heading(self.target.pose)

    @property
    def has_load(self) -> bool:
        """True if the wrist carries a weight, or has no force sensor."""
        load = self.vehicle.wrist.load
        return load is None or load > self._min_load

    def is_target_lost(self, max_age: float) -> bool:
        """Return whether the last sighting is older than ``max_age`` [s]; then set `failure`."""
        is_lost = self.target.pose is None or self.now - self.target.last_sighting_time > max_age
        if is_lost:
            self.failure = f"lost target: it was not seen for {max_age:g} s"
        return is_lost

    def set_goal(self, position: Array, velocity: Array | None = None) -> None:
        """Set the goal of the base, navigation frame, (3,) [m], and its velocity, (3,) [m/s]."""
        self.vehicle.goal = position
        self.vehicle.goal_velocity = np.zeros(3) if velocity is None else velocity

    def keep_station(self, height: float, *, is_settled: bool = False) -> Array:
        """Set the goal of the base so that the grip is over the handle.

        Args:
            height: the height of the grip over the handle [m].
            is_settled: True to compute the goal for the present joint positions of the arm; False
                for those of the lowered arm.

        Returns:
            The goal minus the position of the base, navigation axes, (3,) [m].
        """
        vehicle = self.vehicle
        goal = self.grasp_point - np.array([0.0, 0.0, height])
        posture = vehicle.joints if is_settled else DOWN_POSTURE
        base = vehicle.base_position_for(goal, posture)
        self.set_goal(base)
        error: Array = base - vehicle.pose.position
        return error

    def hover(self, height: float) -> Array:
        """Set the goals of base and arm so that the grip is over the handle.

        Args:
            height: the height of the grip over the handle [m].

        Returns:
            The goal minus the position of the grip, navigation axes, (3,) [m].
        """
        self.keep_station(height)
        vehicle = self.vehicle
        vehicle.closing_heading = self.closing_heading
        vehicle.grip_goal = self.grasp_point - np.array([0.0, 0.0, height])
        error: Array = vehicle.grip_goal - vehicle.grip
        return error


def square_spiral(
    start: Array, heading: float, spacing: float, radius: float
) -> list[tuple[float, float]]:
    """Return the corners of a square spiral: north and east of each [m].

    Args:
        start: the position at which the spiral starts; it begins with north and east [m].
        heading: the heading of the first leg [rad].
        spacing: the distance between parallel legs [m].
        radius: the largest distance of a corner from the start, along or across the heading [m].
    """
    corners: list[tuple[float, float]] = []
    x, y, n = 0.0, 0.0, 0
    c, s = math.cos(heading), math.sin(heading)
    while True:
        length = spacing * (n // 2 + 1)
        direction = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[n % 4]
        x, y, n = x + length * direction[0], y + length * direction[1], n + 1
        if max(abs(x), abs(y)) > radius + 1e-9:
            return corners
        corners.append((float(start[0]) + c * x - s * y, float(start[1]) + s * x + c * y))


def _is_number(value: float | str) -> bool:
    return not isinstance(value, str)

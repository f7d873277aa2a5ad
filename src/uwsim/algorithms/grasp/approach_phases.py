"""The phases before the lowered arm is over the box: search, detect, station, pregrasp."""

from __future__ import annotations

import numpy as np

from .arm import DOWN_POSTURE, JAW_OPEN
from .phase import Phase
from .station import horizontal_length
from .task import APPROACH_HEIGHT, Task


class SearchPhase(Phase):
    """The vehicle follows a square spiral at the search depth until there are three sightings."""

    name = "search"
    limit = 180.0
    timeout_phase = "aborted"

    def enter(self, task: Task) -> None:
        """Reset the target; a second search continues the search pattern of the first."""
        task.failure = "not found: the search pattern is flown"
        task.target.reset()
        task.perception.reset()

    def step(self, task: Task) -> str | None:
        """Move towards the next corner of the search pattern."""
        vehicle = task.vehicle
        if task.target.n_sightings >= 3:
            return "detect"
        if task.target.n_sightings and task.now - task.target.last_sighting_time < 1.0:
            return None  # keep the goal and wait for another sighting
        if not task.pattern:
            return "aborted"
        vehicle.goal = np.array([*task.pattern[0], task.search_depth])
        if horizontal_length(vehicle.goal - vehicle.pose.position) < 0.15:
            task.pattern.pop(0)
        return None


class DetectPhase(Phase):
    """The vehicle keeps its position and waits for more sightings."""

    name = "detect"
    limit = 10.0
    timeout_phase = "search"

    def enter(self, task: Task) -> None:
        """Set the goal of the base to its present position."""
        task.set_goal(task.vehicle.pose.position.copy())

    def step(self, task: Task) -> str | None:
        """Wait for six sightings."""
        if task.is_target_lost(3.0):
            return "search"
        return "station" if task.target.n_sightings >= 6 else None


class StationPhase(Phase):
    """The vehicle moves over the box and stays there until the position of the box is known."""

    name = "station"
    limit = 45.0
    timeout_phase = "search"

    def enter(self, task: Task) -> None:
        """Publish the status ``tracking``."""
        task.publish_status("tracking")

    def step(self, task: Task) -> str | None:
        """Move to the position at which the grip of the lowered arm is over the handle."""
        if task.is_target_lost(6.0):
            return "search"
        error = task.keep_station(APPROACH_HEIGHT + 0.1)
        is_located = task.target.n_sightings >= 8 and task.target.deviation < 0.02
        return "pregrasp" if is_located and horizontal_length(error) < 0.3 else None


class PregraspPhase(Phase):
    """The arm is lowered, with the jaw open, above the handle and across it."""

    name = "pregrasp"
    limit = 30.0

    def step(self, task: Task) -> str | None:
        """Command the joints of the arm and wait until it has reached them."""
        task.keep_station(APPROACH_HEIGHT + 0.1)
        vehicle = task.vehicle
        vehicle.jaw.setpoint = JAW_OPEN
        wrist = vehicle.wrist_angle_for(task.closing_heading)
        vehicle.posture = np.array([*DOWN_POSTURE[:3].tolist(), wrist])
        return "align" if vehicle.is_arm_settled and task.phase_time > 1.0 else None

"""The phases of turning a valve, after those of `uwsim.algorithms.grasp.phases` up to *descend*.

==========  ===================================================  =======================
phase       action                                               next
==========  ===================================================  =======================
close       close the jaw, check that it holds the handle        turn, or retry
turn        turn the wrist, keep the position                    release, or retry
release     open the jaw, rise                                   done
retry       open the jaw, rise, wait for sightings               station, or aborted
==========  ===================================================  =======================

Without feedback, *close* and *turn* last for fixed times, and do not fail.
"""

from __future__ import annotations

import math
from typing import ClassVar

import numpy as np

from ...base.geometry import Array
from ..grasp.arm import JAW_OPEN
from ..grasp.grasp_phases import ClosePhase
from ..grasp.phases import PHASES, Phase
from ..grasp.task import Task

TURN = math.radians(90.0)
"""The angle by which the valve is turned, anticlockwise seen from above [rad]."""
SPEED = 0.25
"""The speed at which the goal of the wrist turns [rad/s]."""
OVERTRAVEL = 0.35
"""The greatest angle by which the goal of the wrist leads the angle of `TURN` [rad]: the wrist
yields to the friction of the valve, and the handle has play in the jaw."""
TOLERANCE = 0.03
"""The angle before `TURN` at which the turn ends [rad]."""
CLOSE_TIME, REST_TIME = 3.0, 2.0
"""Without feedback: the time for which the jaw closes, and the time between the last command to the
wrist and the release [s]."""


class CloseOnHandlePhase(ClosePhase):
    """The jaw closes on the handle."""

    next_phase: ClassVar[str] = "turn"


class TurnPhase(Phase):
    """The wrist turns until jaw and vehicle have turned by `TURN` together."""

    name = "turn"
    limit = 25.0
    uses_images = False

    def enter(self, task: Task) -> None:
        """Store the position of the vehicle, and the angles of wrist and vehicle."""
        vehicle = task.vehicle
        self._position: Array = vehicle.pose.position.copy()
        self._posture: Array = vehicle.joints.copy()
        self._start_heading = self._heading(task)

    def step(self, task: Task) -> str | None:
        """Turn the goal of the wrist, and check that the jaw holds the handle."""
        self.turn_wrist(task)
        if not task.vehicle.jaw.holds_object:
            task.failure = "slipped: the jaw closed while the handle was turned"
            return "retry"
        turn_angle = self._start_heading - self._heading(task)
        turn_angle -= 2.0 * math.pi * math.floor(turn_angle / (2.0 * math.pi) + 0.25)
        return "release" if turn_angle > TURN - TOLERANCE else None

    def turn_wrist(self, task: Task) -> None:
        """Keep the position, and turn the goal of the wrist at `SPEED`, beyond `TURN`."""
        task.set_goal(self._position)
        lead = min(SPEED * task.phase_time, TURN + OVERTRAVEL)
        task.vehicle.posture = self._posture - np.array([0.0, 0.0, 0.0, lead])

    @staticmethod
    def _heading(task: Task) -> float:
        """Return the heading of the closing axis of the jaw [rad]."""
        return task.vehicle.heading + float(task.vehicle.joints[3])


class CloseForTimePhase(CloseOnHandlePhase):
    """The jaw closes for a fixed time, whatever is in it."""

    def step(self, task: Task) -> str | None:
        """Wait for `CLOSE_TIME`."""
        task.keep_station(0.0, is_settled=True)
        return self.next_phase if task.phase_time > CLOSE_TIME else None


class TurnForTimePhase(TurnPhase):
    """The wrist turns for a fixed time, whatever turns with it."""

    def step(self, task: Task) -> str | None:
        """Turn the goal of the wrist, and wait for `REST_TIME` at its end."""
        self.turn_wrist(task)
        end = (TURN + OVERTRAVEL) / SPEED + REST_TIME
        return "release" if task.phase_time > end else None


class ReleasePhase(Phase):
    """The jaw opens, and the vehicle rises from the panel."""

    name = "release"
    limit = 12.0
    timeout_phase = "done"
    uses_images = False

    def enter(self, task: Task) -> None:
        """Open the jaw, and keep the arm as it is."""
        vehicle = task.vehicle
        vehicle.jaw.setpoint, vehicle.posture = JAW_OPEN, vehicle.joints.copy()
        self._start: Array = vehicle.pose.position.copy()

    def step(self, task: Task) -> str | None:
        """Wait for the jaw, then rise by 0.4 m."""
        height = min(max(0.1 * (task.phase_time - 2.0), 0.0), 0.4)
        task.set_goal(self._start - np.array([0.0, 0.0, height]))
        return "done" if height >= 0.4 else None


VALVE_PHASES: dict[str, type[Phase]] = {
    **PHASES,
    "close": CloseOnHandlePhase,
    "turn": TurnPhase,
    "release": ReleasePhase,
}
"""The phases by name, with feedback of the jaw's torque and of the angle."""
RIGID_PHASES: dict[str, type[Phase]] = {
    **VALVE_PHASES,
    "close": CloseForTimePhase,
    "turn": TurnForTimePhase,
}
"""The phases by name, without that feedback."""

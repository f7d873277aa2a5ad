"""The phases of plugging, after those of `uwsim.algorithms.grasp.phases` up to *align*.

==========  ===================================================  =======================
phase       action                                               next
==========  ===================================================  =======================
insert      lower the plug; yield to the force on the wrist      done, or retry
retry       rise, wait for sightings                             station, or aborted
==========  ===================================================  =======================

The jaw holds the plug in all phases.
"""

from __future__ import annotations

import math
from typing import ClassVar

import numpy as np

from ...base.geometry import Array
from ..grasp.approach_phases import PregraspPhase
from ..grasp.grasp_phases import AlignPhase
from ..grasp.lift_phases import RetryPhase
from ..grasp.phases import PHASES, Phase
from ..grasp.station import horizontal_length
from ..grasp.task import APPROACH_HEIGHT, Task

JAW_AROUND_PLUG = 0.15
"""The position of the joint of the fingers around the plug [rad]."""
CONTACT_HEIGHT = 0.12
"""The height of the grip over its goal at which the tip may touch the socket [m]."""
SEARCH_RATE, SEARCH_STEP, SEARCH_LIMIT = 1.2, 0.0015, 0.02
"""The spiral of the search after contacts: its angular rate [rad/s], the growth of its radius in a
second in contact [m/s], and its greatest radius [m]."""
INSERTION_SPEED = 0.015
"""The speed of the plug below `CONTACT_HEIGHT` [m/s]."""
BACK_OFF_SPEED = 0.03
"""The speed at which the plug is raised while the force is too great [m/s]."""


class CarryPhase(PregraspPhase):
    """The arm is lowered above the socket; the jaw stays closed around the plug."""

    def step(self, task: Task) -> str | None:
        """Command the joints of the arm and wait until it has reached them."""
        next_phase = super().step(task)
        task.vehicle.jaw.setpoint = JAW_AROUND_PLUG
        return next_phase


class AlignPlugPhase(AlignPhase):
    """The vehicle brings the plug over the socket."""

    def step(self, task: Task) -> str | None:
        """Wait until the plug is over the socket for 1 s."""
        return "insert" if super().step(task) == "descend" else None


class InsertPhase(Phase):
    """The plug is lowered; above a force on the wrist it is raised and moved along a spiral.

    Without a greatest force, it is lowered whatever the wrist measures.
    """

    name = "insert"
    limit = 60.0
    max_force: ClassVar[float] = 30.0
    """The force on the wrist, beyond that of the arm alone, above which the plug yields [N]."""

    def enter(self, task: Task) -> None:
        """Start at the approach height, and take the wrist's force as that without contact."""
        task.vehicle.wrist.tare()
        self._height, self._last_time = APPROACH_HEIGHT, task.now
        self._contact_time = 0.0
        self._done_since: float | None = None

    def step(self, task: Task) -> str | None:
        """Lower the plug while it is over the socket."""
        dt, self._last_time = task.now - self._last_time, task.now
        self.uses_images = self._height > CONTACT_HEIGHT + 0.08
        spiral = self._spiral()
        error = task.hover(self._height)
        vehicle = task.vehicle
        assert vehicle.goal is not None
        assert vehicle.grip_goal is not None
        vehicle.goal, vehicle.grip_goal = vehicle.goal + spiral, vehicle.grip_goal + spiral
        load = vehicle.wrist.load or 0.0
        if load > self.max_force:
            self._contact_time += dt
            self._height = min(self._height + BACK_OFF_SPEED * dt, APPROACH_HEIGHT)
        elif self._height > CONTACT_HEIGHT:
            if horizontal_length(error + spiral) < 1.5 * task.tolerance:
                self._height = max(self._height - task.descent * dt, CONTACT_HEIGHT)
        elif self._height > CONTACT_HEIGHT - 0.01:
            if horizontal_length(error + spiral) < task.tolerance:
                self._height -= INSERTION_SPEED * dt
        else:
            self._height = max(self._height - INSERTION_SPEED * dt, -0.05)
        return "done" if float(error[2]) - self._height < 0.0 and self._height < -0.04 else None

    def _spiral(self) -> Array:
        """Return the offset of the search, navigation axes, (3,) [m]."""
        radius = min(SEARCH_STEP * self._contact_time, SEARCH_LIMIT)
        angle = SEARCH_RATE * self._contact_time
        return radius * np.array([math.cos(angle), math.sin(angle), 0.0])


class InsertRigidPhase(InsertPhase):
    """The plug is lowered whatever the wrist measures."""

    max_force: ClassVar[float] = math.inf


class RaisePhase(RetryPhase):
    """The vehicle rises with the plug and tries again."""

    def enter(self, task: Task) -> None:
        """Count the failure; keep the jaw closed."""
        super().enter(task)
        task.vehicle.jaw.setpoint = JAW_AROUND_PLUG


PLUG_PHASES: dict[str, type[Phase]] = {
    **PHASES,
    "pregrasp": CarryPhase,
    "align": AlignPlugPhase,
    "insert": InsertPhase,
    "retry": RaisePhase,
}
"""The phases by name, with force feedback."""
RIGID_PHASES: dict[str, type[Phase]] = {**PLUG_PHASES, "insert": InsertRigidPhase}
"""The phases by name, without force feedback."""

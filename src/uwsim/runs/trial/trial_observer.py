"""The protocol of an observer of trials (a viewer), which may supply a pilot's inputs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol

from ...benchmark.updaters import Level
from ...simulation import Simulation
from .level_row import LevelRow
from .triggered_measure import TriggeredMeasure


class TrialObserver(Protocol):
    """An observer of a trial between its steps, which changes only the pilot's inputs."""

    def open(
        self,
        simulation: Simulation,
        title: str,
        parameters: Mapping[str, float | str] | None = None,
    ) -> None:
        """Begin a trial, whose simulation is at step 0.

        Args:
            simulation: the simulation of the trial.
            title: the title of the trial.
            parameters: the parameters of the pilot; None without a pilot.
        """

    def begin_level(self, level: Level, measures: Sequence[TriggeredMeasure]) -> None:
        """Begin the measurement of a level."""

    def end_level(self, row: LevelRow) -> None:
        """End a level."""

    def pilot(self) -> Sequence[float] | None:
        """Return the pilot's inputs (`uwsim.algorithms.pilot.AXES`); None without a pilot."""

    def close(self) -> None:
        """End the trial, before its simulation is closed."""

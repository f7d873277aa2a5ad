"""Somebody who looks on while a trial runs, and may hand in what a pilot does."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol

from ...benchmark.updaters import Level
from ...simulation import Simulation
from .level_row import LevelRow
from .triggered_measure import TriggeredMeasure


class Onlooker(Protocol):
    """What looks at a trial between its steps; it changes nothing but by the pilot's inputs."""

    def open(
        self,
        simulation: Simulation,
        title: str,
        parameters: Mapping[str, float | str] | None = None,
    ) -> None:
        """A trial begins; its simulation is at step 0.

        Args:
            simulation: the one.
            title: of the trial.
            parameters: of the pilot; None: nobody pilots.
        """

    def begin_level(self, level: Level, measures: Sequence[TriggeredMeasure]) -> None:
        """A level is measured from now on."""

    def end_level(self, row: LevelRow) -> None:
        """A level is over."""

    def pilot(self) -> Sequence[float] | None:
        """Return what a pilot does now (`uwsim.algorithms.pilot.AXES`); None: nobody pilots."""

    def close(self) -> None:
        """The trial is over; its simulation is about to be closed."""

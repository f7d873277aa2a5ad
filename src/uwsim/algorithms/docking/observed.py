"""``docking`` and ``docking-girona``: guidance into a dock by the true pose.

They read ``positionError`` and ``heading`` of an observation and command a twist by the law of
`guidance`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from ...base.geometry import Array
from ...base.numerics import elementwise
from ..control.observation_controller import ObservationController
from .guidance import GAINS, GIRONA_GAINS, DockingGains, DockingGuidance


class Docking(ObservationController):
    """A guidance into a dock: turns to its axis, comes onto it, and moves along it."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "axis": 0.0,
        **GAINS,
        **ObservationController.PARAMETERS,
    }
    """The heading of the dock's ``axis`` [rad], the gains (`DockingGains`), and the topic of the
    commands."""
    CHANNELS: ClassVar[tuple[str, ...]] = ("positionError", "heading")
    """The parts of the observation that are needed."""
    KIND: ClassVar[str] = "guidance"
    """The kind of the algorithm in messages."""

    def _read_parameters(self, parameters: Mapping[str, float | str]) -> None:
        super()._read_parameters(parameters)
        numbers = {name: self._number(name) for name in GAINS}
        self._guidance = DockingGuidance(DockingGains(**numbers))

    def command(self, parts: Mapping[str, Array], dt: float) -> tuple[Array, float]:
        """Return the commanded velocity and the turn rate; see `ObservationController`."""
        bow_x, bow_y = parts["heading"].tolist()
        turn = self._number("axis") - float(elementwise.arctan2(bow_y, bow_x))
        return self._guidance.command(parts["positionError"], turn, dt)


class DockingGirona(Docking):
    """The guidance of ``docking`` for a Girona 500 in the dock of ``docking-girona``."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **Docking.PARAMETERS,
        **GIRONA_GAINS,
        "twist_topic": "/girona500/twist",
    }
    """The parameters of `Docking`, with the numbers of the larger vehicle."""

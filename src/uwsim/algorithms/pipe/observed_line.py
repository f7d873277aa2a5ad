"""``pipe-following`` and ``pipe-straight``: along the true line of an observation, and straight on.

``pipe-following`` reads ``pathError``, ``pathDirection`` and ``pathAhead`` of an environment's
observation and moves by the law of `guidance`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ...base.geometry import Array
from ..control.observation_controller import ObservationController
from .guidance import GuidanceGains, LineGuidance

GAINS: Mapping[str, float | str] = {
    "speed": 0.3,
    "look_ahead": 0.6,
    "ki": 0.05,
    "kz": 0.6,
    "turn_gain": 0.8,
    "limit": 0.5,
}
"""The gains with their defaults: `GuidanceGains`."""


class PipeFollowing(ObservationController):
    """A line-of-sight guidance along the true line of a pipe."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {**GAINS, **ObservationController.PARAMETERS}
    """The gains (`GuidanceGains`), and the topic of the commands."""
    CHANNELS: ClassVar[tuple[str, ...]] = ("pathError", "pathDirection", "pathAhead")
    """The parts of the observation that are needed."""
    KIND: ClassVar[str] = "guidance"
    """The kind of the algorithm in messages."""

    def _read_parameters(self, parameters: Mapping[str, float | str]) -> None:
        super()._read_parameters(parameters)
        self._guidance = LineGuidance(GuidanceGains(**{name: self._number(name) for name in GAINS}))

    def command(self, parts: Mapping[str, Array], dt: float) -> tuple[Array, float]:
        """Return the commanded velocity and the turn rate; see `ObservationController`."""
        target = parts["pathAhead"][3:6]  # 1 m ahead
        return self._guidance.command(parts["pathError"], parts["pathDirection"], target, dt)


class PipeStraight(ObservationController):
    """A control condition: it moves straight on, without looking."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "speed": GAINS["speed"],
        **ObservationController.PARAMETERS,
    }
    """The ``speed`` [m/s], and the topic of the commands."""
    CHANNELS: ClassVar[tuple[str, ...]] = ()
    """No part of the observation is needed."""

    def command(self, parts: Mapping[str, Array], dt: float) -> tuple[Array, float]:
        """Return the speed ahead and no turn rate; see `ObservationController`."""
        return np.array([self._number("speed"), 0.0, 0.0]), 0.0

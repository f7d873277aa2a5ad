"""``frozen``: the control. It looks at nothing."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from ..geometry import Array
from .direct_tracker import crossing
from .esm.pyramid import Grey
from .tracker import Estimate, Tracker
from .tracker_node import INPUT, TrackerNode


class Frozen(TrackerNode):
    """Echoes what autoInit gave it last, at every image: the control, never lost."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {**INPUT}

    def follow(self, image: Grey, quad: Array) -> Tracker:
        """Remember the quad alone."""
        return Echo(quad)

    def loss_test(self) -> None:
        """Nothing: it never looks, so it never knows."""


class Echo(Tracker):
    """Gives the quad it was told last."""

    def __init__(self, quad: Array) -> None:
        self.place(quad)

    def place(self, quad: Array) -> None:
        """Give ``quad`` from now on."""
        self._estimate = Estimate(corners=quad, centroid=crossing(quad), zncc=1.0)

    def step(self, image: Grey) -> Estimate:
        """Give the quad again."""
        return self._estimate

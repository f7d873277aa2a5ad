"""``frozen``: the control, which ignores all images."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from ..base.geometry import Array
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
        """None: it is never lost."""


class Echo(Tracker):
    """A tracker that returns the last quad given to it."""

    def __init__(self, quad: Array) -> None:
        self.place(quad)

    def place(self, quad: Array) -> None:
        """Return ``quad`` from now on."""
        self._estimate = Estimate(corners=quad, centroid=crossing(quad), zncc=1.0)

    def step(self, image: Grey) -> Estimate:
        """Return the quad."""
        return self._estimate

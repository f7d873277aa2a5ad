"""``frozen``: the control, which evaluates no image."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from ..base.geometry import Array
from .direct_tracker import diagonal_intersection
from .esm.pyramid import Grey
from .tracker import Estimate, Tracker
from .tracker_node import INPUT_PARAMETERS, TrackerNode


class FrozenTracker(TrackerNode):
    """The control: repeats the last quad of autoInit at every image and is never lost."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {**INPUT_PARAMETERS}

    def make_tracker(self, image: Grey, quad: Array) -> Tracker:
        """Make a tracker that repeats the quad."""
        return Echo(quad)

    def loss_test(self) -> None:
        """Return None, as the control is never lost."""


class Echo(Tracker):
    """A tracker that returns the quad that was set last."""

    def __init__(self, quad: Array) -> None:
        self.set_quad(quad)

    def set_quad(self, quad: Array) -> None:
        """Set the quad that `step` returns."""
        self._estimate = Estimate(corners=quad, centroid=diagonal_intersection(quad), zncc=1.0)

    def step(self, image: Grey) -> Estimate:
        """Return the quad."""
        return self._estimate

"""``frozen``: a control condition for benchmarks, which publishes estimates but reads no image."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from ..base.geometry import Array
from .direct_tracker import diagonal_intersection
from .esm.pyramid import Grey
from .tracker import Estimate, Tracker
from .tracker_node import INPUT_PARAMETERS, TrackerNode


class FrozenTracker(TrackerNode):
    """A control condition for benchmarks (null tracker).

    It repeats the quad that the service ``autoInit`` set last, and never reports the loss of the
    target.
    """

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {**INPUT_PARAMETERS}

    def make_tracker(self, image: Grey, quad: Array) -> Tracker:
        """Make a tracker that repeats ``quad`` (4, 2) [px]."""
        return ConstantTracker(quad)

    def loss_test(self) -> None:
        """Return None, as this algorithm never reports the loss of the target."""


class ConstantTracker(Tracker):
    """A tracker that returns the quad (4, 2) [px] that was set last."""

    def __init__(self, quad: Array) -> None:
        self.set_quad(quad)

    def set_quad(self, quad: Array) -> None:
        """Set the quad that `step` returns."""
        self._estimate = Estimate(corners=quad, centroid=diagonal_intersection(quad), zncc=1.0)

    def step(self, image: Grey) -> Estimate:
        """Return the quad, whatever the image shows."""
        return self._estimate

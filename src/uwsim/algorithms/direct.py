"""The trackers that compare grey levels directly: ``esm``, ``ssd-esm`` and ``ic``."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from ..base.geometry import Array
from .direct_tracker import DirectTracker
from .esm.alignment import Method
from .esm.pyramid import Grey
from .tracker import Tracker
from .tracker_node import INPUT, LOSS, TrackerNode


class Esm(TrackerNode):
    """ESM on SL(3), patches of zero mean and unit variance, 3 pyramid levels."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **INPUT,
        "levels": 3.0,
        "max_iterations": 20.0,
        "precision": 1e-4,
        **LOSS,
    }
    BLEND: ClassVar[str] = "esm"
    PHOTOMETRIC: ClassVar[bool] = True

    def follow(self, image: Grey, quad: Array) -> Tracker | str:
        """Remember the patch on every level."""
        method = Method(
            blend=self.BLEND,
            photometric=self.PHOTOMETRIC,
            max_iterations=int(self.number("max_iterations")),
            precision=self.number("precision"),
        )
        levels = max(int(self.number("levels")), 1)
        return DirectTracker.remember(image, quad, levels=levels, method=method)


class SsdEsm(Esm):
    """ESM on SL(3) on plain grey levels: what fog does to ESM without normalisation."""

    PHOTOMETRIC: ClassVar[bool] = False


class InverseCompositional(Esm):
    """Inverse compositional (Baker and Matthews 2004), normalised like esm."""

    BLEND: ClassVar[str] = "ic"

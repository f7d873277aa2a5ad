"""The direct trackers ``esm``, ``ssd-esm`` and ``ic``, which compare grey levels, not features."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from ..base.geometry import Array
from .direct_tracker import DirectTracker
from .esm.alignment import Method
from .esm.pyramid import Grey
from .tracker import Tracker
from .tracker_node import INPUT_PARAMETERS, LOSS_PARAMETERS, TrackerNode


class Esm(TrackerNode):
    """ESM on SL(3), patches of zero mean and unit variance, 3 pyramid levels."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **INPUT_PARAMETERS,
        "levels": 3.0,
        "max_iterations": 20.0,
        "precision": 1e-4,
        **LOSS_PARAMETERS,
    }
    BLEND: ClassVar[str] = "esm"
    """The combination of the gradients of image and template (`Method.blend`)."""
    PHOTOMETRIC: ClassVar[bool] = True
    """The value of `Method.photometric`: True to normalise patches to zero mean, unit variance."""

    def make_tracker(self, image: Grey, quad: Array) -> Tracker | str:
        """Make a tracker with the pixels inside ``quad`` (4, 2) [px] as the template."""
        method = Method(
            blend=self.BLEND,
            photometric=self.PHOTOMETRIC,
            max_iterations=int(self.number("max_iterations")),
            precision=self.number("precision"),
        )
        levels = max(int(self.number("levels")), 1)
        return DirectTracker.from_image(image, quad, levels=levels, method=method)


class SsdEsm(Esm):
    """ESM on SL(3) with grey levels that are not normalised, which shows the effect of fog."""

    PHOTOMETRIC: ClassVar[bool] = False


class InverseCompositional(Esm):
    """The inverse compositional method (Baker and Matthews 2004), with normalised patches."""

    BLEND: ClassVar[str] = "ic"

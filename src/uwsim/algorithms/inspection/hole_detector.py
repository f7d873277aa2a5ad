r"""The detection of holes in images of a net: gaps that are larger than its meshes.

Twines are darker than the water behind them. The contrast of a pixel is the mean of a window of one
mesh less its grey level; its mean over a row or a column of half a mesh, whichever is greater,
separates twines from noise. A pixel above ``threshold`` belongs to a twine. The distance of each
other pixel to the next twine is the radius of an empty circle. A connected set of pixels whose
circles exceed ``min_radius`` is a gap, with its place at the greatest circle.

A gap at the border of the image, or with a circle above ``max_radius``, as where there is no
net or none that can be seen, is left out. Not modelled: the slant of the net, bright twines.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...base.geometry import Intrinsics
from ...base.numerics.opencv import deterministic_opencv


@dataclass(frozen=True)
class Gap:
    """A gap between the twines in an image."""

    u: float
    """The column of its greatest circle [px]."""
    v: float
    """The row of its greatest circle [px]."""
    radius: float
    """The radius of this circle on the net [m]."""


@dataclass(frozen=True, kw_only=True)
class HoleDetector:
    """A detector of holes in images of a camera that looks at a net."""

    intrinsics: Intrinsics
    """The intrinsics of the camera."""
    mesh_side: float
    """The side of a mesh [m]."""
    threshold: float
    """The smallest contrast of a twine [grey levels]."""
    min_radius: float
    """The smallest radius of an empty circle in a hole [m]."""
    max_radius: float
    """The greatest radius of an empty circle in a hole [m]."""

    @deterministic_opencv()
    def detect(self, image: npt.NDArray[np.uint8], distance: float) -> list[Gap]:
        """Find the gaps in an image (h, w, 3) of a net at a distance [m]."""
        import cv2

        grey = image.mean(axis=2, dtype=np.float32)
        scale = self.intrinsics.fx / distance  # [px/m]
        window, line = (max(3, round(share * self.mesh_side * scale)) for share in (1.0, 0.5))
        contrast = cv2.blur(grey, (window, window)) - grey
        lines = np.maximum(cv2.blur(contrast, (line, 1)), cv2.blur(contrast, (1, line)))
        is_clear = (lines < self.threshold).astype(np.uint8)
        radii = cv2.distanceTransform(is_clear, cv2.DIST_L2, 5) / scale  # [m]
        mask = (radii > self.min_radius).astype(np.uint8)
        n, labels, stats, _ = cv2.connectedComponentsWithStats(mask)
        height, width = grey.shape
        margin = int(self.min_radius * scale)
        gaps = []
        for label in range(1, n):
            x, y, w, h = stats[label, :4].tolist()
            if min(x, y, width - x - w, height - y - h) < margin:
                continue
            own_radii = np.where(labels == label, radii, 0.0)
            v, u = np.unravel_index(int(np.argmax(own_radii)), own_radii.shape)
            radius = float(own_radii[v, u])
            if radius <= self.max_radius:
                gaps.append(Gap(float(u), float(v), radius))
        return gaps

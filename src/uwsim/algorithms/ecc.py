"""``ecc``: the enhanced correlation coefficient of Evangelidis and Psarakis (2008), by OpenCV."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ..base.geometry import Array
from ..base.numerics.linear import determinant, inverse, product
from ..base.numerics.opencv import deterministic_opencv
from .direct_tracker import crossing
from .esm.alignment import zncc
from .esm.homography import between, unimodular, warp
from .esm.pyramid import Grey
from .esm.template import Template, take_template
from .tracker import Estimate, Tracker
from .tracker_node import INPUT, LOSS, TrackerNode


class Ecc(TrackerNode):
    """Enhanced correlation coefficient with a homography (OpenCV's findTransformECC)."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **INPUT,
        "max_iterations": 50.0,
        "precision": 1e-5,
        "smoothing": 5.0,
        **LOSS,
    }

    def follow(self, image: Grey, quad: Array) -> Tracker | str:
        """Remember the upright box around the quad."""
        template = take_template(image, quad)
        if template is None:
            return "the quad is smaller than 8 px or has no contrast"
        return EccTracker(
            image,
            template,
            quad,
            max_iterations=int(self.number("max_iterations")),
            precision=self.number("precision"),
            smoothing=int(self.number("smoothing")) | 1,
        )


class EccTracker(Tracker):
    """Maximises the correlation from the last estimate; fails on an image when OpenCV does.

    OpenCV compares the upright box around the quad, both images smoothed by a Gaussian of
    ``smoothing`` pixels. We smooth them before the patch is cut out: OpenCV would smooth the patch
    as if it were mirrored at its rim, which moves its corners by a quarter of a pixel. There is no
    pyramid.
    """

    @deterministic_opencv()
    def __init__(
        self,
        image: Grey,
        template: Template,
        quad: Array,
        *,
        max_iterations: int,
        precision: float,
        smoothing: int,
    ) -> None:
        import cv2

        height, width = template.values.shape
        self._smoothing = (smoothing, smoothing)
        smooth = cv2.GaussianBlur(image, self._smoothing, 0.0)
        self._patch = smooth[template.top :, template.left :][:height, :width].copy()
        self._everywhere = np.ones(image.shape, np.uint8)
        self._image_from_patch = np.array(
            [[1.0, 0.0, template.left], [0.0, 1.0, template.top], [0.0, 0.0, 1.0]]
        )
        self._template, self._quad, self._centre = template, quad, crossing(quad)
        self._homography = np.eye(3)
        self._criteria = (
            cv2.TERM_CRITERIA_EPS | cv2.TERM_CRITERIA_COUNT,
            max_iterations,
            precision,
        )

    def place(self, quad: Array) -> None:
        """Begin the next search at ``quad``."""
        self._homography = between(self._quad, quad)

    @deterministic_opencv()
    def step(self, image: Grey) -> Estimate:
        """Find the patch in the next image."""
        import cv2

        guess = product(self._homography, self._image_from_patch)
        found = True
        try:
            _, warped = cv2.findTransformECC(
                self._patch,
                cv2.GaussianBlur(image, self._smoothing, 0.0),
                (guess / guess[2, 2]).astype(np.float32),
                cv2.MOTION_HOMOGRAPHY,
                self._criteria,
                self._everywhere,
                1,
            )
        except cv2.error:
            found = False
        else:
            matrix = product(warped.astype(np.float64), inverse(self._image_from_patch))
            found = bool(np.all(np.isfinite(matrix)) and determinant(matrix) > 1e-9)
            if found:
                self._homography = unimodular(matrix)
        return Estimate(
            corners=warp(self._homography, self._quad),
            centroid=warp(self._homography, self._centre[None])[0],
            zncc=zncc(image, self._template, self._homography),
            found=found,
        )

"""``ecc``: a tracker by the enhanced correlation coefficient (Evangelidis and Psarakis 2008)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ..base.geometry import Array
from ..base.numerics.linear import determinant, inverse, product
from ..base.numerics.opencv import deterministic_opencv
from .direct_tracker import diagonal_intersection
from .esm.alignment import zncc
from .esm.homography import homography_between, normalize_determinant, warp
from .esm.pyramid import Grey
from .esm.template import Template, extract_template
from .tracker import Estimate, Tracker
from .tracker_node import INPUT_PARAMETERS, LOSS_PARAMETERS, TrackerNode


class Ecc(TrackerNode):
    """The enhanced correlation coefficient with a homography (OpenCV's findTransformECC)."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **INPUT_PARAMETERS,
        "max_iterations": 50.0,
        "precision": 1e-5,
        "smoothing": 5.0,
        **LOSS_PARAMETERS,
    }

    def make_tracker(self, image: Grey, quad: Array) -> Tracker | str:
        """Make a tracker of the axis-aligned bounding box of ``quad`` (4, 2) [px]."""
        template = extract_template(image, quad)
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
    """A tracker that maximises the correlation coefficient, starting at its last estimate.

    OpenCV compares the axis-aligned bounding box of the quad in images that are smoothed by a
    Gaussian filter. The whole image is smoothed before the patch is cut out: OpenCV would mirror
    the patch at its border, which moves the corners by a quarter of a pixel. There is no pyramid.
    An image on which OpenCV fails has no estimate.

    Args:
        image: the image of the template, (h, w) [grey level].
        template: the template of the quad.
        quad: the corners of the target in the image of the template, (4, 2) [px].
        max_iterations: the greatest number of iterations in an image.
        precision: the increase of the correlation below which the iterations end.
        smoothing: the width of the Gaussian filter, odd [px].
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
        smoothed_image = cv2.GaussianBlur(image, self._smoothing, 0.0)
        self._patch = smoothed_image[template.top :, template.left :][:height, :width].copy()
        self._image_mask = np.ones(image.shape, np.uint8)
        self._image_from_patch = np.array(
            [[1.0, 0.0, template.left], [0.0, 1.0, template.top], [0.0, 0.0, 1.0]]
        )
        self._template, self._quad, self._centre = template, quad, diagonal_intersection(quad)
        self._homography = np.eye(3)
        self._criteria = (
            cv2.TERM_CRITERIA_EPS | cv2.TERM_CRITERIA_COUNT,
            max_iterations,
            precision,
        )

    def set_quad(self, quad: Array) -> None:
        """Set the estimate at which the next search starts to ``quad`` (4, 2) [px]."""
        self._homography = homography_between(self._quad, quad)

    @deterministic_opencv()
    def step(self, image: Grey) -> Estimate:
        """Find the patch in the next image (h, w) [grey level]."""
        import cv2

        guess = product(self._homography, self._image_from_patch)
        is_found = True
        try:
            _, image_from_patch = cv2.findTransformECC(
                self._patch,
                cv2.GaussianBlur(image, self._smoothing, 0.0),
                (guess / guess[2, 2]).astype(np.float32),
                cv2.MOTION_HOMOGRAPHY,
                self._criteria,
                self._image_mask,
                1,
            )
        except cv2.error:
            is_found = False
        else:
            matrix = product(image_from_patch.astype(np.float64), inverse(self._image_from_patch))
            is_found = bool(np.all(np.isfinite(matrix)) and determinant(matrix) > 1e-9)
            if is_found:
                self._homography = normalize_determinant(matrix)
        return Estimate(
            corners=warp(self._homography, self._quad),
            centroid=warp(self._homography, self._centre[None])[0],
            zncc=zncc(image, self._template, self._homography),
            is_found=is_found,
        )

"""A tracker that aligns a template with each image, from coarse to fine pyramid levels."""

from __future__ import annotations

import numpy as np

from ..base.geometry import Array
from ..base.numerics.linear import product
from .esm.alignment import Method, align, zncc
from .esm.homography import homography_between, normalize_determinant, warp
from .esm.pyramid import Grey, level_from_image, pyramid
from .esm.template import Template, extract_template
from .tracker import Estimate, Tracker


class DirectTracker(Tracker):
    """A tracker by direct alignment of grey levels (`uwsim.algorithms.esm.alignment`).

    The alignment starts at the last estimate. Pyramid levels on which the patch has fewer than 8
    rows or columns are omitted. A step is accepted only if it increases the correlation, so a
    coarse level without a match does no harm. An image is not interpolated at the template's own
    position, but blurred by interpolation at any other position. If the target is at rest and the
    noise is low, every step may therefore be rejected, and the estimate stays the same.

    Args:
        templates: the template at each pyramid level, the finest first.
        quad: the corners of the patch in the image of the template, (4, 2) [px].
        method: the method of alignment.
    """

    def __init__(self, templates: list[Template], quad: Array, method: Method) -> None:
        self._templates = templates
        self._quad = quad
        self._centre = diagonal_intersection(quad)
        self._method = method
        self.homography = np.eye(3)
        """The homography from the image of the template to the last image, (3, 3)."""

    @staticmethod
    def from_image(image: Grey, quad: Array, *, levels: int, method: Method) -> DirectTracker | str:
        """Make a tracker of the patch inside a quad.

        Args:
            image: the image of the template, (h, w) [grey level].
            quad: the corners of the patch, (4, 2) [px].
            levels: the greatest number of pyramid levels.
            method: the method of alignment.

        Returns:
            The tracker, or a text with the reason why the patch cannot be tracked.
        """
        templates: list[Template] = []
        for level, level_image in enumerate(pyramid(image, levels)):
            template = extract_template(level_image, warp(level_from_image(level), quad))
            if template is None:
                break
            templates.append(template)
        if not templates:
            return "the quad is smaller than 8 px or has no contrast"
        return DirectTracker(templates, quad, method)

    def set_quad(self, quad: Array) -> None:
        """Set the estimate at which the next alignment starts to ``quad`` (4, 2) [px]."""
        self.homography = homography_between(self._quad, quad)

    def step(self, image: Grey) -> Estimate:
        """Find the patch in the next image (h, w) [grey level]."""
        images = pyramid(image, len(self._templates))
        homography, iterations = self.homography, 0
        for level in range(min(len(images), len(self._templates)) - 1, -1, -1):
            level_from_full, full_from_level = level_from_image(level), level_from_image(-level)
            guess = product(product(level_from_full, homography), full_from_level)
            alignment = align(images[level], self._templates[level], guess, self._method)
            homography = product(product(full_from_level, alignment.homography), level_from_full)
            iterations += alignment.iterations
        self.homography = normalize_determinant(homography)
        return Estimate(
            corners=warp(self.homography, self._quad),
            centroid=warp(self.homography, self._centre[None])[0],
            zncc=zncc(image, self._templates[0], self.homography),
            iterations=iterations,
        )


def diagonal_intersection(quad: Array) -> Array:
    """Return the intersection (2,) of the diagonals of a convex quad (4, 2)."""
    diagonal, other_diagonal = quad[2] - quad[0], quad[3] - quad[1]
    offset = quad[1] - quad[0]
    fraction = (offset[0] * other_diagonal[1] - offset[1] * other_diagonal[0]) / (
        diagonal[0] * other_diagonal[1] - diagonal[1] * other_diagonal[0]
    )
    point: Array = quad[0] + fraction * diagonal
    return point

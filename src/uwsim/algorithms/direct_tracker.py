"""A tracker that aligns a template coarse to fine, beginning where the patch was last seen."""

from __future__ import annotations

import numpy as np

from ..base.geometry import Array
from ..base.numerics.linear import product
from .esm.alignment import Method, align, zncc
from .esm.homography import between, unimodular, warp
from .esm.pyramid import Grey, level_from_image, pyramid
from .esm.template import Template, take_template
from .tracker import Estimate, Tracker


class DirectTracker(Tracker):
    """Direct alignment of grey levels on a pyramid (`uwsim.algorithms.esm.alignment`).

    Levels on which the patch has fewer than 8 rows or columns are left out. A level's result is
    taken only as far as it raised the correlation, so a coarse level that fits nothing does no
    harm. At the start the template's pixels are those of the image, anywhere else they are
    interpolated and a little blurred: of a target at rest in images with little noise every step
    may be refused, and the result is then exactly the start.
    """

    def __init__(self, templates: list[Template], quad: Array, method: Method) -> None:
        self._templates = templates
        self._quad = quad
        self._centre = crossing(quad)
        self._method = method
        self.homography = np.eye(3)
        """Sends points of the template's image to the last image, (3, 3)."""

    @staticmethod
    def remember(image: Grey, quad: Array, *, levels: int, method: Method) -> DirectTracker | str:
        """Take a template, or return why the patch cannot be tracked."""
        templates: list[Template] = []
        for level, smaller in enumerate(pyramid(image, levels)):
            template = take_template(smaller, warp(level_from_image(level), quad))
            if template is None:
                break
            templates.append(template)
        if not templates:
            return "the quad is smaller than 8 px or has no contrast"
        return DirectTracker(templates, quad, method)

    def place(self, quad: Array) -> None:
        """Begin the next alignment at ``quad``."""
        self.homography = between(self._quad, quad)

    def step(self, image: Grey) -> Estimate:
        """Find the patch in the next image."""
        images = pyramid(image, len(self._templates))
        homography, iterations = self.homography, 0
        for level in range(min(len(images), len(self._templates)) - 1, -1, -1):
            shrink, grow = level_from_image(level), level_from_image(-level)
            guess = product(product(shrink, homography), grow)
            result = align(images[level], self._templates[level], guess, self._method)
            homography = product(product(grow, result.homography), shrink)
            iterations += result.iterations
        self.homography = unimodular(homography)
        return Estimate(
            corners=warp(self.homography, self._quad),
            centroid=warp(self.homography, self._centre[None])[0],
            zncc=zncc(image, self._templates[0], self.homography),
            iterations=iterations,
        )


def crossing(quad: Array) -> Array:
    """Where the diagonals of a convex quad (4, 2) cross, (2,)."""
    along, across = quad[2] - quad[0], quad[3] - quad[1]
    offset = quad[1] - quad[0]
    share = (offset[0] * across[1] - offset[1] * across[0]) / (
        along[0] * across[1] - along[1] * across[0]
    )
    point: Array = quad[0] + share * along
    return point

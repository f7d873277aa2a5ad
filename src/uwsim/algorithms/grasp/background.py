"""The brightness of the seabed without objects: a smooth function of the image coordinates.

The effects of fog and water colour increase with the distance, so the brightness of the seabed
varies over the image. It is modelled by a polynomial of second degree in the image coordinates,
which is fitted twice by least squares, the second time without the outliers of the first fit.

Not modelled: shadows, and ripples of the sand; they count as noise.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.linear import product, solve

Layer = npt.NDArray[np.float32]
"""An image with one number for each pixel, (h, w)."""
STRIDE = 3
"""The stride of the fitted samples along rows and columns [samples]."""
OUTLIER_THRESHOLD = 2.5
"""The residual above which a sample is an outlier [standard deviations]."""
MIN_DEVIATION = 0.5
"""The lower limit of the standard deviation [grey levels]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Background:
    """A polynomial of second degree over an image, called the surface."""

    coefficients: Array
    """The coefficients of 1, x, y, xx, xy, yy with x, y from -1 to 1 over the image, (6,)."""
    deviation: float
    """The standard deviation of the fitted samples from the surface, without outliers
    [grey levels]."""
    shape: tuple[int, int]
    """The shape of the image (h, w)."""

    @classmethod
    def fit(cls, layer: Layer, step: int) -> Background:
        """Fit a surface to an image of which every ``step``-th pixel is given, (h/step, w/step)."""
        shape = step * layer.shape[0], step * layer.shape[1]
        terms = _terms(shape, (0, 0), layer.shape, step)[::STRIDE, ::STRIDE].reshape(-1, 6)
        values = layer[::STRIDE, ::STRIDE].reshape(-1).astype(np.float64)
        median = float(np.median(values))
        is_inlier = np.abs(values - median) <= OUTLIER_THRESHOLD * _deviation(values - median)
        for _ in range(2):
            inliers = terms[is_inlier]
            coefficients = solve(product(inliers.T, inliers), product(inliers.T, values[is_inlier]))
            residuals = values - product(terms, coefficients)
            deviation = _deviation(residuals)
            is_inlier = np.abs(residuals) <= OUTLIER_THRESHOLD * deviation
        return cls(coefficients=coefficients, deviation=deviation, shape=shape)

    def evaluate(
        self, shape: tuple[int, ...], corner: tuple[int, int] = (0, 0), step: int = 1
    ) -> Layer:
        """Evaluate the surface over a part of the image.

        Args:
            shape: the number of rows and columns of samples.
            corner: the row and column of the first pixel of the part.
            step: the distance between samples along rows and columns [px].
        """
        surface: Array = product(_terms(self.shape, corner, shape, step), self.coefficients)
        return surface.astype(np.float32)


def _terms(
    image_shape: tuple[int, int], corner: tuple[int, int], shape: tuple[int, ...], step: int
) -> Array:
    """Return 1, x, y, xx, xy, yy at the samples of a part of an image, (h, w, 6)."""
    y, x = ((corner[k] + step * np.arange(shape[k])) * 2.0 / image_shape[k] - 1.0 for k in range(2))
    y, x = np.meshgrid(y, x, indexing="ij")
    return np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=-1)


def _deviation(residuals: Array) -> float:
    """Estimate the standard deviation of residuals by their median, which resists outliers."""
    return max(1.4826 * float(np.median(np.abs(residuals))), MIN_DEVIATION)

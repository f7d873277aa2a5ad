"""How the bottom looks where nothing lies on it: a smooth surface over the image.

Fog and the water's colour grow with the distance, so that the bottom is not equally bright
everywhere. A polynomial of second degree in the place in the image follows that, fitted by least
squares twice: the second time without what stands out from the first.

Not modelled: shadows and ripples of the sand, which count as noise.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.linear import product, solve

Layer = npt.NDArray[np.float32]
"""One number for each pixel, (h, w)."""
SPARSE = 3
"""Every which sample along rows and columns the fit takes."""
OUTSTANDING = 2.5
"""What is farther from the first fit than this is not in the second [deviations]."""
LEAST_DEVIATION = 0.5
"""The deviation is not taken to be less [grey levels]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Background:
    """A smooth surface over an image."""

    coefficients: Array
    """Of 1, x, y, xx, xy, yy with x, y from -1 to 1 over the image, (6,)."""
    deviation: float
    """Of the samples about it, without what stands out."""
    shape: tuple[int, int]
    """Of the image (h, w)."""

    @classmethod
    def of(cls, layer: Layer, step: int) -> Background:
        """Fit it to every ``step``-th pixel of an image, (h / step, w / step)."""
        shape = step * layer.shape[0], step * layer.shape[1]
        terms = _terms(shape, (0, 0), layer.shape, step)[::SPARSE, ::SPARSE].reshape(-1, 6)
        values = layer[::SPARSE, ::SPARSE].reshape(-1).astype(np.float64)
        middle = float(np.median(values))
        is_in = np.abs(values - middle) <= OUTSTANDING * _deviation(values - middle)
        for _ in range(2):
            chosen = terms[is_in]
            coefficients = solve(product(chosen.T, chosen), product(chosen.T, values[is_in]))
            off = values - product(terms, coefficients)
            deviation = _deviation(off)
            is_in = np.abs(off) <= OUTSTANDING * deviation
        return cls(coefficients=coefficients, deviation=deviation, shape=shape)

    def over(
        self, shape: tuple[int, ...], corner: tuple[int, int] = (0, 0), step: int = 1
    ) -> Layer:
        """Return it over a part of the image.

        Args:
            shape: of the part, (h, w) samples.
            corner: row and column of its first pixel.
            step: of its samples [px].
        """
        found: Layer = product(_terms(self.shape, corner, shape, step), self.coefficients).astype(
            np.float32
        )
        return found


def _terms(
    whole: tuple[int, int], corner: tuple[int, int], shape: tuple[int, ...], step: int
) -> Array:
    """1, x, y, xx, xy, yy over a part of an image, (h, w, 6)."""
    y, x = ((corner[k] + step * np.arange(shape[k])) * 2.0 / whole[k] - 1.0 for k in range(2))
    y, x = np.meshgrid(y, x, indexing="ij")
    return np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=-1)


def _deviation(off: Array) -> float:
    """Standard deviation of normal numbers about 0 with a few others among them."""
    return max(1.4826 * float(np.median(np.abs(off))), LEAST_DEVIATION)

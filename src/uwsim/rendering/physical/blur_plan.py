r"""The plan of the blur for a camera: which Gaussian levels are drawn at which resolution.

The five levels of `blur_weights` have the deviations :math:`\sigma_l f` in pixels, for the focal
length :math:`f`. Levels below 0.24 px count as sharp. One level may be *fine*: below 0.75 px it is
a kernel of 3 x 3 pixels. The others are *coarse*: the first is drawn at half the resolution, the
next at a half or a quarter of that, so that it has a deviation of at least 0.7 texels, and each
further one at a quarter of the one before. A coarse level is the mean of a square of pixels, a
Gaussian, and linear interpolation; the Gaussian has the variance that the others leave.

The weights of a pixel are those of its own range, so that light of near surfaces spreads over far
ones. A plane across the ray is farther away where its scattered light comes from; so the range is
first multiplied by the *reach*, the inverse of the mean distance of that plane over the level's
Gaussian within the image.

Not modelled: the change of the pixels' angular size across the image.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from statistics import NormalDist

from ...base.geometry import Intrinsics
from .blur_weights import N_LEVELS, SIGMAS

SHARP_LIMIT = 0.24
"""The deviation below which a level counts as sharp [px]."""
CROSS_LIMIT = 0.55
"""The deviation up to which the fine level is a cross of five pixels [px]; above, nine."""
MIN_DEVIATION = 0.7
"""The least deviation of a coarse level after the first [texels]."""
FINE_LIMIT = 0.75
"""The deviation from which a level is coarse [px]."""
N_NODES = 16
MAX_RADIUS = 24
"""The greatest radius of a Gaussian [texels]."""


@dataclass(frozen=True, kw_only=True)
class BlurPlan:
    """The levels of a camera's blur."""

    n_sharp: int
    """The number of levels that count as sharp."""
    fine_variance: float | None
    """The variance of the fine level [px^2]; None if there is none."""
    spreads: tuple[float, ...]
    """The deviation of the Gaussian of each coarse level, in its texels; 0: none."""

    texels: tuple[int, ...]
    """The edge of a texel of each coarse level [px]."""
    reach: tuple[float, ...]
    """The factor on the range of each of the five levels."""

    @property
    def n_coarse(self) -> int:
        """The number of coarse levels."""
        return len(self.spreads)

    @property
    def switches(self) -> tuple[tuple[str, int], ...]:
        """The switches of the shader of the final image, for the sharp and the fine levels."""
        if self.fine_variance is None:
            return (("N_SHARP", self.n_sharp), ("FINE", 0))
        kernel = 1 if math.sqrt(self.fine_variance) <= CROSS_LIMIT else 2
        share = round(500.0 * self.fine_variance)
        return (("N_SHARP", self.n_sharp), ("FINE", kernel), ("FINE_SHARE", share))


@lru_cache(maxsize=64)
def plan_blur(intrinsics: Intrinsics, *, has_blur: bool) -> BlurPlan:
    """Return the plan of a camera's blur."""
    if not has_blur:
        return BlurPlan(
            n_sharp=N_LEVELS, fine_variance=None, spreads=(), texels=(), reach=(1.0,) * N_LEVELS
        )
    focal = math.sqrt(intrinsics.fx * intrinsics.fy)
    deviations = [sigma * focal for sigma in SIGMAS]  # [px]
    n_sharp = sum(deviation < SHARP_LIMIT for deviation in deviations)
    fine_deviations = [d for d in deviations if SHARP_LIMIT <= d < FINE_LIMIT]
    coarse_deviations = [d for d in deviations if d >= FINE_LIMIT]
    wide_texel = (
        8 if len(coarse_deviations) > 1 and coarse_deviations[1] >= 8.0 * MIN_DEVIATION else 4
    )
    texels = (2, *(wide_texel * 4**index for index in range(len(coarse_deviations) - 1)))[
        : len(coarse_deviations)
    ]
    return BlurPlan(
        n_sharp=n_sharp,
        fine_variance=fine_deviations[0] ** 2 if fine_deviations else None,
        spreads=tuple(
            _find_spread(deviation, texels[: index + 1])
            for index, deviation in enumerate(coarse_deviations)
        ),
        texels=texels,
        reach=tuple(_find_reach(sigma, intrinsics) for sigma in SIGMAS),
    )


def compute_radius(spread: float) -> int:
    """Compute the radius of a Gaussian [texels]."""
    return min(math.ceil(3.0 * spread), MAX_RADIUS) if spread > 0.0 else 0


def _find_reach(sigma: float, lens: Intrinsics) -> float:
    """Return the inverse of the mean of sqrt(1 + x^2 + y^2) over a Gaussian, within the image."""
    half_width, half_height = 0.5 * lens.width / lens.fx, 0.5 * lens.height / lens.fy
    normal = NormalDist(0.0, sigma)
    nodes = [abs(normal.inv_cdf((i + 0.5) / N_NODES)) for i in range(N_NODES)]
    columns, rows = ([min(x, limit) ** 2 for x in nodes] for limit in (half_width, half_height))
    total = math.fsum(math.sqrt(1.0 + x + y) for x in columns for y in rows)
    return N_NODES**2 / total


def _find_spread(deviation: float, texels: tuple[int, ...]) -> float:
    """Return the deviation of the Gaussian of a coarse level [texels], in steps of 0.001.

    The mean of texel x texel pixels has the variance (1 - 1 / texel^2) / 12 square texels, linear
    interpolation 1/6, and that of the finer levels 1/6 of their texels.
    """
    texel = texels[-1]
    total = (deviation / texel) ** 2
    finer_squares = math.fsum((finer_texel / texel) ** 2 for finer_texel in texels[:-1])
    rest = total - (1.0 - 1.0 / texel**2) / 12.0 - (1.0 + finer_squares) / 6.0
    return round(math.sqrt(rest), 3) if rest > 0.01 else 0.0

r"""The plan of the blur for a camera: its Gaussian levels and the resolution of each.

The first level has a deviation of one pixel, the last one of 410 mrad, and the ratio between
levels is constant, 2.6 or near it. Narrower blur counts as sharp; `blur_weights` fits all to the
water. The first level is drawn at half the resolution, each further one at half of the one before.
A level is reduced from pixels, has a Gaussian, and is interpolated linearly; the Gaussian has the
variance that the others leave. The first two levels are means of squares of pixels; each further
reduction weighs texels by 1, 3, 3, 1, since the means of squares would pass on patterns of their
own size.

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
from .blur_weights import HIGHEST_FREQUENCY

LAST_DEVIATION = 0.41
"""The deviation of the last level [rad]."""
RATIO = 2.6
"""The ratio of the deviations of two levels, approximately."""
MAX_LEVELS = 8
MAX_PIXEL_FREQUENCY = 0.3
"""The highest frequency at which the blur is fitted [cycles/px]."""
N_SQUARES = 2
"""The number of levels that are means of squares."""
SQUARE_VARIANCE, SMOOTH_VARIANCE = 0.0625, 0.1875
"""The variance of a reduction by 1, 1 and by 1, 3, 3, 1 [texels^2 of the reduced level]."""
INTERPOLATION_VARIANCE = 0.1875
"""The variance of linear interpolation to twice the resolution [texels^2]."""
N_NODES = 16
MAX_RADIUS = 24
"""The greatest radius of a Gaussian [texels]."""


@dataclass(frozen=True, kw_only=True)
class BlurPlan:
    """The levels of a camera's blur."""

    sigmas: tuple[float, ...]
    """The standard deviation of each level [rad]."""
    spreads: tuple[float, ...]
    """The parameter of the Gaussian of each level, in its texels; 0: none."""
    reach: tuple[float, ...]
    """The factor on the range of each level."""
    highest_frequency: float
    """The highest frequency at which the weights are fitted [cycles/rad]."""

    @property
    def n_levels(self) -> int:
        """The number of levels; 0: all light counts as sharp."""
        return len(self.sigmas)


@lru_cache(maxsize=64)
def plan_blur(intrinsics: Intrinsics, *, has_blur: bool) -> BlurPlan:
    """Return the plan of a camera's blur."""
    focal = math.sqrt(intrinsics.fx * intrinsics.fy)
    n_steps = round(math.log(max(LAST_DEVIATION * focal, 1.0)) / math.log(RATIO))
    n_steps = min(n_steps, MAX_LEVELS - 1)
    if not has_blur or n_steps < 1:
        return BlurPlan(sigmas=(), spreads=(), reach=(), highest_frequency=HIGHEST_FREQUENCY)
    ratio = (LAST_DEVIATION * focal) ** (1.0 / n_steps)
    deviations = [ratio**level for level in range(n_steps + 1)]  # [px]
    sigmas = tuple(deviation / focal for deviation in deviations)
    return BlurPlan(
        sigmas=sigmas,
        spreads=tuple(_find_spread(d, level) for level, d in enumerate(deviations)),
        reach=tuple(_find_reach(sigma, intrinsics) for sigma in sigmas),
        highest_frequency=min(HIGHEST_FREQUENCY, MAX_PIXEL_FREQUENCY * focal),
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


def _find_spread(deviation: float, level: int) -> float:
    """Return the parameter of the Gaussian of a level [texels], in steps of 0.001.

    Args:
        deviation: the deviation of the level [px].
        level: its index; a texel is 2^(level + 1) pixels wide.
    """
    reduction = interpolation = 0.0
    for finer_level in range(level + 1):
        step = SQUARE_VARIANCE if finer_level < N_SQUARES else SMOOTH_VARIANCE
        reduction = 0.25 * reduction + step
        interpolation = 0.25 * interpolation + INTERPOLATION_VARIANCE
    rest = (deviation / 2.0 ** (level + 1)) ** 2 - reduction - interpolation
    return _find_parameter(rest) if rest > 0.01 else 0.0


def _find_parameter(variance: float) -> float:
    """Return the parameter of a sampled Gaussian that has a variance [texels], by bisection.

    Samples at whole texels within the radius have a smaller variance than the Gaussian.
    """
    low, high = 0.1, 2.0 * math.sqrt(variance) + 1.0
    while high - low > 5e-4:
        middle = 0.5 * (low + high)
        squares = [number * number for number in range(1, compute_radius(middle) + 1)]
        weights = [math.exp(-0.5 * square / (middle * middle)) for square in squares]
        total = 1.0 + 2.0 * math.fsum(weights)
        moment = 2.0 * math.fsum(w * square for w, square in zip(weights, squares, strict=True))
        low, high = (middle, high) if moment < variance * total else (low, middle)
    return round(0.5 * (low + high), 3)

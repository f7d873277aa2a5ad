r"""The share of scattered light that keeps a checker's contrast.

A checker has two white and two black squares of side :math:`a`, on a grey card of their mean
reflectance. Light that is scattered once on its way to the camera comes from a ring of the card
around the point that the pixel sees. With the mean :math:`f` of the pattern (white 1, black -1,
card 0) over a ring of radius :math:`r` around the places in the inner half of a white square,

.. math::
    X = \int_0^1 \int_0^{\pi/2} f\!\left(\frac{R}{a}\, s \tan\theta\right) dF(\theta)\, ds

is the share of the scattered light that adds to the difference of white and black, with the range
:math:`R` and the cumulative phase function :math:`F`. The rest of the light is lost to the
difference, as if it had been absorbed.

Not modelled: other checkers and the edges of the card (a difference of opposite squares cancels
their light to first order), and a board that is not across the line of sight.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from ..optics import PhaseFunction
from ..optics.phase_function import FloatArray

INNER_SHARE = 0.5
"""The side of the inner part of a square that is read, as a share of its side."""
MAX_RADIUS = 3.0
"""The radius beyond which no ring meets the checker, in sides of a square."""
N_RADII = 601
N_AZIMUTHS = 256
N_PLACES = 9
"""The number of places along one side of the inner part."""
N_ANGLES = 4000


def compute_checker_share(
    phase: PhaseFunction, side: float, distance: float, inner_share: float = INNER_SHARE
) -> float:
    """Compute the share X of the scattered light that keeps the contrast of a checker.

    Args:
        phase: the phase function.
        side: the side of a square [m].
        distance: the range of the checker [m].
        inner_share: the side of the part of a square that is read, as a share; 0: its centre.
    """
    limits = np.geomspace(1e-8, math.pi / 2 * (1.0 - 1e-6), N_ANGLES)
    shares = np.diff(phase.compute_cumulative(limits), prepend=0.0)
    angles = np.append(limits[0], np.sqrt(limits[1:] * limits[:-1]))
    radii = np.tan(angles) * distance / side  # in sides of a square
    table_radii, integrals = _integrate_rings(inner_share)
    means = np.interp(radii, table_radii, integrals) / radii
    return float(np.sum(shares * np.where(radii < 1e-4, 1.0, means)))


@cache
def _integrate_rings(inner_share: float) -> tuple[FloatArray, FloatArray]:
    """Return radii, and the integrals of the ring means f up to them, in sides of a square."""
    offsets = (np.arange(N_PLACES) + 0.5) / N_PLACES * inner_share - inner_share / 2.0
    x, y = np.meshgrid(0.5 + offsets, 0.5 + offsets)
    azimuths = (np.arange(N_AZIMUTHS) + 0.5) / N_AZIMUTHS * 2.0 * math.pi
    radii = np.linspace(0.0, MAX_RADIUS, N_RADII)
    means = np.array(
        [
            _evaluate_pattern(
                x[..., None] + radius * np.cos(azimuths), y[..., None] + radius * np.sin(azimuths)
            ).mean()
            for radius in radii
        ]
    )
    steps = 0.5 * (means[1:] + means[:-1]) * np.diff(radii)
    return radii, np.append(0.0, np.cumsum(steps))


def _evaluate_pattern(x: FloatArray, y: FloatArray) -> FloatArray:
    """Return the pattern around the centre of the checker, in sides of a square."""
    is_inside = (np.abs(x) < 1.0) & (np.abs(y) < 1.0)
    return np.where(is_inside, np.sign(x * y), 0.0)

r"""Ripples: short waves that a light wind makes, which focus sunlight.

The slopes follow C. Cox and W. Munk (*J. Opt. Soc. Am.* 44, 838 (1954)), with the wind speed
:math:`W` 12.5 m above the surface:

.. math::
    \overline{s_u^2} = 0.00316\, W, \quad \overline{s_c^2} = 0.003 + 0.00192\, W

along the wind and across it. `ripple_spectrum` spreads their total over the wave number. Waves of
2 m to 12.5 cm are drawn in a tile, with random phases. Longer waves are those of ``<u:waves>``. The
slopes of shorter ones blur the light (`unresolved_slope`). The directions have the distribution

.. math::
    D(\vartheta) \propto 1 + \min(W / 2, 1) \cos\vartheta + 2\, \max\left(\frac{\overline{s_u^2} -
        \overline{s_c^2}}{\overline{s_u^2} + \overline{s_c^2}}, 0\right) \cos 2\vartheta

So ripples run with the wind from 2 m/s on, and in all directions in calm air. They obey
:math:`\omega^2 = g k + (\sigma/\rho) k^3`.

Not modelled: gusts, waves of walls, and the growth of ripples on crests.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...base import rng
from ...base.geometry import Array
from ...base.numerics.elementwise import arctan2
from ...world import GRAVITY
from .ripple_spectrum import SURFACE_TENSION, compute_saturation, find_slope_share
from .wave_tile import (
    MAX_WAVE_LENGTH,
    MIN_WAVE_LENGTH,
    TILE_EDGE,
    TileWaves,
)

LEAST_SHARE = 1e-7
"""The share of the variance of slopes below which a wave is not drawn [1]."""
STREAM = "scene/ripples"
"""The random stream of the phases."""


@dataclass(frozen=True, kw_only=True)
class Ripples:
    """The ripples of a scene."""

    wind_speed: float = 2.0
    """The speed of the wind [m/s]."""
    direction: float = 0.0
    """The direction in which the wind blows, from x of W towards y [rad]."""

    @property
    def slope_variances(self) -> tuple[float, float]:
        """The variance of the slope along the wind and across it [1]."""
        return 0.00316 * self.wind_speed, 0.003 + 0.00192 * self.wind_speed

    @property
    def unresolved_slope(self) -> float:
        """The standard deviation of the slope along one axis by waves that are not drawn [1]."""
        return math.sqrt(0.5 * self._compute_variance(0.0, MIN_WAVE_LENGTH))

    @property
    def short_wave_variance(self) -> float:
        """The variance of the slope along one axis by the waves that ripples have [1]."""
        return 0.5 * self._compute_variance(0.0, MAX_WAVE_LENGTH)

    def draw(self, seed: int) -> TileWaves:
        """Draw the waves of a tile.

        Args:
            seed: the seed of the phases.
        """
        columns, rows = _find_lattice()
        numbers = 2.0 * math.pi / TILE_EDGE * np.sqrt(columns**2 + rows**2)  # (n,) [rad/m]
        saturation = compute_saturation(numbers, self.wind_speed)
        density = self._compute_directions(arctan2(rows, columns)) * saturation / numbers**2
        is_strong = density > LEAST_SHARE * density.sum()
        columns, rows, numbers, density = (
            array[is_strong] for array in (columns, rows, numbers, density)
        )
        total_variance = self._compute_variance(MIN_WAVE_LENGTH, MAX_WAVE_LENGTH)
        variances = density * (total_variance / density.sum())
        generator = rng.stream(seed, STREAM)
        return TileWaves(
            columns=columns,
            rows=rows,
            amplitude=np.sqrt(2.0 * variances) / numbers,
            angular_frequency=compute_frequencies(numbers),
            phase=2.0 * math.pi * generator.random(len(columns)),
        )

    def _compute_variance(self, min_length: float, max_length: float) -> float:
        """Compute the variance of both slopes by the waves between two lengths [m]."""
        share = find_slope_share(self.wind_speed, min_length, max_length)
        return sum(self.slope_variances) * share

    def _compute_directions(self, angles: Array) -> Array:
        """Compute the relative density of directions of travel."""
        variance_along, variance_across = self.slope_variances
        angles_to_wind = angles - self.direction
        second = 2.0 * max(
            (variance_along - variance_across) / (variance_along + variance_across), 0.0
        )
        density: Array = (
            1.0
            + min(0.5 * self.wind_speed, 1.0) * np.cos(angles_to_wind)
            + second * np.cos(2.0 * angles_to_wind)
        )
        return np.maximum(density, 0.0)


def compute_frequencies(wave_numbers: Array) -> Array:
    """Compute the angular frequencies of short waves on deep water [rad/s]."""
    frequencies: Array = np.sqrt(GRAVITY * wave_numbers + SURFACE_TENSION * wave_numbers**3)
    return frequencies


def _find_lattice() -> tuple[np.ndarray, np.ndarray]:
    """Return the columns and rows of the waves of a tile, by their lengths."""
    max_number = round(TILE_EDGE / MIN_WAVE_LENGTH)
    numbers = np.arange(-max_number, max_number + 1)
    columns, rows = (grid.ravel() for grid in np.meshgrid(numbers, numbers))
    squares = columns**2 + rows**2
    min_number = TILE_EDGE / MAX_WAVE_LENGTH
    is_drawn = (squares >= min_number**2) & (squares <= max_number**2)
    return columns[is_drawn], rows[is_drawn]

r"""Synthetic sea floors: a random surface of a stated spectrum, with channels and rocks.

The surface is Gaussian with the two-dimensional power spectrum

.. math:: P(k) \propto \left(1 + (k / k_0)^2\right)^{-\gamma / 2}, \qquad k_0 = 2 \pi / L,

the form of von Karman that J. A. Goff and T. H. Jordan use for abyssal hills (*Stochastic modeling
of seafloor morphology*, JGR 93(B11), 1988). Below the corner length L, it falls with the exponent
:math:`\gamma`; 2 to 4 are usual for sea floors, and 3.25 is common (APL-UW, *High-frequency ocean
environmental acoustic models handbook*, TR 9407, 1994). White noise is filtered by FFT on a grid
that is an eighth larger on each axis, so that opposite edges are independent.

A channel has a Gaussian cross-section about a meandering line, and a rock is the upper part of a
ball. Not modelled: anisotropy, bedforms of currents, sediment on slopes, overhangs.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array
from ..base.numerics.elementwise import exp, power
from ..base.numerics.jit import njit
from ..base.rng import stream
from ..errors import BadSetting
from .chart import Chart
from .coordinates import LOCAL_SYSTEM, CoordinateSystem
from .height_grid import check_size

PADDING = 1.125
"""The ratio of the sides of the filtered grid and of the chart [1]."""
RESOLUTION = 1e-3
"""The step to which heights are rounded, so that files are the same on every computer [m]."""
MAX_ROCKS = 1_000_000
"""The greatest number of rocks."""
ROCK_RISE = 0.6
"""The part of a rock's radius that is above the floor [1]."""


@dataclass(frozen=True, kw_only=True)
class SyntheticFloor:
    """The parameters of a synthetic sea floor."""

    width: float = 1000.0
    """The size along x (east) [m]."""
    height: float = 1000.0
    """The size along y (north) [m]."""
    spacing: float = 2.0
    """The distance between nodes [m]."""
    depth: float = 30.0
    """The mean depth [m]."""
    slope: float = 0.0
    """The slope of the mean floor, which gets deeper towards the east [deg]."""
    roughness: float = 1.0
    """The root mean square of the random heights [m]."""
    exponent: float = 3.25
    """The exponent of the two-dimensional spectrum [1]."""
    corner: float = 200.0
    """The corner length, above which the spectrum is flat [m]."""
    channels: int = 0
    """The number of channels, which run about from west to east."""
    channel_depth: float = 5.0
    """The depth of the channels below the floor [m]."""
    channel_width: float = 40.0
    """The width of the channels at 0.37 of their depth [m]."""
    rocks: float = 0.0
    """The number of rocks in a hectare [1e-4 1/m2]."""
    rock_size: float = 2.0
    """The mean diameter of the rocks [m]; diameters are from half to twice of it."""
    seed: int = 0
    """The seed; each has another floor with the same statistics."""

    @property
    def shape(self) -> tuple[int, int]:
        """The number of rows and of columns."""
        return tuple(round(side / self.spacing) + 1 for side in (self.height, self.width))  # type: ignore[return-value]


def make_floor(floor: SyntheticFloor, system: CoordinateSystem = LOCAL_SYSTEM) -> Chart:
    """Make the chart of a synthetic floor, whose middle is the origin of the coordinates.

    Raises:
        BadSetting: there are too many rocks.
        UwsimError: there are too many nodes.
    """
    rows, columns = floor.shape
    check_size(rows, columns, "the floor")
    n_rocks = round(floor.rocks * floor.width * floor.height * 1e-4)
    if n_rocks > MAX_ROCKS:
        raise BadSetting(f"The floor has {n_rocks} rocks; expected {MAX_ROCKS} at most.")
    x, y = (
        np.asarray(floor.spacing * (np.arange(n) - 0.5 * (n - 1)), np.float64)
        for n in (columns, rows)
    )
    heights = rough_surface(floor)
    heights -= floor.depth + math.tan(math.radians(floor.slope)) * x
    _cut_channels(heights, floor, x, y)
    if n_rocks:
        generator = stream(floor.seed, "bathymetry/rocks")
        places = generator.uniform(-0.5, 0.5, (n_rocks, 2)) * [x[-1] - x[0], y[-1] - y[0]]
        radii = 0.5 * floor.rock_size * power(2.0, generator.uniform(-1.0, 1.0, n_rocks))
        _place_rocks(heights, float(x[0]), float(y[0]), floor.spacing, places, radii)
    rounded_heights = np.rint(heights / RESOLUTION) * RESOLUTION
    return Chart(
        x=float(x[0]), y=float(y[0]), step_x=floor.spacing, step_y=floor.spacing,
        heights=rounded_heights.astype(np.float32), system=system,
    )  # fmt: skip


def rough_surface(floor: SyntheticFloor) -> Array:
    """Return random heights of the spectrum, mean 0 and the stated rms, (rows, columns) [m]."""
    rows, columns = floor.shape
    size = tuple(_fast_length(math.ceil(PADDING * n)) for n in (rows, columns))
    noise = stream(floor.seed, "bathymetry/roughness").standard_normal(size)
    k_y = np.fft.fftfreq(size[0], floor.spacing)[:, None]  # in cycles a metre
    k_x = np.fft.rfftfreq(size[1], floor.spacing)
    squares = (k_x * k_x + k_y * k_y) * floor.corner**2
    amplitudes = power(1.0 + squares, -0.25 * floor.exponent)
    amplitudes[0, 0] = 0.0
    surface: Array = np.fft.irfft2(np.fft.rfft2(noise) * amplitudes, size)[:rows, :columns]
    surface = surface - surface.mean()
    rms = math.sqrt(float((surface * surface).mean()))
    return surface * (floor.roughness / rms if rms > 0.0 else 0.0)


def _fast_length(n: int) -> int:
    """Return the least length from n on whose prime factors are 2, 3 and 5."""
    while True:
        rest = n
        for factor in (2, 3, 5):
            while rest % factor == 0:
                rest //= factor
        if rest == 1:
            return n
        n += 1


def _cut_channels(heights: Array, floor: SyntheticFloor, x: Array, y: Array) -> None:
    """Lower the heights in the channels."""
    generator = stream(floor.seed, "bathymetry/channels")
    for _ in range(floor.channels):
        middle, turn, phase, waves = generator.uniform(-1.0, 1.0, 4)
        wavenumber = 2.0 * math.pi * (1.5 + waves) / floor.width
        swing = 0.08 * floor.height
        angles = wavenumber * x + math.pi * phase
        line = 0.35 * middle * floor.height + 0.3 * turn * x + swing * np.sin(angles)
        slopes = 0.3 * turn + swing * wavenumber * np.cos(angles)
        distance = (y[:, None] - line) / np.sqrt(1.0 + slopes * slopes)
        ratio = distance / (0.5 * floor.channel_width)
        heights -= floor.channel_depth * exp(-ratio * ratio)


@njit
def _place_rocks(
    heights: Array, west: float, south: float, spacing: float, places: Array, radii: Array
) -> None:
    """Raise the heights to the tops of rocks: balls whose lower part is in the floor.

    Args:
        heights: the heights, (rows, columns) [m].
        west: the x of the first column [m].
        south: the y of the first row [m].
        spacing: the distance between nodes [m].
        places: the x and y of each rock, (n, 2) [m].
        radii: the radius of each rock, (n,) [m].
    """
    rows, columns = heights.shape
    for n in range(len(radii)):
        u, v, reach = (
            (places[n, 0] - west) / spacing,
            (places[n, 1] - south) / spacing,
            radii[n] / spacing,
        )
        i_0, j_0 = min(max(round(v), 0), rows - 1), min(max(round(u), 0), columns - 1)
        base = heights[i_0, j_0] - (1.0 - ROCK_RISE) * radii[n]
        for i in range(max(0, math.ceil(v - reach)), min(rows, math.floor(v + reach) + 1)):
            for j in range(max(0, math.ceil(u - reach)), min(columns, math.floor(u + reach) + 1)):
                square = reach * reach - (i - v) ** 2 - (j - u) ** 2
                if square > 0.0:
                    heights[i, j] = max(heights[i, j], base + spacing * math.sqrt(square))

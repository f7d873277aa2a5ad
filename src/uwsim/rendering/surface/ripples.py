r"""Ripples: short waves that the wave systems of a scene leave out, as a texture that repeats.

The slopes of the sea have the variance of C. Cox and W. Munk in the wind of the scene
(`caustics.ripples`). What the waves of the scene lack of it, ripples have, and at least the share
of waves shorter than 2 m, also in steep seas. It is equal in equal steps of the logarithm of the
wave length. Each ripple obeys the dispersion of gravity and surface tension,
:math:`\omega^2 = g k + (\tau / \rho) k^3`. A tile of 5.3 m has waves of 0.13 to 2 m; it is used
twice, the second time turned and at 0.43 of its size, so the sum does not repeat.

They have the statistics of the ripples of caustics, but are others: those repeat after 2 m.
Ripples change images alone: they have no elevation and move no bodies. Not modelled: that ripples
travel on larger waves, the skewness of their slopes, and the speed of the smaller ones.
"""

from __future__ import annotations

import math

import moderngl
import numpy as np

from ...base import rng
from ...base.geometry import Array
from ...base.numerics.elementwise import exp
from .wave_grids import GRAVITY, N_POINTS, Components, compute_grid

SIZE = 5.3
"""The edge of the tile [m]."""
WAVE_LENGTHS = (0.13, 2.0)
"""The shortest and the longest waves of the tile [m]."""
N_RIPPLES = 90
"""The number of ripples in the tile."""
N_USES = 2
"""The number of times that the tile is added up; each has the same share of the variance."""
TENSION = 7.3e-5
"""The surface tension of water over its density [m3/s2]."""
SPREADING = 0.9
"""The standard deviation of the directions of ripples [rad]."""


class RippleTile:
    """The texture of the slopes of ripples, of the variance 1 along each axis.

    Args:
        context: the context of the renderer.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self.texture: moderngl.Texture = context.texture((N_POINTS, N_POINTS), 4, dtype="f4")
        """The tile; the second and third channels are the slopes along x and y."""
        self.texture.filter = (moderngl.LINEAR, moderngl.LINEAR)
        self.texture.repeat_x = self.texture.repeat_y = True
        self._key: object = None
        self._seed: object = None
        self._components: Components | None = None

    def update(self, seed: int, time: float, direction: float) -> None:
        """Compute and upload the tile, unless it is that of the last image.

        Args:
            seed: the seed of the ripples.
            time: the simulation time [s].
            direction: the mean direction of travel, from x of W towards y [rad].
        """
        key = seed, direction, time
        if key == self._key:
            return
        if self._components is None or key[:2] != self._seed:
            self._components = draw_ripples(rng.stream(seed, "scene/ripples"), direction)
        self._key, self._seed = key, key[:2]
        c = self._components
        columns = (c.amplitude, c.omega, c.kx, c.ky, c.phase)
        tile = compute_grid(columns, (0.0, 0.0), SIZE / N_POINTS, time, N_POINTS)
        self.texture.write(tile.tobytes())


def draw_ripples(generator: np.random.Generator, direction: float) -> Components:
    """Draw the ripples of a tile: whole waves fit into it, and slopes have the variance 1.

    Args:
        generator: the random generator.
        direction: the mean direction of travel [rad].
    """
    lengths = WAVE_LENGTHS
    shares = (np.arange(N_RIPPLES) + generator.random(N_RIPPLES)) / N_RIPPLES
    log_lengths = math.log(lengths[0]) + shares * (math.log(lengths[1]) - math.log(lengths[0]))
    number = 2.0 * math.pi / exp(log_lengths)
    angle = direction + SPREADING * generator.standard_normal(N_RIPPLES)
    step = 2.0 * math.pi / SIZE
    kx = step * np.round(number * np.cos(angle) / step)
    ky = step * np.round(number * np.sin(angle) / step)
    kx = np.where((kx == 0.0) & (ky == 0.0), step, kx)
    square = kx * kx + ky * ky
    number = np.sqrt(square)
    total: Array = np.sqrt(4.0 / N_RIPPLES / square)
    return Components(
        amplitude=total,
        omega=np.sqrt(GRAVITY * number + TENSION * square * number),
        kx=kx,
        ky=ky,
        phase=2.0 * math.pi * generator.random(N_RIPPLES),
    )

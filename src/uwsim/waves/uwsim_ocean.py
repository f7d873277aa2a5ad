r"""uwsimOcean: the sea of UWSim's ocean parameters, ``<windSpeed>`` and others of ``<oceanState>``.

.. code-block:: xml

    <u:uwsimOcean> <u:components>400</u:components> </u:uwsimOcean>

UWSim draws, for the eye only, the sum over a grid of 64 x 64 wave vectors of a tile of 256 m, with
Gaussian amplitudes whose mean square is (Phillips; Tessendorf, Simulating Ocean Water, 2001)

.. math:: P(k) = \frac{N A}{k^4} e^{-g^2/(k^2 V^4)} \frac{(k \cdot w)^2}{k^2}
    e^{-10^{-6} k^2 V^4/g^2}

with N = 64, the scale A, the wind vector w and the wind speed V; waves against the wind are damped.
Here the same amplitudes travel by the dispersion relation, and so exert forces. UWSim rounds their
frequencies down to multiples of 0.1 Hz, so that its sea repeats after 10 s and its longest waves
stand still.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array
from ..base.numerics.elementwise import arctan2, exp, tanh
from ..schema import element
from ..world import GRAVITY
from .components import WaveComponents
from .wave_system import MAX_COMPONENTS, SeaSettings, WaveSystemSpec

GRID_SIZE = 64
"""The number of wave vectors along each axis."""
TILE_SIZE = 256.0
"""The edge of the tile [m]."""
MAX_SETTING = 1000.0
"""The greatest value of a setting of UWSim's ocean [m/s, or 1]."""


@dataclass(frozen=True, kw_only=True)
class UwsimOceanSpec(WaveSystemSpec):
    """A ``<u:uwsimOcean>``: the waves that UWSim draws, with forces."""

    n_components: int = element(
        "components", namespaced=True, default=200, minimum=1, maximum=MAX_COMPONENTS
    )
    """The number of components: those of the most energy, scaled to the energy of all."""

    @property
    def n_components_at_most(self) -> int:
        """The number of components."""
        return self.n_components

    def sea_errors(self, sea: SeaSettings) -> Iterator[str]:
        """Yield the errors of the settings of UWSim's ocean, which only this system uses."""
        settings = {
            "windSpeed": sea.wind_speed,
            "reflectionDamping": sea.reflection_damping,
            "waveScale": sea.wave_scale,
        }
        for name, value in settings.items():
            if not 0.0 <= value <= MAX_SETTING:
                yield (
                    f"<{name}> is {value:g}; <u:uwsimOcean> expects a number >= 0 and <= "
                    f"{MAX_SETTING:g}"
                )
        for name, value in zip(("windx", "windy"), sea.wind, strict=True):
            if not abs(value) <= MAX_SETTING:
                yield f"<{name}> is {value:g}; <u:uwsimOcean> expects at most {MAX_SETTING:g}"

    def peak_number(self, sea: SeaSettings) -> float:
        """Return the wave number of the wave vector with the most power [rad/m]."""
        kx, ky, power = wave_power(sea)
        peak = int(np.argmax(power))
        return math.hypot(kx[peak], ky[peak]) if power[peak] > 0.0 else 0.0

    def expected_height(self, sea: SeaSettings) -> float:
        """Return four standard deviations of the elevation, over all seeds [m]."""
        _, _, power = wave_power(sea)
        return 4.0 * math.sqrt(2.0 * float(power.sum()))  # |h0|^2 has two standard normal parts

    def components(self, sea: SeaSettings, rng: np.random.Generator) -> WaveComponents:
        """Draw its components."""
        real_part, imaginary_part = rng.standard_normal((2, GRID_SIZE, GRID_SIZE))
        phases = arctan2(imaginary_part, real_part).ravel()
        kx, ky, power = wave_power(sea)
        # h0(k) and its conjugate partner give a wave of amplitude 2 |h0|
        energy = power * (real_part**2 + imaginary_part**2).ravel()  # (2 |h0|)^2 / 2 [m2]
        indices = np.argsort(-energy, kind="stable")[: self.n_components]
        indices = np.sort(indices[energy[indices] > 0.0])
        total = float(energy[indices].sum())
        scale = math.sqrt(float(energy.sum()) / total) if total > 0.0 else 0.0
        k = np.sqrt(kx[indices] ** 2 + ky[indices] ** 2)
        return WaveComponents(
            amplitude=scale * np.sqrt(2.0 * energy[indices]),
            angular_frequency=np.sqrt(GRAVITY * k * tanh(k * sea.depth)),
            direction=arctan2(ky[indices], kx[indices]),
            phase=phases[indices],
        )


def wave_power(sea: SeaSettings) -> tuple[Array, Array, Array]:
    """Compute the power of UWSim's spectrum on its grid.

    Args:
        sea: the settings of the sea.

    Returns:
        The wave vectors along x and y of L [rad/m], and the power of each [m2], (4096,) each.
    """
    axis = 2.0 * math.pi / TILE_SIZE * (np.arange(GRID_SIZE) - GRID_SIZE // 2)
    kx, ky = (grid.ravel() for grid in np.meshgrid(axis, axis))
    square = kx**2 + ky**2
    square[square == 0.0] = np.inf
    along_wind = kx * sea.wind[0] + ky * sea.wind[1]
    length = max(sea.wind_speed, 1e-3) ** 2 / GRAVITY  # of the longest waves [m]
    power = GRID_SIZE * sea.wave_scale / square**2 * exp(-1.0 / (square * length**2))
    power *= along_wind**2 / square * exp(-square * length**2 * 1e-6)
    power[along_wind < 0.0] *= sea.reflection_damping
    return kx, ky, np.where(np.isfinite(square), power, 0.0)

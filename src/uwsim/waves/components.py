r"""The sinusoidal components that a sea is the sum of.

The energy of a spectrum is divided among components: the angular frequency of each is drawn in a
band of its own, its amplitude :math:`a_i = \sqrt{2 \int S d\omega}` contains the whole energy of
the band, and its phase is uniform. The bands have equal parts of a measure, half of which is the
energy and half the logarithm of the frequency. So the variance is exact, the peak is resolved, the
tail has components, and the sea does not repeat, as it does with equal steps of frequency.

Each component has one direction of travel, drawn from the spreading function. Two components of one
frequency in several directions would interfere at fixed places (Jefferys 1987).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..base.geometry import Array
from ..base.numerics.elementwise import exp, log
from .spectrum import MAX_FREQUENCY_RATIO, MIN_FREQUENCY_RATIO, Spectrum

N_NODES = 20001
"""The number of frequencies at which a spectrum is integrated."""
N_ANGLES = 3601
"""The number of angles at which a spreading function is integrated."""


@dataclass(frozen=True, kw_only=True, eq=False)
class WaveComponents:
    r"""The sinusoidal components, :math:`a \cos(k \cdot x - \omega t + \varphi)`."""

    amplitude: Array
    """The amplitudes, (n,) [m]."""
    angular_frequency: Array
    """The angular frequencies, (n,) [rad/s]."""
    direction: Array
    """The directions of travel, from x of L towards y, (n,) [rad]."""
    phase: Array
    """The phases at the origin of L at time 0, (n,) [rad]."""

    def __len__(self) -> int:
        """Return the number of components."""
        return len(self.amplitude)

    @property
    def significant_height(self) -> float:
        """The significant wave height: four standard deviations of the elevation [m]."""
        return 4.0 * math.sqrt(0.5 * float(np.sum(self.amplitude**2)))

    @classmethod
    def concatenate(cls, systems: Sequence[WaveComponents]) -> WaveComponents:
        """Return the components of several wave systems."""
        return cls(
            amplitude=np.concatenate([system.amplitude for system in systems]),
            angular_frequency=np.concatenate([system.angular_frequency for system in systems]),
            direction=np.concatenate([system.direction for system in systems]),
            phase=np.concatenate([system.phase for system in systems]),
        )


def draw_components(
    spectrum: Spectrum,
    n: int,
    rng: np.random.Generator,
    *,
    direction: float,
    spreading: float | None,
) -> WaveComponents:
    """Draw the components of a sea with a spectrum.

    Args:
        spectrum: the spectrum of the elevation.
        n: the number of components.
        rng: the random generator.
        direction: the mean direction of travel, from x of L towards y [rad].
        spreading: the exponent s of the spreading function; None: all travel in one direction.
    """
    log_minimum = math.log(MIN_FREQUENCY_RATIO * spectrum.peak_frequency)
    log_maximum = math.log(MAX_FREQUENCY_RATIO * spectrum.peak_frequency)
    nodes = exp(np.linspace(log_minimum, log_maximum, N_NODES))  # (N_NODES,) [rad/s]
    density = replace(spectrum, significant_height=1.0).density(nodes)
    energy = _integrate(density, nodes)  # (N_NODES,), of the frequencies below each node
    energy /= energy[-1]
    share = 0.5 * energy + 0.5 * (log(nodes) - log_minimum) / (log_maximum - log_minimum)
    edges = np.interp(np.linspace(0.0, 1.0, n + 1), share, nodes)  # (n + 1,) [rad/s]
    variance = spectrum.significant_height**2 / 16.0  # [m2]
    band_energy = variance * np.diff(np.interp(edges, nodes, energy))  # (n,) [m2]
    frequency = edges[:-1] + rng.random(n) * np.diff(edges)
    angles = np.zeros(n) if spreading is None else _draw_angles(spreading, n, rng)
    return WaveComponents(
        amplitude=np.sqrt(2.0 * band_energy),
        angular_frequency=frequency,
        direction=direction + angles,
        phase=2.0 * math.pi * rng.random(n),
    )


def _draw_angles(spreading: float, n: int, rng: np.random.Generator) -> Array:
    r"""Draw angles from the spreading function :math:`\cos^{2s}(\theta/2)`, (n,) [rad].

    One angle is drawn in each of n parts of equal probability, in random order. Source: Longuet-
    Higgins, Cartwright and Smith (1963).
    """
    angles = np.linspace(-math.pi, math.pi, N_ANGLES)
    with np.errstate(divide="ignore"):
        density = exp(2.0 * spreading * log(np.abs(np.cos(0.5 * angles))))
    share = _integrate(density, angles)
    quantiles = (rng.permutation(n) + rng.random(n)) / n
    drawn_angles: Array = np.interp(quantiles, share / share[-1], angles)
    return drawn_angles


def _integrate(values: Array, nodes: Array) -> Array:
    """Return the integral up to each node by the trapezoidal rule, the same shape."""
    steps = 0.5 * (values[1:] + values[:-1]) * np.diff(nodes)
    integral: Array = np.concatenate([[0.0], np.cumsum(steps)])
    return integral

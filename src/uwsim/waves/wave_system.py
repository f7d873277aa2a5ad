"""The interface of wave systems: a wind sea, a swell, a regular wave."""

from __future__ import annotations

import abc
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ..schema import Spec, element
from .components import WaveComponents, draw_components
from .dispersion import wave_numbers
from .spectrum import Spectrum

MAX_HEIGHT = 40.0
"""The largest wave height in a file [m]; the highest that was measured at sea is some 30 m."""
MAX_COMPONENTS = 4000
"""The largest number of components of a wave system."""
MAX_TOTAL_COMPONENTS = 20_000
"""The largest number of components of all wave systems of a scene."""
MAX_DEPTH = 1e5
"""The greatest depth of the water [m]."""


@dataclass(frozen=True, kw_only=True)
class SeaSettings:
    """The settings of the sea that a wave system may need."""

    depth: float
    """The depth of the water [m]."""
    wind: tuple[float, float]
    """The wind of the original's spectrum along x and y of L [1]."""
    wind_speed: float
    """The wind speed of the original's spectrum [m/s]."""
    reflection_damping: float
    """The original's factor on waves that run against the wind [1]."""
    wave_scale: float
    """The scale of the original's spectrum [1]."""


@dataclass(frozen=True, kw_only=True)
class WaveSystemSpec(Spec, abc.ABC):
    """The spec of a wave system."""

    @property
    def n_components_at_most(self) -> int:
        """The largest number of components that it can have."""
        return 1

    @abc.abstractmethod
    def peak_number(self, sea: SeaSettings) -> float:
        """Return the wave number of the waves with the most energy; 0 without waves [rad/m]."""

    @abc.abstractmethod
    def expected_height(self, sea: SeaSettings) -> float:
        """Return the significant height that is expected, or that of a single wave [m]."""

    def sea_errors(self, sea: SeaSettings) -> Iterable[str]:
        """Return errors of the settings that only this system uses, each with its element first."""
        return ()

    @abc.abstractmethod
    def components(self, sea: SeaSettings, rng: np.random.Generator) -> WaveComponents:
        """Draw its components."""


@dataclass(frozen=True, kw_only=True)
class IrregularWavesSpec(WaveSystemSpec, abc.ABC):
    """The spec of a wave system with a spectrum."""

    direction: float = element(namespaced=True, default=0.0)
    """The mean direction of travel, from x of L towards y [rad]."""
    spreading: float | None = element(namespaced=True, default=None, minimum=0.5, maximum=1000.0)
    """The exponent s of the spreading function ``cos(angle/2)^(2s)``: some 10 for a wind sea, 50
    for swell [1]; when absent all waves travel in one direction."""
    n_components: int = element(
        "components", namespaced=True, default=200, minimum=1, maximum=MAX_COMPONENTS
    )
    """The number of sinusoidal components."""

    @property
    @abc.abstractmethod
    def spectrum(self) -> Spectrum:
        """The spectrum of the elevation."""

    def components(self, sea: SeaSettings, rng: np.random.Generator) -> WaveComponents:
        """Draw its components."""
        return draw_components(
            self.spectrum,
            self.n_components,
            rng,
            direction=self.direction,
            spreading=self.spreading,
        )

    def expected_height(self, sea: SeaSettings) -> float:
        """Return the significant height of the spectrum [m]."""
        return self.spectrum.significant_height

    def peak_number(self, sea: SeaSettings) -> float:
        """Return the wave number of the spectrum's peak [rad/m]."""
        frequency = np.array([self.spectrum.peak_frequency])
        return float(wave_numbers(frequency, sea.depth)[0])

    @property
    def n_components_at_most(self) -> int:
        """The number of components."""
        return self.n_components


def find_sea_errors(systems: Sequence[WaveSystemSpec], sea: SeaSettings) -> Iterator[str]:
    """Yield errors of the settings that wave systems cannot use, each with its element first.

    Args:
        systems: the wave systems of a scene; without any there are no errors.
        sea: the settings of the sea.
    """
    if systems and not 0.0 < sea.depth <= MAX_DEPTH:
        yield f"<depth> is {sea.depth:g}; <u:waves> expects a depth > 0 and <= {MAX_DEPTH:g} m"
    n = sum(system.n_components_at_most for system in systems)
    if n > MAX_TOTAL_COMPONENTS:
        yield f"<u:waves> has {n} components; expected at most {MAX_TOTAL_COMPONENTS} in all"
    for system in systems:
        yield from system.sea_errors(sea)

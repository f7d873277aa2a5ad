r"""regularWave: one sinusoidal wave, as a wave maker makes it.

.. code-block:: xml

    <u:regularWave> <u:height>0.3</u:height> <u:period>2.5</u:period> </u:regularWave>
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..schema import element
from .components import WaveComponents
from .dispersion import wave_numbers
from .wave_system import MAX_HEIGHT, SeaSettings, WaveSystemSpec


@dataclass(frozen=True, kw_only=True)
class RegularWaveSpec(WaveSystemSpec):
    """A ``<u:regularWave>``: a sinusoidal wave of small steepness (Airy)."""

    height: float = element(namespaced=True, minimum=0, maximum=MAX_HEIGHT)
    """The height from trough to crest [m]."""
    period: float = element(namespaced=True, minimum=0.2, maximum=60.0)
    """The period [s]."""
    direction: float = element(namespaced=True, default=0.0)
    """The direction of travel, from x of L towards y [rad]."""
    phase: float = element(namespaced=True, default=0.0)
    """The phase at the origin of L at time 0: a crest is there with 0 [rad]."""

    def peak_number(self, sea: SeaSettings) -> float:
        """Return its wave number [rad/m]."""
        return float(wave_numbers(np.array([2.0 * np.pi / self.period]), sea.depth)[0])

    def expected_height(self, sea: SeaSettings) -> float:
        """Return its height [m]."""
        return self.height

    def components(self, sea: SeaSettings, rng: np.random.Generator) -> WaveComponents:
        """Return its single component; nothing is drawn."""
        return WaveComponents(
            amplitude=np.array([0.5 * self.height]),
            angular_frequency=np.array([2.0 * np.pi / self.period]),
            direction=np.array([self.direction]),
            phase=np.array([self.phase]),
        )

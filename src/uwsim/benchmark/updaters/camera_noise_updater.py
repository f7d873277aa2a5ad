"""cameraNoiseUpdater: cameras that grow noisier from level to level.

.. code-block:: xml

    <cameraNoiseUpdater>
      <initialValue>0</initialValue> <finalValue>0.1</finalValue> <step>0.01</step>
      <interval>20</interval>
    </cameraNoiseUpdater>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ...dialect import element
from ...world import Stage
from .updater import SceneUpdater, SceneUpdaterSpec, sweep


@dataclass(frozen=True, kw_only=True)
class CameraNoiseUpdaterSpec(SceneUpdaterSpec):
    """A ``<cameraNoiseUpdater>`` element. The number of levels is counted in float64."""

    name: ClassVar[str] = "noise"

    initial_value: float = element(aliases=("initialNoise",), minimum=0.0)
    """Noise of the first level."""
    final_value: float = element(aliases=("finalNoise",), minimum=0.0)
    """Noise that is not exceeded."""
    step: float = element(above=0.0)
    """What each level adds."""
    interval: float = element(above=0.0)
    """Length of a level [s]."""

    def values(self) -> tuple[float, ...]:
        """Return the value of each level."""
        return sweep(self.initial_value, self.final_value, self.step)

    @property
    def seconds_per_level(self) -> float:
        """The interval [s]."""
        return self.interval

    def bind(self, stage: Stage) -> CameraNoiseUpdater:
        """Take hold of the scene."""
        return CameraNoiseUpdater(stage)


class CameraNoiseUpdater(SceneUpdater):
    """Sets the noise of every colour camera."""

    def __init__(self, stage: Stage) -> None:
        self._stage = stage

    def apply(self, value: float) -> None:
        """Set the standard deviation of the noise, in colour units (0..1)."""
        self._stage.set_camera_noise(value)

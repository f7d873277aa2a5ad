"""cameraNoiseUpdater: camera noise that increases from level to level.

.. code-block:: xml

    <cameraNoiseUpdater>
      <initialValue>0</initialValue> <finalValue>0.1</finalValue> <step>0.01</step>
      <interval>20</interval>
    </cameraNoiseUpdater>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ...schema import Original, element
from ...world import Stage
from .sweep import Setter, SweepSpec


@dataclass(frozen=True, kw_only=True)
class CameraNoiseUpdaterSpec(SweepSpec):
    """A ``<cameraNoiseUpdater>`` element. The number of levels is counted in float64."""

    name: ClassVar[str] = "noise"

    initial_value: float = element(original=Original(aliases=("initialNoise",)), minimum=0.0)
    """The noise of the first level: a standard deviation in colour units, 0..1."""
    final_value: float = element(original=Original(aliases=("finalNoise",)), minimum=0.0)
    """The noise that is not exceeded."""

    def bind(self, stage: Stage) -> Setter:
        """Return a setter of the noise of all colour cameras."""
        return Setter(stage.set_camera_noise)

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
    """A ``<cameraNoiseUpdater>`` element."""

    name: ClassVar[str] = "noise"

    initial_value: float = element(original=Original(aliases=("initialNoise",)), minimum=0.0)
    """The standard deviation of the noise in the first level; 1 is the full range of a colour."""
    final_value: float = element(original=Original(aliases=("finalNoise",)), minimum=0.0)
    """The greatest standard deviation of the noise in a level; 1 is the full range of a colour."""

    def bind(self, stage: Stage) -> Setter:
        """Return a setter of the noise of all colour cameras.

        Raises:
            UwsimError: the noise of every camera is that of its electrons.
        """
        stage.set_camera_noise(None)
        return Setter(stage.set_camera_noise)

"""u:seaStateUpdater: waves that grow from level to level.

.. code-block:: xml

    <u:seaStateUpdater>
      <initialValue>0</initialValue> <finalValue>1</finalValue> <step>0.25</step>
      <interval>60</interval>
    </u:seaStateUpdater>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ...schema import element
from ...waves import MAX_HEIGHT
from ...world import Stage
from .sweep import Setter, SweepSpec, step_values


@dataclass(frozen=True, kw_only=True)
class SeaStateUpdaterSpec(SweepSpec):
    """A ``<u:seaStateUpdater>`` element.

    A level scales the amplitudes of all wave systems of the scene by one factor. Their periods,
    directions and phases remain, so that the same waves pass the vehicle at every level. The scene
    has to have waves with a height above 0. Not modelled: the growth of the peak period with the
    height, as in a sea that a stronger wind makes.
    """

    name: ClassVar[str] = "waveHeight"
    unit: ClassVar[str] = "m"

    initial_value: float = element(minimum=0.0, maximum=MAX_HEIGHT)
    """The significant wave height of the first level [m]."""
    final_value: float = element(minimum=0.0, maximum=MAX_HEIGHT)
    """The greatest significant wave height of a level [m]."""

    def values(self) -> tuple[float, ...]:
        """Return the height of each level; the final value is one if whole steps lead to it [m]."""
        return step_values(self.initial_value, self.final_value, self.step)

    def bind(self, stage: Stage) -> Setter:
        """Set the height of the first level, and return a setter; raise UwsimError without waves.

        Returns:
            The setter of the significant wave height of all wave systems together [m].
        """
        stage.water.set_wave_height(self.first_value)
        return Setter(stage.water.set_wave_height)

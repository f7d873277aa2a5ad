"""sceneLightUpdater: light that increases from level to level.

.. code-block:: xml

    <sceneLightUpdater>
      <initialValue>0</initialValue> <finalValue>1.02</finalValue> <step>0.05</step>
      <interval>20</interval>
    </sceneLightUpdater>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ...schema import Original, element
from ...world import Stage
from .sweep import Setter, SweepSpec


@dataclass(frozen=True, kw_only=True)
class SceneLightUpdaterSpec(SweepSpec):
    """A ``<sceneLightUpdater>`` element."""

    name: ClassVar[str] = "light"

    initial_value: float = element(original=Original(aliases=("initialLight",)), minimum=0.0)
    """The light of the first level, as a multiple of the scene's own light."""
    final_value: float = element(original=Original(aliases=("finalLight",)), minimum=0.0)
    """The greatest light of a level, as a multiple of the scene's own light."""

    def bind(self, stage: Stage) -> Setter:
        """Return a setter of the light of the scene."""
        return Setter(stage.set_light_rate)

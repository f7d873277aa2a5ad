"""sceneFogUpdater: fog that thickens from level to level.

.. code-block:: xml

    <sceneFogUpdater>
      <initialValue>0</initialValue> <finalValue>1.3</finalValue> <step>0.05</step>
      <interval>2</interval>
    </sceneFogUpdater>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ...dialect import element
from ...world import Stage
from .updater import SceneUpdater, SceneUpdaterSpec, sweep


@dataclass(frozen=True, kw_only=True)
class SceneFogUpdaterSpec(SceneUpdaterSpec):
    """A ``<sceneFogUpdater>`` element. The number of levels is counted in float32."""

    name: ClassVar[str] = "fog"
    unit: ClassVar[str] = "1/m"

    initial_value: float = element(aliases=("initialFog",), minimum=0.0)
    """Fog density of the first level [1/m]."""
    final_value: float = element(aliases=("finalFog",), minimum=0.0)
    """Fog density that is not exceeded [1/m]."""
    step: float = element(above=0.0)
    """What each level adds [1/m]."""
    interval: float = element(above=0.0)
    """Length of a level [s]."""

    def values(self) -> tuple[float, ...]:
        """Return the fog densities [1/m]."""
        return sweep(self.initial_value, self.final_value, self.step, single=True)

    @property
    def seconds_per_level(self) -> float:
        """The interval [s]."""
        return self.interval

    def bind(self, stage: Stage) -> SceneFogUpdater:
        """Take hold of the water."""
        return SceneFogUpdater(stage)


class SceneFogUpdater(SceneUpdater):
    """Sets the fog of the sea and of every camera."""

    def __init__(self, stage: Stage) -> None:
        self._stage = stage

    def apply(self, value: float) -> None:
        """Set the fog density [1/m]."""
        self._stage.set_fog(value)

"""sceneLightUpdater: light that grows from level to level.

.. code-block:: xml

    <sceneLightUpdater>
      <initialValue>0</initialValue> <finalValue>1.02</finalValue> <step>0.05</step>
      <interval>20</interval>
    </sceneLightUpdater>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ...dialect import element
from ...world import Stage
from .updater import SceneUpdater, SceneUpdaterSpec, sweep


@dataclass(frozen=True, kw_only=True)
class SceneLightUpdaterSpec(SceneUpdaterSpec):
    """A ``<sceneLightUpdater>`` element. The number of levels is counted in float64."""

    name: ClassVar[str] = "light"

    initial_value: float = element(aliases=("initialLight",), minimum=0.0)
    """Light rate of the first level."""
    final_value: float = element(aliases=("finalLight",), minimum=0.0)
    """Light rate that is not exceeded."""
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

    def bind(self, stage: Stage) -> SceneLightUpdater:
        """Take hold of the scene."""
        return SceneLightUpdater(stage)


class SceneLightUpdater(SceneUpdater):
    """Scales the light of the scene."""

    def __init__(self, stage: Stage) -> None:
        self._stage = stage

    def apply(self, value: float) -> None:
        """Set the light rate; 1 is as usual."""
        self._stage.set_light_rate(value)

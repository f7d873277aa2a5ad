"""sceneFogUpdater: fog whose density increases from level to level.

.. code-block:: xml

    <sceneFogUpdater>
      <initialValue>0</initialValue> <finalValue>1.3</finalValue> <step>0.05</step>
      <interval>2</interval>
    </sceneFogUpdater>
"""

from __future__ import annotations

from dataclasses import dataclass

from ...world import Stage
from .fog_sweep import FogSweepSpec
from .sweep import Setter


@dataclass(frozen=True, kw_only=True)
class SceneFogUpdaterSpec(FogSweepSpec):
    """A ``<sceneFogUpdater>`` element."""

    def bind(self, stage: Stage) -> Setter:
        """Return a setter of the fog of the sea and of all cameras."""
        return Setter(lambda value: stage.set_fog(self.density(value)))

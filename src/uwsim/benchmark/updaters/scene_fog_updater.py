"""sceneFogUpdater: fog whose density increases from level to level.

.. code-block:: xml

    <sceneFogUpdater>
      <initialValue>0</initialValue> <finalValue>1.3</finalValue> <step>0.05</step>
      <interval>2</interval>
    </sceneFogUpdater>
"""

from __future__ import annotations

from dataclasses import dataclass

from ...errors import UwsimError
from ...world import Stage
from .fog_sweep import FogSweepSpec
from .sweep import Setter


@dataclass(frozen=True, kw_only=True)
class SceneFogUpdaterSpec(FogSweepSpec):
    """A ``<sceneFogUpdater>`` element."""

    def bind(self, stage: Stage) -> Setter:
        """Return a setter of the fog of the sea and of all cameras.

        Raises:
            UwsimError: the scene has physical water, which has no fog.
        """
        if stage.water.medium is not None:
            raise UwsimError(
                "The scene has physical water, in which fog has no effect; expected "
                "<u:waterUpdater>, or a scene without <u:water>."
            )
        return Setter(lambda value: stage.set_fog(self.density(value)))

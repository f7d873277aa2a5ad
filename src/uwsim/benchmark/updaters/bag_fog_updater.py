"""bagFogUpdater: fog over recorded pictures. Read, not simulated yet.

.. code-block:: xml

    <bagFogUpdater>
      <initialValue>0</initialValue> <finalValue>1</finalValue> <step>0.1</step>
      <interval>20</interval>
      <bag>dive.bag</bag> <imageTopic>camera</imageTopic> <infoTopic>camera_info</infoTopic>
      <imageDepth>2.5</imageDepth>
    </bagFogUpdater>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ...dialect import element
from ...world import Stage
from ..not_simulated import NotSimulatedYet
from .updater import SceneUpdater, SceneUpdaterSpec, sweep


@dataclass(frozen=True, kw_only=True)
class BagFogUpdaterSpec(SceneUpdaterSpec):
    """A ``<bagFogUpdater>`` element. The number of levels is counted in float32."""

    name: ClassVar[str] = "fog"
    unit: ClassVar[str] = "1/m"
    is_simulated: ClassVar[bool] = False

    initial_value: float = element(aliases=("initialFog",), minimum=0.0)
    """Fog density of the first level [1/m]."""
    final_value: float = element(aliases=("finalFog",), minimum=0.0)
    """Fog density that is not exceeded [1/m]."""
    step: float = element(above=0.0)
    """What each level adds [1/m]."""
    interval: float = element(above=0.0)
    """Length of a level [s]."""
    bag: str
    """The recording."""
    image_topic: str
    """Topic of the pictures in the recording."""
    info_topic: str
    """Topic of the camera's info in the recording."""
    image_depth: float = element(above=0.0)
    """Assumed distance of everything in the pictures [m]."""
    image_pub: str | None = element(default=None)
    """Topic the pictures are published on; None: as in the recording."""
    info_pub: str | None = element(default=None)
    """Topic the camera's info is published on; None: as in the recording."""

    def values(self) -> tuple[float, ...]:
        """Return the fog densities [1/m]."""
        return sweep(self.initial_value, self.final_value, self.step, single=True)

    @property
    def seconds_per_level(self) -> float:
        """The interval [s]."""
        return self.interval

    def bind(self, stage: Stage) -> SceneUpdater:
        """Raise NotSimulatedYet."""
        raise NotSimulatedYet("bagFogUpdater")

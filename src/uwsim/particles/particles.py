"""particles: what floats in the water and is seen by cameras.

.. code-block:: xml

    <u:water law="physical">
      <u:type>jerlov-1C</u:type>
      <u:particles> <u:marineSnow/> <u:bubbles/> <u:sediment/> </u:particles>
    </u:water>

Each kind that has no element is absent.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ..errors import BadSetting
from ..schema import Spec, element
from .bubbles import BubblesSpec
from .marine_snow import MarineSnowSpec
from .sediment import SedimentSpec


@dataclass(frozen=True, kw_only=True)
class ParticlesSpec(Spec):
    """A ``<u:particles>``: the particles in the water, and the lens that sees them."""

    marine_snow: MarineSnowSpec | None = element(namespaced=True, default=None)
    """The flocs of marine snow; when absent there are none."""
    bubbles: BubblesSpec | None = element(namespaced=True, default=None)
    """The bubbles; when absent there are none."""
    sediment: SedimentSpec | None = element(namespaced=True, default=None)
    """The loose floor that thrusters stir up; when absent it is hard."""
    range: float = element(namespaced=True, default=8.0, minimum=0.1, maximum=50.0)
    """The range beyond which flocs and bubbles are not drawn [m]."""
    exposure_time: float = element(namespaced=True, default=0.01, minimum=0.0, maximum=1.0)
    """The time during which a particle that moves leaves a streak in the image [s]."""
    aperture: float = element(namespaced=True, default=0.003, minimum=0.0, maximum=0.1)
    """The diameter of the aperture of the lens [m]; with 0 near particles are sharp."""
    focus_distance: float = element(namespaced=True, default=2.0, minimum=0.05, maximum=1000.0)
    """The distance at which the lens is focused [m]."""

    def find_errors(self) -> Iterator[tuple[Spec, str]]:
        """Yield errors of the numbers, each with the spec of its element."""
        for spec in (self.marine_snow, self.bubbles):
            if spec is not None:
                try:
                    spec.divide(lambda: 0)
                except BadSetting as error:
                    yield spec, str(error)

"""constant: a uniform, steady current.

.. code-block:: xml

    <u:constant> <u:velocity> <x>0.2</x> <y>0</y> <z>0</z> </u:velocity> </u:constant>
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array
from ..schema import element
from .current import MAX_SPEED, Current, CurrentSpec, Place, everywhere


@dataclass(frozen=True, kw_only=True)
class ConstantSpec(CurrentSpec):
    """A ``<u:constant>``: the same velocity everywhere and always."""

    velocity: tuple[float, float, float] = element(
        namespaced=True, minimum=-MAX_SPEED, maximum=MAX_SPEED
    )
    """Velocity of the water, in L [m/s]."""

    def bind(self, place: Place) -> Constant:
        """Make the current; it needs nothing of the scene."""
        return Constant(self.velocity)


@dataclass(frozen=True)
class Constant(Current):
    """A uniform, steady velocity; no boundary layer, no turbulence."""

    components: tuple[float, float, float]
    """The velocity of the water, in L [m/s]."""

    @property
    def is_uniform(self) -> bool:
        """Whether it is the same everywhere."""
        return True

    @property
    def is_steady(self) -> bool:
        """Whether it is the same at all times: yes."""
        return True

    @property
    def is_still(self) -> bool:
        """Whether its velocity is zero."""
        return not any(self.components)

    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water, in L, (n, 3) [m/s]."""
        return everywhere(points, *self.components)

    def acceleration(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return zeros, (n, 3) [m/s2]."""
        return np.zeros((len(points), 3))

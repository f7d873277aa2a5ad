r"""position: on as soon as a body comes near a place.

.. code-block:: xml

    <stopOn>
      <type>position</type> <target>girona500</target>
      <position> <x>2</x> <y>0</y> <z>2.5</z> </position>
    </stopOn>
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...base.numerics.linear import length
from ...schema import element
from ...world import Body, World
from .on_move import threshold
from .trigger import Trigger, TriggerSpec

NEAR = 0.3
"""How near counts as being there [m]."""


@dataclass(frozen=True, kw_only=True)
class PositionSpec(TriggerSpec):
    """A trigger of type ``position``."""

    target: str = element(refers_to="body")
    """Route of the body to watch."""
    position: tuple[float, float, float]
    """The place, in L [m]."""

    def bind(self, world: World) -> Position:
        """Watch the target; raises UnknownName if it is not there."""
        place = world.world_from_localized.transform(np.array([self.position]))[0]  # (3,) [m] W
        return Position(world.body(self.target), place, threshold(NEAR, world))


class Position(Trigger):
    r"""On, for good, once :math:`\lVert p - q \rVert < 0.3` m for the body's origin :math:`p`.

    The position :math:`q` is given in L, as all positions in files. (The original means the
    same, but converts it with the wrong numbers.)
    """

    def __init__(self, body: Body, place: npt.NDArray[np.float64], distance: float) -> None:
        self._body, self._place, self._distance = body, place, distance
        self._was_there = False

    def is_on(self) -> bool:
        """Whether the body has been there."""
        if not self._was_there:
            way = self._body.world_from_body.position - self._place
            self._was_there = length(way) < self._distance
        return self._was_there

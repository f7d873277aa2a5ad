r"""position: a trigger that turns on as soon as a body comes near a position.

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

NEAR_DISTANCE = 0.3
"""The distance below which a body is at the position [m]."""


@dataclass(frozen=True, kw_only=True)
class PositionSpec(TriggerSpec):
    """A trigger of type ``position``."""

    target: str = element(refers_to="body")
    """The route of the body."""
    position: tuple[float, float, float]
    """The position, in the localized world frame L [m]."""

    def bind(self, world: World) -> Position:
        """Resolve the target; raises UnknownName if there is none."""
        goal = world.world_from_localized.transform(np.array([self.position]))[0]  # (3,) [m] W
        return Position(world.body(self.target), goal, threshold(NEAR_DISTANCE, world))


class Position(Trigger):
    r"""A trigger that turns on, for good, once a body is within 0.3 m of a position.

    It is on from the step at which :math:`\lVert p - q \rVert < 0.3` m for the body's origin
    :math:`p`. The position :math:`q` is given in L, as are all positions in files. (The original
    UWSim intends the same, but its conversion from L to the world frame is wrong.)
    """

    def __init__(self, body: Body, goal: npt.NDArray[np.float64], distance: float) -> None:
        self._body, self._goal, self._distance = body, goal, distance
        self._was_near = False

    def is_on(self) -> bool:
        """Return whether the body has been at the position."""
        if not self._was_near:
            displacement = self._body.world_from_body.position - self._goal
            self._was_near = length(displacement) < self._distance
        return self._was_near

r"""onMove: a trigger that turns on as soon as a body has moved.

.. code-block:: xml

    <startOn> <type>onMove</type> <target>girona500</target> </startOn>
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...base.numerics.linear import length
from ...schema import element
from ...world import Body, World
from .trigger import Trigger, TriggerSpec

MOVED_DISTANCE = 0.2
"""The distance after which a body counts as moved [m]."""


def threshold(length: float, world: World) -> float:
    """Return a threshold of distance: ``length`` [m], or its square root (see below).

    The original UWSim compares the *square* of a distance with its constants, so that 0.2 acts as
    0.447 m and 0.3 as 0.548 m. The compatibility ``thresholds`` reproduces this by the root.
    """
    return float(np.sqrt(length)) if "thresholds" in world.compatibility else length


@dataclass(frozen=True, kw_only=True)
class OnMoveSpec(TriggerSpec):
    """A trigger of type ``onMove``."""

    target: str = element(refers_to="body")
    """The route of the body."""

    def bind(self, world: World) -> OnMove:
        """Store the position of the target; raises UnknownName if there is none."""
        return OnMove(world.body(self.target), threshold(MOVED_DISTANCE, world))


class OnMove(Trigger):
    r"""A trigger that turns on, for good, once :math:`\lVert p - p_0 \rVert > 0.2` m.

    :math:`p` is the position of the body's origin and :math:`p_0` its position when the trigger is
    bound. Rotation does not count.
    """

    def __init__(self, body: Body, distance: float) -> None:
        self._body, self._distance = body, distance
        self._start_position = body.world_from_body.position  # (3,) [m]
        self._has_moved = False

    def is_on(self) -> bool:
        """Return whether the body has been far enough from its start position."""
        if not self._has_moved:
            displacement = self._body.world_from_body.position - self._start_position
            self._has_moved = length(displacement) > self._distance
        return self._has_moved

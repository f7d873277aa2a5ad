r"""onMove: on as soon as a body has moved.

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

MOVED = 0.2
"""How far a body goes before it counts as moved [m]."""


def threshold(length: float, world: World) -> float:
    """Return ``length`` [m], or its root under the quirk ``thresholds``.

    The original compares the *square* of a distance with these constants, so 0.2 acts as
    0.447 m and 0.3 as 0.548 m (compatibility ``thresholds``).
    """
    return float(np.sqrt(length)) if "thresholds" in world.compatibility else length


@dataclass(frozen=True, kw_only=True)
class OnMoveSpec(TriggerSpec):
    """A trigger of type ``onMove``."""

    target: str = element(refers_to="body")
    """Route of the body to watch."""

    def bind(self, world: World) -> OnMove:
        """Remember where the target is; raises UnknownName if it is not there."""
        return OnMove(world.body(self.target), threshold(MOVED, world))


class OnMove(Trigger):
    r"""On, for good, once :math:`\lVert p - p_0 \rVert > 0.2` m.

    :math:`p_0` is where the body's origin was when the trigger was bound; rotation never counts.
    """

    def __init__(self, body: Body, distance: float) -> None:
        self._body, self._distance = body, distance
        self._from = body.world_from_body.position  # (3,) [m]
        self._has_moved = False

    def is_on(self) -> bool:
        """Whether the body has been far enough from its start."""
        if not self._has_moved:
            way = self._body.world_from_body.position - self._from
            self._has_moved = length(way) > self._distance
        return self._has_moved

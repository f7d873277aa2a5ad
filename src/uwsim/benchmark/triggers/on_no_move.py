r"""onNoMove: on as soon as a body has not moved for 4 s.

.. code-block:: xml

    <stopOn> <type>onNoMove</type> <target>girona500</target> </stopOn>
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...base.numerics.linear import length
from ...schema import element
from ...world import Body, World
from .on_move import MOVED, threshold
from .trigger import Trigger, TriggerSpec

STILL_FOR = 4.0
"""Time without motion after which the trigger is on [s]."""
N_SAMPLES = 10
"""Looks at its position within that time."""


@dataclass(frozen=True, kw_only=True)
class OnNoMoveSpec(TriggerSpec):
    """A trigger of type ``onNoMove``."""

    target: str = element(refers_to="body")
    """Route of the body to watch."""

    def bind(self, world: World) -> OnNoMove:
        """Watch the target; raises UnknownName if it is not there."""
        return OnNoMove(world, world.body(self.target), threshold(MOVED, world))


class OnNoMove(Trigger):
    """On, for good, once a body has stayed within 0.2 m for more than 4 s.

    Its position is remembered every 0.4 s. At every step the oldest memories that are farther
    than 0.2 m from where it is now are forgotten; on when the oldest left is older than 4 s.
    """

    def __init__(self, world: World, body: Body, distance: float) -> None:
        self._world, self._body, self._distance = world, body, distance
        self._memories: deque[tuple[int, npt.NDArray[np.float64]]] = deque()
        self._period = max(1, round(STILL_FOR / N_SAMPLES / world.timestep))  # [steps]
        self._still_steps = round(STILL_FOR / world.timestep)
        self._next = world.step
        self._is_on = False
        self._look()

    def is_on(self) -> bool:
        """Whether the body has not moved for long enough."""
        if not self._is_on:
            self._look()
        return self._is_on

    def _look(self) -> None:
        step, position = self._world.step, self._body.world_from_body.position
        while self._memories and self._is_far(self._memories[0][1], position):
            self._memories.popleft()
        if step >= self._next:
            self._memories.append((step, position))
            self._next = step + self._period
        self._is_on = bool(self._memories) and step - self._memories[0][0] > self._still_steps

    def _is_far(self, before: npt.NDArray[np.float64], now: npt.NDArray[np.float64]) -> bool:
        return length(now - before) > self._distance

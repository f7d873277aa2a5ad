r"""onNoMove: a trigger that turns on as soon as a body has not moved for 4 s.

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
from .on_move import MOVED_DISTANCE, threshold
from .trigger import Trigger, TriggerSpec

STILL_TIME = 4.0
"""The time without motion after which the trigger is on [s]."""
N_SAMPLES = 10
"""The number of samples of the position within `STILL_TIME`."""


@dataclass(frozen=True, kw_only=True)
class OnNoMoveSpec(TriggerSpec):
    """A trigger of type ``onNoMove``."""

    target: str = element(refers_to="body")
    """The route of the body."""

    def bind(self, world: World) -> OnNoMove:
        """Resolve the target; raises UnknownName if there is none."""
        return OnNoMove(world, world.body(self.target), threshold(MOVED_DISTANCE, world))


class OnNoMove(Trigger):
    """A trigger that turns on, for good, once a body has stayed within 0.2 m for more than 4 s.

    The position of the body is stored every 0.4 s. At every step, stored positions are discarded,
    the oldest first, until one is within 0.2 m of the present position. The trigger turns on when
    the oldest position that remains is older than 4 s.
    """

    def __init__(self, world: World, body: Body, distance: float) -> None:
        self._world, self._body, self._distance = world, body, distance
        self._positions: deque[tuple[int, npt.NDArray[np.float64]]] = deque()
        self._period = max(1, round(STILL_TIME / N_SAMPLES / world.timestep))  # [steps]
        self._n_still_steps = round(STILL_TIME / world.timestep)
        self._next_sample = world.step
        self._is_on = False
        self._update()

    def is_on(self) -> bool:
        """Return whether the body has not moved for long enough."""
        if not self._is_on:
            self._update()
        return self._is_on

    def _update(self) -> None:
        step, position = self._world.step, self._body.world_from_body.position
        while self._positions and self._is_far(self._positions[0][1], position):
            self._positions.popleft()
        if step >= self._next_sample:
            self._positions.append((step, position))
            self._next_sample = step + self._period
        self._is_on = bool(self._positions) and step - self._positions[0][0] > self._n_still_steps

    def _is_far(self, start: npt.NDArray[np.float64], end: npt.NDArray[np.float64]) -> bool:
        return length(end - start) > self._distance

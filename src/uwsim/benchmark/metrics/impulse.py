r"""The largest impulse of a force within a short time.

.. math:: J = \max_t \Bigl\lVert \int_{t-T}^{t} F\, dt \Bigr\rVert, \qquad T = 50\,\mathrm{ms}

A hit of two bodies lasts about 40 ms in the soft contacts of the engine, so T holds all of one.
Unlike the peak of the force, the impulse does not depend on the softness or the step.
"""

from __future__ import annotations

import math
from collections import deque

from ...base.geometry import ZERO, Array, Triple
from ...base.numerics.linear import length

WINDOW = 0.05
"""[s]"""


class Impulse:
    """Follows a force from step to step."""

    def __init__(self, timestep: float) -> None:
        self._timestep = timestep
        self._forces: deque[Triple] = deque(maxlen=max(1, round(WINDOW / timestep)))
        self._n_idle = 0
        self.largest = 0.0
        """[N s]"""
        self.now = 0.0
        """Size of the force in the last step [N]."""

    def add(self, force: Array | None) -> None:
        """Take the force of one more step, (3,) [N]; None: none."""
        if force is None:
            self.now = 0.0
            self._n_idle += 1
            if self._n_idle >= (self._forces.maxlen or 1):
                self._forces.clear()
            elif self._forces:
                self._forces.append(ZERO)
            return
        self.now = length(force)
        self._n_idle = 0
        x, y, z = force.tolist()
        self._forces.append((x, y, z))
        x = y = z = 0.0  # plain floats: a few numbers at every step are dearer as arrays
        for one in self._forces:
            x, y, z = x + one[0], y + one[1], z + one[2]
        x, y, z = x * self._timestep, y * self._timestep, z * self._timestep
        self.largest = max(self.largest, math.sqrt(x * x + y * y + z * z))

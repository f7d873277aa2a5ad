r"""The largest impulse of a force within a short time.

.. math:: J = \max_t \Bigl\lVert \int_{t-T}^{t} F\, dt \Bigr\rVert, \qquad T = 50\,\mathrm{ms}

In the soft contacts of the physics engine a collision lasts about 40 ms, so a window of the length
T contains all of it. Unlike the largest force, the impulse depends neither on the stiffness of the
contacts nor on the length of a step.
"""

from __future__ import annotations

import math
from collections import deque

from ...base.geometry import ZERO, Array, Triple
from ...base.numerics.linear import length

WINDOW_LENGTH = 0.05
"""The length of the window T [s]."""


class Impulse:
    """The largest impulse of a force that is sampled at every step.

    Args:
        timestep: the length of a step [s].
    """

    def __init__(self, timestep: float) -> None:
        self._timestep = timestep
        self._forces: deque[Triple] = deque(maxlen=max(1, round(WINDOW_LENGTH / timestep)))
        self._n_idle = 0  # steps since the last force
        self.peak = 0.0
        """The largest impulse so far [N s]."""
        self.force = 0.0
        """The magnitude of the force in the last step [N]."""

    def add(self, force: Array | None) -> None:
        """Add the force of one more step, (3,) [N]; None: no force."""
        if force is None:
            self.force = 0.0
            self._n_idle += 1
            if self._n_idle >= (self._forces.maxlen or 1):
                self._forces.clear()
            elif self._forces:
                self._forces.append(ZERO)
            return
        self.force = length(force)
        self._n_idle = 0
        x, y, z = force.tolist()
        self._forces.append((x, y, z))
        x = y = z = 0.0  # plain floats: a few numbers at every step cost more as arrays
        for window_force in self._forces:
            x, y, z = x + window_force[0], y + window_force[1], z + window_force[2]
        x, y, z = x * self._timestep, y * self._timestep, z * self._timestep
        self.peak = max(self.peak, math.sqrt(x * x + y * y + z * z))

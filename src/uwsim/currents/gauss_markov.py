r"""gaussMarkov: a current that is a Gauss-Markov process about a mean.

.. code-block:: xml

    <u:gaussMarkov>
      <u:mean> <x>0.2</x> <y>0</y> <z>0</z> </u:mean>
      <u:deviation> <x>0.03</x> <y>0.03</y> <z>0</z> </u:deviation>
      <u:mu>0.02</u:mu>
    </u:gaussMarkov>
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array, Triple
from ..schema import element
from .current import MAX_SPEED, Current, CurrentSpec, Place, everywhere
from .random_table import Draws


@dataclass(frozen=True, kw_only=True)
class GaussMarkovSpec(CurrentSpec):
    """A ``<u:gaussMarkov>``: a first-order Gauss-Markov process about a mean."""

    mean: Triple = element(
        namespaced=True, default=(0.0, 0.0, 0.0), minimum=-MAX_SPEED, maximum=MAX_SPEED
    )
    """What the velocity returns to, in L [m/s]."""
    deviation: Triple = element(namespaced=True, minimum=0.0, maximum=MAX_SPEED)
    """Standard deviation of the velocity along each axis of L [m/s]."""
    mu: float = element(namespaced=True, above=0)
    """How fast it returns; 1/mu is the correlation time [1/s]."""
    step: float = element(namespaced=True, default=0.05, minimum=0.001)
    """Distance of the times at which it is drawn; between them it runs straight [s]."""

    def bind(self, place: Place) -> GaussMarkov:
        """Take the stream ``current``."""
        return GaussMarkov(self, Draws(place.stream("current").standard_normal, 3))


class GaussMarkov(Current):
    r"""A first-order Gauss-Markov process, the same everywhere.

    .. math:: \dot x + \mu x = w, \quad v = \bar v + x

    along each axis (Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control, section
    10.7), with white noise w of such a strength that the standard deviation of x is
    ``deviation``. It is solved exactly at the times :math:`k h`,

    .. math:: x_{k+1} = e^{-\mu h} x_k + \sigma \sqrt{1 - e^{-2 \mu h}}\; n_k,
        \quad n_k \sim N(0, 1)

    and begins in its stationary state, so neither deviation nor correlation depends on h. Between
    two times it runs straight, which takes a share of about :math:`\mu h / 3` of the variance.
    (Adding ``amplitude * uniform`` at every step, as some simulators do, makes both depend on it.)

    The process has no derivative: the slope of the pieces grows as :math:`1/\sqrt{h}` and says
    nothing of the water. So it exerts no inertial force, drag alone.

    Not modelled: any change with place; correlation between axes; limits to the speed.
    """

    def __init__(self, spec: GaussMarkovSpec, draws: Draws) -> None:
        self._spec, self._draws = spec, draws
        self._keep = math.exp(-spec.mu * spec.step)
        self._stir = math.sqrt(-math.expm1(-2.0 * spec.mu * spec.step))
        self._states = [draws.row(0)]  # of unit variance, at k * step, (k, 3)

    @property
    def is_uniform(self) -> bool:
        """Whether it is the same everywhere."""
        return True

    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water, in L, (n, 3) [m/s]."""
        here, after, fraction = self._around(time)
        spec = self._spec
        x, y, z = (
            mean + sigma * (a + (b - a) * fraction)
            for mean, sigma, a, b in zip(spec.mean, spec.deviation, here, after, strict=True)
        )
        return everywhere(points, x, y, z)

    def acceleration(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return zeros, (n, 3) [m/s2]: it has no derivative, and that of its pieces is not one."""
        return np.zeros((len(points), 3))

    def _around(self, time: float) -> tuple[list[float], list[float], float]:
        """The states before and after ``time``, and how far it is from one to the other."""
        at = max(0.0, time) / self._spec.step
        k = math.floor(at + 1e-6)
        while len(self._states) < k + 2:
            noise = self._draws.row(len(self._states))
            last = self._states[-1]
            self._states.append(
                [self._keep * x + self._stir * n for x, n in zip(last, noise, strict=True)]
            )
        return self._states[k], self._states[k + 1], max(0.0, at - k)

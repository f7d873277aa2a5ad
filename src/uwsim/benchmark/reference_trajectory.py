r"""The place at which a body should be at each time: ``<trajectory>``.

.. code-block:: xml

    <trajectory>
      <shape>helix</shape> <centre> <x>0</x> <y>0</y> <z>2</z> </centre>
      <radius>1</radius> <period>20</period> <rise>0.4</rise>
    </trajectory>

With the phase :math:`\varphi = 2 \pi t / T` at the simulation time t, the centre c, the radius r
and the rise h, the position is

.. math::

    \text{circle, helix:} \quad & c + (r \cos\varphi,\ r \sin\varphi,\ h \varphi / 2 \pi) \\
    \text{lemniscate:} \quad & c + (r \cos\varphi,\ r \sin\varphi \cos\varphi,\ h \varphi / 2 \pi)

The lemniscate is that of Gerono. A point is at c. A square has its corners at
:math:`c + (\pm r, \pm r, 0)`; the place moves from the corner :math:`(r, r)` towards
:math:`(-r, r)`, at the constant speed :math:`8 r / T`. The axes are those of the scene file, L.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..base.geometry import Array
from ..schema import Spec, element

SHAPES = ("point", "circle", "helix", "lemniscate", "square")
"""The shapes of trajectories."""
CORNERS = np.array([(1.0, 1.0, 0.0), (-1.0, 1.0, 0.0), (-1.0, -1.0, 0.0), (1.0, -1.0, 0.0)])
"""The corners of a square of half a side's length 1, in their order, (4, 3)."""


@dataclass(frozen=True, kw_only=True)
class TrajectorySpec(Spec):
    """A ``<trajectory>`` element: a place that moves with time."""

    shape: Literal["point", "circle", "helix", "lemniscate", "square"]
    """The shape of the path."""
    centre: tuple[float, float, float]
    """The centre of the path, or the point, in the localized world frame L [m]."""
    radius: float = element(default=0.0, minimum=0.0)
    """The radius, or half the length of a lemniscate or of a side of a square [m]."""
    period: float = element(default=20.0, exclusive_minimum=0.0)
    """The time of one turn [s]."""
    rise: float = element(default=0.0)
    """The distance along z that a helix moves in one turn [m]; z points down in most scenes."""

    def errors(self) -> Sequence[str]:
        """Return errors of numbers that do not fit the shape."""
        if self.shape != "point" and self.radius == 0.0:
            return [f"<radius> is 0; a {self.shape} needs a radius > 0 [m]"]
        if self.shape == "point" and self.radius:
            return ["<radius> is not that of a point; choose another <shape>"]
        if self.shape != "helix" and self.rise:
            return [f"<rise> is that of a helix, and the <shape> is {self.shape}"]
        return []

    def position(self, time: float | Array) -> Array:
        """Return the position at a time [s], in L, (3,) [m]; rows of them for times (n,)."""
        if self.shape == "point":
            return np.array(self.centre) + np.zeros((*np.shape(time), 3))
        if self.shape == "square":
            corners, directions, share = self._sides(time)
            offset = self.radius * (corners + 2.0 * share[..., np.newaxis] * directions)
            place: Array = np.array(self.centre) + offset
            return place
        phase = 2.0 * math.pi * np.asarray(time) / self.period
        cosine, sine = np.cos(phase), np.sin(phase)
        breadth = sine * cosine if self.shape == "lemniscate" else sine
        climb = self.rise * np.asarray(time) / self.period
        offset = np.stack([self.radius * cosine, self.radius * breadth, climb], axis=-1)
        position: Array = np.array(self.centre) + offset
        return position

    def velocity(self, time: float | Array) -> Array:
        """Return the velocity at a time [s], in L, (3,) [m/s]; rows of them for times (n,)."""
        if self.shape == "point":
            return np.zeros((*np.shape(time), 3))
        if self.shape == "square":
            velocity: Array = 8.0 * self.radius / self.period * self._sides(time)[1]
            return velocity
        rate = 2.0 * math.pi / self.period
        phase = rate * np.asarray(time)
        cosine, sine = np.cos(phase), np.sin(phase)
        breadth = cosine * cosine - sine * sine if self.shape == "lemniscate" else cosine
        speed, climb = self.radius * rate, np.full(np.shape(time), self.rise / self.period)
        return np.stack([-speed * sine, speed * breadth, climb], axis=-1)

    def _sides(self, time: float | Array) -> tuple[Array, Array, Array]:
        """Return the side of a square at a time [s]: its first corner, direction, and the share."""
        quarters = 4.0 * np.mod(np.asarray(time, dtype=np.float64) / self.period, 1.0)
        sides = np.minimum(quarters.astype(np.int64), 3)
        return (
            CORNERS[sides],
            CORNERS[(sides + 1) % 4] / 2.0 - CORNERS[sides] / 2.0,
            quarters - sides,
        )

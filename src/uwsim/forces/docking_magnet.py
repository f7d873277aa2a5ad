r"""dockingMagnet: the attraction of two magnets, each on a body.

.. code-block:: xml

    <u:dockingMagnet> <name>latch</name> <closest>0.04</closest>
      <first> <body>girona500/base_link</body>
        <position> <x>0.8</x> <y>0</y> <z>0</z> </position>
        <moment> <x>50</x> <y>0</y> <z>0</z> </moment> </first>
      <second> <body>dock</body>
        <moment> <x>50</x> <y>0</y> <z>0</z> </moment> </second>
    </u:dockingMagnet>
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..base.geometry import ZERO, Array, Triple
from ..base.numerics.linear import cross, dot, rotate
from ..schema import MAX_DISTANCE, Spec, element
from ..world import Attachment, ForceWorld
from .force import Force, ForceSpec

MAGNETIC_CONSTANT = 1e-7
"""The vacuum permeability by 4 pi [N/A2]; water has the same to 1e-5."""
MAX_MOMENT = 1e5
"""The greatest magnetic moment: that of 0.1 m3 of neodymium [A m2]."""


@dataclass(frozen=True, kw_only=True)
class MagnetSpec(Spec):
    """A magnet of a ``<u:dockingMagnet>``."""

    body: str = element(refers_to="body")
    """A vehicle (its base), a link ``vehicle/link``, or an object."""
    position: Triple = element(default=ZERO, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """The middle of the magnet in the frame of the body [m]."""
    moment: Triple = element(minimum=-MAX_MOMENT, maximum=MAX_MOMENT)
    """The magnetic moment, from the south to the north pole, in the axes of the body [A m2]."""


@dataclass(frozen=True, kw_only=True)
class DockingMagnetSpec(ForceSpec):
    """A ``<u:dockingMagnet>``: two magnets, which pull and turn each other."""

    first: MagnetSpec
    """One magnet."""
    second: MagnetSpec
    """The other magnet."""
    closest: float = element(above=0.0, maximum=100.0)
    """The distance of the middles of the magnets when they touch; nearer, the force grows no more
    [m]."""

    def bind(self, world: ForceWorld) -> DockingMagnet:
        """Find both bodies; raises UnknownName if one is missing."""
        return DockingMagnet(
            world.attach(self.first.body, self.first.position),
            world.attach(self.second.body, self.second.position),
            np.array([self.first.moment, self.second.moment]),
            self.closest,
        )


class DockingMagnet(Force):
    r"""Two magnetic dipoles.

    With the moments :math:`m_1, m_2`, the distance r of the magnets and its direction u from the
    first to the second, the force on the second and the torques are

    .. math:: F &= \frac{3 \mu_0}{4 \pi r^4} \left( (m_1 u) m_2 + (m_2 u) m_1 + (m_1 m_2) u
        - 5 (m_1 u)(m_2 u) u \right) \\
        \tau_i &= m_i \times B_j, \qquad B_j = \frac{\mu_0}{4 \pi r^3} (3 (m_j u) u - m_j)

    (Yung, Landecker, Villani, An Analytic Solution for the Force Between Two Magnetic Dipoles,
    Magnetic and Electrical Separation 9, 1998; Jackson, Classical Electrodynamics, 3rd ed., 5.56).
    The first gets -F. These torques and the couple of both forces add up to nothing.

    It is exact for balls that are magnetised evenly, down to their contact (Edwards, Riffe, Ji,
    Booth, Interactions between uniformly magnetized spheres, American Journal of Physics 85, 2017).
    For other magnets of a size d it is right at distances of several d. Nearer than ``closest``
    force and torque are those at that distance; the torques take up the shorter lever by halves, so
    that the balance remains. At a distance of 0, where there is no direction, nothing acts.

    Not modelled: soft iron and other magnets nearby, the shape of magnets at contact, moments that
    change with temperature or an opposing field, electromagnets that are switched, eddy currents in
    hulls and sea water, the field of the Earth.
    """

    def __init__(
        self, first: Attachment, second: Attachment, moments: Array, closest: float
    ) -> None:
        self._first, self._second = first, second
        self._moments = moments  # (2, 3) [A m2], each in the axes of its body
        self._closest = closest

    def wrenches(self, time: float) -> tuple[tuple[Attachment, Array], tuple[Attachment, Array]]:
        """Return the wrenches on both bodies, each about its magnet, in W."""
        one, other = self._first.world_from_body, self._second.world_from_body
        on_first, on_second = dipole_wrenches(
            rotate(one.rotation, self._moments[0]),
            rotate(other.rotation, self._moments[1]),
            other.position - one.position,
            self._closest,
        )
        return (self._first, on_first), (self._second, on_second)


def dipole_wrenches(first: Array, second: Array, way: Array, closest: float) -> tuple[Array, Array]:
    """Compute the wrenches on two dipoles, each about its own place, (6,) [N, N m].

    Args:
        first: moment of the first, (3,) [A m2].
        second: moment of the second, in the same axes.
        way: from the first to the second, (3,) [m].
        closest: the distance below which the law of this distance holds [m].
    """
    distance = math.sqrt(dot(way, way))
    if distance == 0.0:
        return np.zeros(6), np.zeros(6)
    u, r = way / distance, max(distance, closest)
    along_first, along_second = dot(first, u), dot(second, u)
    field = MAGNETIC_CONSTANT / (r * r * r)
    force = (3.0 * field / r) * (
        along_first * second
        + along_second * first
        + (dot(first, second) - 5.0 * along_first * along_second) * u
    )
    on_first = field * cross(first, 3.0 * along_second * u - second)
    on_second = field * cross(second, 3.0 * along_first * u - first)
    shorter = 0.5 * (r - distance) * cross(u, force)
    return (
        np.concatenate([-force, on_first + shorter]),
        np.concatenate([force, on_second + shorter]),
    )

r"""dockingMagnet: the force and torque between two magnets, each fixed to a body.

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
"""The vacuum permeability divided by 4 pi [N/A2]; the permeability of water differs by 1e-5 of it.
"""
MAX_MOMENT = 1e5
"""The largest component of a magnetic moment, as of a neodymium magnet of 0.1 m3 [A m2]."""


@dataclass(frozen=True, kw_only=True)
class MagnetSpec(Spec):
    """A magnet of a ``<u:dockingMagnet>``."""

    body: str = element(refers_to="body")
    """The body that carries the magnet: a vehicle (its base), ``vehicle/link``, or an object."""
    position: Triple = element(default=ZERO, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """The centre of the magnet in the frame of the body [m]."""
    moment: Triple = element(minimum=-MAX_MOMENT, maximum=MAX_MOMENT)
    """The magnetic moment, from the south to the north pole, in the axes of the body [A m2]."""


@dataclass(frozen=True, kw_only=True)
class DockingMagnetSpec(ForceSpec):
    """A ``<u:dockingMagnet>``: two magnets that exert forces and torques on each other."""

    first: MagnetSpec
    """The first magnet."""
    second: MagnetSpec
    """The second magnet."""
    closest: float = element(exclusive_minimum=0.0, maximum=100.0)
    """The distance between the centres of the magnets when they touch [m]. At smaller distances the
    force does not grow."""

    def bind(self, world: ForceWorld) -> DockingMagnet:
        """Resolve the names of both bodies; raise UnknownName if one is missing."""
        return DockingMagnet(
            world.attach(self.first.body, self.first.position),
            world.attach(self.second.body, self.second.position),
            np.array([self.first.moment, self.second.moment]),
            self.closest,
        )


class DockingMagnet(Force):
    r"""The force and the torques between two magnetic dipoles.

    With the moments :math:`m_1, m_2`, the distance r between the magnets, and the unit vector u
    from the first magnet to the second, the force F on the second magnet and the torque
    :math:`\tau_i` on each magnet in the field :math:`B_j` of the other are

    .. math:: F &= \frac{3 \mu_0}{4 \pi r^4} \left( (m_1 u) m_2 + (m_2 u) m_1 + (m_1 m_2) u
        - 5 (m_1 u)(m_2 u) u \right) \\
        \tau_i &= m_i \times B_j, \qquad B_j = \frac{\mu_0}{4 \pi r^3} (3 (m_j u) u - m_j)

    (Yung, Landecker, Villani, An Analytic Solution for the Force Between Two Magnetic Dipoles,
    Magnetic and Electrical Separation 9, 1998; Jackson, Classical Electrodynamics, 3rd ed., 5.56).
    The force on the first magnet is -F. These torques and the couple of both forces add up to 0.

    The law is exact for uniformly magnetised spheres, down to their contact (Edwards, Riffe, Ji,
    Booth, Interactions between uniformly magnetized spheres, American Journal of Physics 85, 2017).
    For other magnets of size d it is accurate at distances of several d. At distances below
    ``r_min``, forces and torques have their values at ``r_min``. The lever arm of the forces is
    shorter there; half of the missing couple is added to each torque, so the sum of all moments
    remains 0. At a distance of 0, where u is undefined, the wrenches are 0.

    Not modelled: soft iron and other magnets nearby, the shape of magnets at contact, moments that
    change with temperature or an opposing field, electromagnets that are switched, eddy currents in
    hulls and sea water, the field of the Earth.
    """

    def __init__(
        self, magnet_1: Attachment, magnet_2: Attachment, moments: Array, r_min: float
    ) -> None:
        self._magnet_1, self._magnet_2 = magnet_1, magnet_2
        self._moments = moments  # (2, 3) [A m2], each in the axes of its body
        self._r_min = r_min

    def wrenches(self, time: float) -> tuple[tuple[Attachment, Array], tuple[Attachment, Array]]:
        """Return the wrenches on both bodies in W, each about the centre of its magnet."""
        pose_1, pose_2 = self._magnet_1.world_from_body, self._magnet_2.world_from_body
        on_first, on_second = dipole_wrenches(
            rotate(pose_1.rotation, self._moments[0]),
            rotate(pose_2.rotation, self._moments[1]),
            pose_2.position - pose_1.position,
            self._r_min,
        )
        return (self._magnet_1, on_first), (self._magnet_2, on_second)


def dipole_wrenches(m_1: Array, m_2: Array, r_12: Array, r_min: float) -> tuple[Array, Array]:
    """Compute the wrench on each of two dipoles about its own position, (6,) [N, N m].

    All vectors are in the same axes.

    Args:
        m_1: the magnetic moment of the first dipole, (3,) [A m2].
        m_2: the magnetic moment of the second dipole, (3,) [A m2].
        r_12: the vector from the first dipole to the second, (3,) [m].
        r_min: the distance below which forces and torques do not grow [m].
    """
    distance = math.sqrt(dot(r_12, r_12))
    if distance == 0.0:
        return np.zeros(6), np.zeros(6)
    u, r = r_12 / distance, max(distance, r_min)
    m_1u, m_2u = dot(m_1, u), dot(m_2, u)
    field = MAGNETIC_CONSTANT / (r * r * r)
    force = (3.0 * field / r) * (m_1u * m_2 + m_2u * m_1 + (dot(m_1, m_2) - 5.0 * m_1u * m_2u) * u)
    torque_1 = field * cross(m_1, 3.0 * m_2u * u - m_2)
    torque_2 = field * cross(m_2, 3.0 * m_1u * u - m_1)
    couple = 0.5 * (r - distance) * cross(u, force)
    return (
        np.concatenate([-force, torque_1 + couple]),
        np.concatenate([force, torque_2 + couple]),
    )

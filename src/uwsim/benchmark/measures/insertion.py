r"""u:insertion: how deep a plug is in a socket, and the force between them.

.. code-block:: xml

    <u:insertion>
      <name>depth</name>
      <plug>girona500/plug</plug> <tip> <x>0</x> <y>0</y> <z>0.12</z> </tip>
      <socket>socket</socket> <mouth> <x>0</x> <y>0</y> <z>0.14</z> </mouth>
      <radius>0.03</radius>
    </u:insertion>
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...base.numerics import elementwise
from ...base.numerics.linear import length
from ...schema import element
from ...world import World
from ..metrics.relative_pose import RelativePose
from .measure import Measure, MeasureSpec


@dataclass(frozen=True, kw_only=True)
class InsertionSpec(MeasureSpec):
    """A ``<u:insertion>`` element of a benchmark file."""

    columns: ClassVar[tuple[str, ...]] = ("force",)

    plug: str = element(refers_to="body")
    """The route of the plug: a link of a vehicle, or an object, whose z axis points to its tip."""
    tip: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The tip of the plug, in its frame [m]."""
    socket: str = element(refers_to="contacts")
    """The name of the socket, an object whose z axis points out of its hole."""
    mouth: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The centre of the mouth of the hole, in the frame of the socket [m]."""
    radius: float = element(default=0.03, exclusive_minimum=0.0)
    """The distance from the axis of the hole within which the depth counts [m]."""
    window: float = element(default=0.05, exclusive_minimum=0.0)
    """The time over which the force is averaged [s]."""

    def bind(self, world: World) -> Insertion:
        """Resolve both bodies; raises UnknownName if one is unknown."""
        plug, socket = world.body(self.plug), world.body(self.socket)
        world.contacts(self.socket)
        return Insertion(self, world, RelativePose(socket, plug, self.mouth, self.tip))


class Insertion(Measure):
    r"""The depth of the tip of a plug below the mouth of a socket.

    .. math:: d = \max(0, -z) \text{ if } \sqrt{x^2 + y^2} \le r, \text{ else } 0

    with the position (x, y, z) of the tip from the mouth, in the axes of the socket. ``force`` is
    the size of the sum of the contact forces on the socket, averaged over ``window``; a contact of
    one step counts as little as it moves bodies. ``tilt`` is the angle between the axes of plug and
    socket. Not part of the measure: latching, electrical contact, and the rotation about the axis.
    """

    unit = "m"
    detail_units: ClassVar[Mapping[str, str]] = {
        "greatest": "m",
        "offset": "m",
        "tilt": "rad",
        "force": "N",
        "peak_force": "N",
        "contact_share": "1",
    }

    def __init__(self, spec: InsertionSpec, world: World, pose: RelativePose) -> None:
        self._spec, self._world, self._pose = spec, world, pose
        self._forces = [0.0] * max(1, round(spec.window / world.timestep))  # a ring buffer [N]
        self._n_steps = self._n_in_contact = 0
        self._depth = self._max_depth = self._offset = self._tilt = 0.0
        self._force = self._peak_force = 0.0

    def start(self) -> None:
        """Take the first sample."""
        self.update()

    def update(self) -> None:
        """Take a sample."""
        x, y, z = self._pose.position().tolist()
        self._offset = math.hypot(x, y)
        self._depth = max(0.0, -z) if self._offset <= self._spec.radius else 0.0
        self._max_depth = max(self._max_depth, self._depth)
        axes = self._pose.axes()  # of the plug, in those of the socket
        cosine = float(np.clip(-(axes[0] * axes[4] - axes[1] * axes[3]), -1.0, 1.0))
        self._tilt = float(elementwise.arccos(cosine))
        forces = self._world.contact_forces(self._spec.socket)
        force = length(sum(forces.values(), np.zeros(3))) if forces else 0.0
        self._forces[self._n_steps % len(self._forces)] = force
        self._n_steps += 1
        self._n_in_contact += bool(forces)
        self._force = sum(self._forces) / len(self._forces)
        self._peak_force = max(self._peak_force, self._force)

    @property
    def value(self) -> float | None:
        """The last depth [m]; None if the measure was never active."""
        return self._depth if self._n_steps else None

    @property
    def details(self) -> dict[str, float | None]:
        """The greatest depth, the last offset [m] and tilt [rad], the forces [N], the contact."""
        if not self._n_steps:
            return dict.fromkeys(self.detail_units)
        return {
            "greatest": self._max_depth,
            "offset": self._offset,
            "tilt": self._tilt,
            "force": self._force,
            "peak_force": self._peak_force,
            "contact_share": self._n_in_contact / self._n_steps,
        }

    @property
    def log_header(self) -> tuple[str, ...]:
        """The columns: depth and force."""
        return ("value", "force [N]")

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """The present values of the columns of the log."""
        return (self.value, self._force)

r"""Distance: how far a body has travelled.

.. code-block:: xml

    <distance> <name>trip</name> <target>girona500/base_link</target> </distance>
"""

from __future__ import annotations

from dataclasses import dataclass

from ...base.geometry import Array
from ...base.numerics.linear import length
from ...schema import element
from ...world import Body, World
from .measure import Measure, MeasureSpec


@dataclass(frozen=True, kw_only=True)
class DistanceSpec(MeasureSpec):
    """A ``<distance>`` element of a benchmark file."""

    target: str = element(refers_to="body")
    """Name of the body to follow."""

    @property
    def start_value(self) -> float:
        """The original's start value."""
        return 0.0

    def bind(self, world: World) -> Distance:
        """Follow the target in ``world``; raises UnknownName if it is not there."""
        return Distance(world.body(self.target))


class Distance(Measure):
    r"""Length of the path of a body's origin :math:`p` in the world frame.

    .. math:: d = \sum_k \lVert p_k - p_{k-1} \rVert

    over the simulation steps :math:`k` at which the measure is on. What the body
    travels while it is off does not count.
    """

    unit = "m"

    def __init__(self, body: Body) -> None:
        self._body = body
        self._last: Array | None = None  # (3,) [m]
        self._travelled = 0.0  # [m]

    def start(self) -> None:
        """Count from where the body is now."""
        self._last = self._body.world_from_body.position

    def update(self) -> None:
        """Add the segment covered by the last step."""
        position = self._body.world_from_body.position
        if self._last is not None:
            self._travelled += length(position - self._last)
        self._last = position

    @property
    def value(self) -> float | None:
        """Path length so far [m]; None when the measure was never on."""
        return None if self._last is None else self._travelled

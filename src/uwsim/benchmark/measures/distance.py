r"""Distance: the length of the path that a body travels.

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
    """The route of the body."""

    @property
    def start_value(self) -> float:
        """The value that the original UWSim reports before its first sample [m]."""
        return 0.0

    def bind(self, world: World) -> Distance:
        """Resolve the target in ``world``; raises UnknownName if there is none."""
        return Distance(world.body(self.target))


class Distance(Measure):
    r"""The length of the path of a body's origin :math:`p` in the world frame W.

    .. math:: d = \sum_k \lVert p_k - p_{k-1} \rVert

    over the simulation steps :math:`k` at which the measure is active.
    """

    unit = "m"

    def __init__(self, body: Body) -> None:
        self._body = body
        self._last_position: Array | None = None  # in W (3,) [m]
        self._path_length = 0.0  # [m]

    def start(self) -> None:
        """Begin at the present position of the body."""
        self._last_position = self._body.world_from_body.position

    def update(self) -> None:
        """Add the length of the last step."""
        position = self._body.world_from_body.position
        if self._last_position is not None:
            self._path_length += length(position - self._last_position)
        self._last_position = position

    @property
    def value(self) -> float | None:
        """The path length so far [m]; None if the measure was never active."""
        return None if self._last_position is None else self._path_length

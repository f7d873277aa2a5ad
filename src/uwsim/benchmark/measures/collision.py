"""Collision: how hard a body has hit others. Read, not simulated yet.

.. code-block:: xml

    <collision> <name>hits</name> <target>girona500</target> </collision>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ...world import World
from ..not_simulated import NotSimulatedYet
from .measure import Measure, MeasureSpec


@dataclass(frozen=True, kw_only=True)
class CollisionSpec(MeasureSpec):
    """A ``<collision>`` element of a benchmark file."""

    is_simulated: ClassVar[bool] = False

    target: str
    """Name of the vehicle or object."""

    def bind(self, world: World) -> Measure:
        """Raise NotSimulatedYet."""
        raise NotSimulatedYet("collision")

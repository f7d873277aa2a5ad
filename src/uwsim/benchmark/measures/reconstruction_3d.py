"""Reconstruction 3D: how well point clouds rebuild a body. Read, not simulated yet.

.. code-block:: xml

    <reconstruction3D detailedResultsToGlobals="true">
      <name>reconstruction</name> <target>blackbox</target>
      <topic>/LaserReconstructionPointCloud</topic> <from>kinematic_base</from>
      <levelOfDetail>0.01</levelOfDetail>
    </reconstruction3D>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ...dialect import element
from ...world import World
from ..not_simulated import NotSimulatedYet
from .measure import Measure, MeasureSpec


@dataclass(frozen=True, kw_only=True)
class Reconstruction3DSpec(MeasureSpec):
    """A ``<reconstruction3D>`` element of a benchmark file."""

    is_simulated: ClassVar[bool] = False

    target: str
    """Route of the body that is rebuilt."""
    topic: str
    """Topic of the clouds (sensor_msgs/PointCloud2)."""
    from_: str = element("from")
    """Route of the body in whose frame the clouds are given."""
    level_of_detail: float = element(default=0.003, above=0.0)
    """Cell size of the coverage [m]."""
    detailed_results_to_globals: bool = element(default=False, attribute=True)
    """Whether the details stand in result.dat."""

    def bind(self, world: World) -> Measure:
        """Raise NotSimulatedYet."""
        raise NotSimulatedYet("reconstruction3D")

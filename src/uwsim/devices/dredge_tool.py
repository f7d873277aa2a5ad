"""Uncovers buried objects within 0.1 m.

.. code-block:: xml

    <DredgeTool>
      <name>dredge</name> <target>end_effector</target>
      <offsetp> <x>0</x> <y>0</y> <z>0</z> </offsetp>
      <offsetr> <x>0</x> <y>0</y> <z>0</z> </offsetr>
    </DredgeTool>
"""

from __future__ import annotations

from dataclasses import dataclass

from ..schema import REQUIRED, element


@dataclass(frozen=True, kw_only=True)
class DredgeToolSpec:
    """A ``<DredgeTool>``; it rides on the link's visual frame."""

    name: str
    """Its name."""
    target: str
    """The link it belongs to."""
    offsetp: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), original=REQUIRED)
    """Read and not used, as in the original [m]."""
    offsetr: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), original=REQUIRED)
    """Read and not used, as in the original [rad]."""

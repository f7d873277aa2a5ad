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
from typing import ClassVar

from ..base.record import Record
from ..schema import REQUIRED_BY_DTD, element
from ..world import Body, DeviceWorld
from .device import Device, DeviceSpec, DeviceVehicle

RATE = 60.0
"""How often a tool takes sand, as often as the original draws an image [Hz]."""


@dataclass(frozen=True, kw_only=True)
class DredgeToolSpec(DeviceSpec):
    """A ``<DredgeTool>``; it rides on the link's visual frame."""

    is_left_out: ClassVar[bool] = True

    name: str
    """Its name."""
    target: str
    """The link it belongs to."""
    offsetp: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), original=REQUIRED_BY_DTD)
    """Read and not used, as in the original [m]."""
    offsetr: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), original=REQUIRED_BY_DTD)
    """Read and not used, as in the original [rad]."""

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> DredgeTool:
        """Mount it on its link; raises UnknownName if the vehicle has no such link."""
        tool = DredgeTool(world, vehicle.mount(_Place(relative_to=self.target), visual=True))
        world.every(RATE, tool.dig)
        return tool


@dataclass(frozen=True, kw_only=True)
class _Place:
    """The origin of a link's visual frame."""

    relative_to: str
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    orientation: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass(slots=True)
class DredgeState(Record):
    """What a dredge tool has taken."""

    n_taken: int = 0
    """The columns of sand that lost some, added up."""


class DredgeTool(Device):
    """A tool that takes sand where it is."""

    def __init__(self, world: DeviceWorld, mount: Body) -> None:
        self._world, self._mount = world, mount
        self.state: DredgeState = DredgeState()

    def dig(self) -> None:
        """Take 0.01 m of each column of sand whose top is within 0.1 m."""
        self.state.n_taken += self._world.dig(self._mount.world_from_body.position)

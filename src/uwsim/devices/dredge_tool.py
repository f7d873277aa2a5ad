"""A tool that removes sand within 0.1 m, and so uncovers buried objects.

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
"""The rate at which a tool removes sand: the rate of images of the original UWSim [Hz]."""


@dataclass(frozen=True, kw_only=True)
class DredgeToolSpec(DeviceSpec):
    """A ``<DredgeTool>``; it is mounted on the link's visual frame."""

    is_left_out: ClassVar[bool] = True

    name: str
    """The name of the device."""
    target: str
    """The link on which the tool is mounted."""
    offsetp: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), original=REQUIRED_BY_DTD)
    """A position [m]: read but not used, as in the original UWSim."""
    offsetr: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), original=REQUIRED_BY_DTD)
    """An orientation [rad]: read but not used, as in the original UWSim."""

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> DredgeTool:
        """Mount the tool on its link; raise UnknownName if the vehicle has no such link."""
        tool = DredgeTool(world, vehicle.mount(_LinkOrigin(relative_to=self.target), visual=True))
        world.create_timer(RATE, tool.remove_sand)
        return tool


@dataclass(frozen=True, kw_only=True)
class _LinkOrigin:
    """The origin of a link's visual frame."""

    relative_to: str
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    orientation: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass(slots=True)
class DredgeState(Record):
    """The state of a dredge tool."""

    n_lowered: int = 0
    """The number of columns of sand that the tool has lowered; a column counts each time."""


class DredgeTool(Device):
    """A tool that removes the sand around it."""

    def __init__(self, world: DeviceWorld, mount: Body) -> None:
        self._world, self._mount = world, mount
        self.state: DredgeState = DredgeState()

    def remove_sand(self) -> None:
        """Lower by 0.01 m each column of sand whose top is within 0.1 m."""
        self.state.n_lowered += self._world.dig(self._mount.world_from_body.position)

"""What every sensor of a vehicle has: a name, a link it rides on, a place on that link."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Protocol, get_args

from ..world import Body

Direction = Literal["forward", "aft", "starboard", "port", "down", "up"]
"""Of the vehicle, as it stands in its file."""
DIRECTIONS: tuple[str, ...] = get_args(Direction)
LookAt = tuple[float, float, float] | Direction | None
"""What ``<u:lookAt>`` may say: a point in L [m], a direction of the vehicle, or nothing."""


@dataclass(frozen=True, kw_only=True)
class SensorSpec:
    """A sensor of a vehicle."""

    name: str
    """Its name, by which interfaces and benchmarks find it."""
    relative_to: str
    """The link it rides on; its place counts from the link's kinematic frame."""


class Mounted(Protocol):
    """Anything with a place on a link that looks somewhere."""

    @property
    def relative_to(self) -> str:
        """The link."""

    @property
    def position(self) -> tuple[float, float, float]:
        """In the link's frame [m]."""

    @property
    def orientation(self) -> tuple[float, float, float]:
        """Fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""

    @property
    def look_at(self) -> LookAt:
        """Where it looks at the start, instead of ``orientation``."""


class Carrier(Protocol):
    """A vehicle that carries sensors."""

    @property
    def name(self) -> str:
        """Its name in the scene."""

    def mount(self, spec: Mounted, *, visual: bool = False) -> Body:
        """Fix something to its link, or to the link's visual frame: a frame that moves with it.

        Raises:
            UnknownName: the vehicle has no such link.
        """

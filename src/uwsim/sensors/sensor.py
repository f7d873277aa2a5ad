"""What every sensor of a vehicle has: a name, a link it rides on, a place on that link."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from ..geometry import Pose


@dataclass(frozen=True, kw_only=True)
class SensorSpec:
    """A sensor of a vehicle."""

    name: str
    """Its name, by which interfaces and benchmarks find it."""
    relative_to: str
    """The link it rides on; its place counts from the link's kinematic frame."""


class Mounted(Protocol):
    """Anything with a place on a link."""

    @property
    def position(self) -> tuple[float, float, float]:
        """In the link's frame [m]."""

    @property
    def orientation(self) -> tuple[float, float, float]:
        """Fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""


def link_from_sensor(spec: Mounted) -> Pose:
    """Where a sensor or device stands on its link."""
    return Pose.from_rpy(spec.position, spec.orientation)

r"""A vehicle that oscillates about its pose, as in a swell; an extension of the dialect.

.. code-block:: xml

    <vehicle> ...
      <u:sway> <u:axis>x</u:axis> <u:amplitude>0.1</u:amplitude> <u:period>7</u:period> </u:sway>
    </vehicle>
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..base.geometry import Pose, rotation_from_xyz, xyz_from_rotation
from ..schema import element
from ..world import DeviceWorld
from .device import Device, DeviceSpec, DeviceVehicle

AXES = ("x", "y", "z", "roll", "pitch", "yaw")
"""The axes of displacements, in the order of their indices."""


@dataclass(frozen=True, kw_only=True)
class SwaySpec(DeviceSpec):
    """A ``<u:sway>``: a sinusoidal motion of a vehicle about its rest pose, along one axis.

    The rest pose is the pose in the scene file, or the pose that a program, a command or a level of
    a benchmark set last. Currents do not move the vehicle.
    """

    axis: Literal["x", "y", "z", "roll", "pitch", "yaw"] = element(namespaced=True)
    """The axis: of L for x, y, z; of the vehicle's orientation for roll, pitch, yaw."""
    amplitude: float = element(namespaced=True)
    """The amplitude [m or rad]."""
    period: float = element(namespaced=True, exclusive_minimum=0)
    """The period [s]."""
    phase: float = element(namespaced=True, default=0.0)
    """The phase at time 0 [rad]."""

    def offset(self, time: float) -> float:
        """Return ``amplitude * sin(2 pi time / period + phase)`` [m or rad]."""
        return self.amplitude * math.sin(2.0 * math.pi * time / self.period + self.phase)

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> Sway:
        """Create the motion of a vehicle."""
        return Sway(self, vehicle.displacer(AXES.index(self.axis)))


class Sway(Device):
    """A sinusoidal motion of a vehicle along or about one axis."""

    def __init__(self, spec: SwaySpec, displace: Callable[[float], None]) -> None:
        self._spec, self._displace = spec, displace

    def animate(self, time: float) -> None:
        """Displace the vehicle to its position in the oscillation at ``time`` [s]."""
        self._displace(self._spec.offset(time))


def displace_pose(
    position: Sequence[float], orientation: Sequence[float], offsets: Iterable[tuple[int, float]]
) -> Pose:
    """Return ``localized_from_base`` of a vehicle displaced from its rest pose.

    Args:
        position: the rest position, in L [m].
        orientation: the angles of the rest pose about x, y, z of L, Rx Ry Rz [rad].
        offsets: pairs of an index in `AXES` and an offset [m or rad]; offsets of one axis add up.
    """
    values = [*position, *orientation]
    for axis, offset in offsets:
        values[axis] += offset
    return Pose(np.array(values[:3]), rotation_from_xyz(*values[3:]))


def rest_pose(
    localized_from_base: Pose, offsets: Iterable[tuple[int, float]]
) -> tuple[list[float], list[float]]:
    """Return the position [m] and angles [rad] of the rest pose of a displaced vehicle.

    This is the inverse of `displace_pose`.

    Args:
        localized_from_base: the pose of the displaced vehicle.
        offsets: the offsets as for `displace_pose`.
    """
    position = np.array(localized_from_base.position)
    values = np.concatenate([position, xyz_from_rotation(localized_from_base.rotation)])
    for axis, offset in offsets:
        values[axis] -= offset
    return values[:3].tolist(), values[3:].tolist()

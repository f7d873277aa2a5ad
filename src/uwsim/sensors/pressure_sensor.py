r"""Depth, or pressure, at the sensor.

.. code-block:: xml

    <pressureSensor>
      <name>pressureSensor</name> <relativeTo>base_link</relativeTo> <std>0.02</std>
    </pressureSensor>
    <pressureSensor>
      <name>barometer</name> <relativeTo>base_link</relativeTo> <std>200</std>
      <u:measures>pressure</u:measures> <u:atmosphere>100800</u:atmosphere>
    </pressureSensor>

The pressure is hydrostatic: :math:`p = p_0 + g \int_0^d \rho \, dz` at the depth d below the still
surface, with the water's density over depth; above the surface it is that of the air, :math:`p_0`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar, Literal

import numpy as np

from ..base.record import RandomState
from ..messages import Pressure, header
from ..schema import MAX_DISTANCE, element
from ..world import GRAVITY, Body, SensorWorld
from .sensor import Carrier, SensorSpec

Quantity = Literal["depth", "pressure", "gauge"]
"""Depth below the surface [m], absolute pressure [Pa], or that above the air's [Pa]."""
AIR = 101325.0
"""Pressure of the standard atmosphere [Pa]."""


@dataclass(frozen=True, kw_only=True)
class PressureSensorSpec(SensorSpec):
    """A ``<pressureSensor>``."""

    message_type: ClassVar[type] = Pressure

    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """Of the sensor in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """Of the sensor in the link's frame, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""
    std: float = element(default=0.0, minimum=0, maximum=1e6)
    """Noise of what it measures, standard deviation [m], or [Pa]."""
    measures: Quantity = element(namespaced=True, default="depth")
    """``depth`` below the surface [m], absolute ``pressure`` [Pa], or ``gauge`` pressure, that
    above the air's [Pa]."""
    atmosphere: float = element(namespaced=True, default=AIR, minimum=0, maximum=1e7)
    """Pressure of the air at the surface [Pa]."""

    def bind(self, world: SensorWorld, vehicle: Carrier) -> PressureSensor:
        """Mount it on its link; raises UnknownName if the vehicle has no such link."""
        random = world.stream(f"{vehicle.name}/{self.name}/noise")
        return PressureSensor(self, vehicle.mount(self), world, random)


class PressureSensor:
    """A pressure cell; what it says is a depth or a pressure."""

    def __init__(
        self, spec: PressureSensorSpec, mount: Body, world: SensorWorld, random: np.random.Generator
    ) -> None:
        self._spec, self._mount, self._world = spec, mount, world
        self.state = RandomState(random)
        """What it draws."""

    def sample(self, time: float) -> Pressure:
        """Measure now, at ``time`` [s]."""
        value = self._value() + self._spec.std * self.state.random.standard_normal()
        is_original = "pressure-z" in self._world.compatibility
        frame = "world" if is_original else self._spec.name
        return Pressure(header=header(time, frame), pressure=float(value))

    def _value(self) -> float:
        """Without noise [m, or Pa]."""
        spec, world = self._spec, self._world
        position = self._mount.world_from_body.position
        if "pressure-z" in world.compatibility:
            return float(world.world_from_localized.inverse().transform(position[None])[0, 2])
        depth = max(0.0, world.surface_height - float(position[2]))
        if spec.measures == "depth":
            return depth
        gauge = GRAVITY * column_mass(world.density_levels, depth)
        return gauge if spec.measures == "gauge" else spec.atmosphere + gauge


def column_mass(levels: Sequence[tuple[float, float]], depth: float) -> float:
    """Return the mass of the water above a depth [m], of a square metre [kg/m2].

    Args:
        levels: depth [m] and density [kg/m3], rising; linear between them, constant beyond.
        depth: at least 0.
    """
    ends = [(0.0, levels[0][1]), *levels, (max(depth, levels[-1][0]), levels[-1][1])]
    total = 0.0
    for (top, first), (bottom, last) in pairwise(ends):
        if bottom <= top or top >= depth:
            continue
        low = min(bottom, depth)
        there = first + (last - first) * (low - top) / (bottom - top)
        total += 0.5 * (first + there) * (low - top)
    return total

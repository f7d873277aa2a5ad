"""One ray along +x: the distance to the first surface.

.. code-block:: xml

    <rangeSensor>
      <name>sonar</name> <relativeTo>part0</relativeTo> <range>10</range> <visible>0</visible>
    </rangeSensor>

It measures to what a camera would see, the vehicle's own parts too. With a beam width the nearest
of the rays of the beam counts, as in an echo sounder that detects the first echo.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..base.record import RandomState
from ..messages import Range, header
from ..schema import MAX_DISTANCE, element
from ..world import Body, SensorWorld
from .pencil import pencil
from .sensor import Carrier, LookAt, SensorSpec


@dataclass(frozen=True, kw_only=True)
class RangeSensorSpec(SensorSpec):
    """A ``<rangeSensor>``."""

    message_type: ClassVar[type] = Range

    range: float = element(minimum=0, maximum=MAX_DISTANCE)
    """Length of the ray; the value when nothing is hit [m]."""
    visible: bool = False
    """Whether the viewer draws the ray."""
    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """Position of the sensor in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """Orientation of the sensor in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    look_at: LookAt = element(namespaced=True, default=None)
    """Viewing target at the start, instead of ``orientation``: a point in L [m], or a direction
    of the vehicle. It stays fixed to its link."""
    beam_width: float = element(namespaced=True, default=0.0, minimum=0, maximum=120)
    """Beam width of the beam between its points of half power [deg]; 0 is a ray."""
    std: float = element(namespaced=True, default=0.0, minimum=0, maximum=1000)
    """Noise of the distance, standard deviation [m]."""

    def bind(self, world: SensorWorld, vehicle: Carrier) -> RangeSensor:
        """Mount it on its link; raises UnknownName if the vehicle has no such link."""
        mount = vehicle.mount(self, visual="visual-frames" in world.compatibility)
        return RangeSensor(self, mount, world, world.stream(f"{vehicle.name}/{self.name}/noise"))


class RangeSensor:
    """The distance from the sensor to the first surface in its beam."""

    def __init__(
        self, spec: RangeSensorSpec, mount: Body, world: SensorWorld, random: np.random.Generator
    ) -> None:
        self._spec, self._mount, self._world = spec, mount, world
        self.state = RandomState(random)
        """What it draws."""
        self._width = math.radians(spec.beam_width)
        x, y = np.array([[1.0, 0.0, 0.0]]), np.array([[0.0, 1.0, 0.0]])
        self._rays = pencil(x, y, self._width)[0][0]  # (k, 3)

    def sample(self, time: float) -> Range:
        """Measure now, at ``time`` [s]."""
        spec = self._spec
        hits = self._world.rays.cast(self._mount.world_from_body, self._rays, spec.range)
        nearest = float(hits.distance.min())
        if nearest <= spec.range:
            nearest += spec.std * self.state.random.standard_normal()
        else:
            self.state.random.standard_normal()
        return Range(
            header=header(time, spec.name),
            radiation_type=Range.ULTRASOUND,
            field_of_view=self._width,
            min_range=0.0,
            max_range=spec.range,
            range=min(max(nearest, 0.0), spec.range),
            variance=spec.std**2,
        )

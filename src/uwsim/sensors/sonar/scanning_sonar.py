"""A sonar whose head turns from ping to ping; an extension of the dialect.

.. code-block:: xml

    <u:scanningSonar>
      <name>scanner</name> <relativeTo>base_link</relativeTo>
      <range>20</range> <bins>500</bins> <verticalAperture>25</verticalAperture>
      <initAngle>-180</initAngle> <finalAngle>180</finalAngle> <angleIncr>1.8</angleIncr>
    </u:scanningSonar>

It pings once a sample and then turns by a step: round and round, or to and fro in a sector. See
`uwsim.sensors.sonar.echoes` for what it hears.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, Pose, rotation_z
from ...base.record import Record
from ...messages import Image, ProjectedSonarImage, image
from ...schema import element
from ...world import Body, SensorWorld
from ..sensor import Carrier
from .echoes import Echoes
from .fan_image import FanImage, Levels
from .message import level_directions, sonar_image
from .spec import SonarSpec

RAYS_A_WIDTH = 4
"""Rays side by side in the width of the one beam."""


@dataclass(frozen=True, kw_only=True)
class ScanningSonarSpec(SonarSpec):
    """A ``<u:scanningSonar>``."""

    message_type: ClassVar[type] = ProjectedSonarImage

    init_angle: float = element(default=-180.0, minimum=-360, maximum=360)
    """Azimuth of the first ping, positive to port [deg]."""
    final_angle: float = element(default=180.0, minimum=-360, maximum=360)
    """Azimuth at which it turns back [deg]; 360 from the first it goes on round."""
    angle_incr: float = element(default=1.8, minimum=0.001, maximum=180)
    """Step of the head from ping to ping [deg]."""

    @property
    def n_pings(self) -> int:
        """Pings of a scan."""
        n_steps = round(abs(self.final_angle - self.init_angle) / self.angle_incr)
        return max(1, n_steps + (not self.is_round))

    @property
    def n_cells(self) -> int:
        """Bins of all pings of a scan."""
        return self.bins * self.n_pings

    @property
    def azimuths(self) -> Array:
        """Of the pings of a scan, positive to port, (n,) [rad]."""
        way = self.final_angle - self.init_angle
        steps = math.copysign(self.angle_incr, way) * np.arange(self.n_pings)
        found: Array = np.radians(self.init_angle + steps)
        return found

    @property
    def is_round(self) -> bool:
        """Whether it scans a full circle."""
        return abs(self.final_angle - self.init_angle) >= 360.0

    def bind(self, world: SensorWorld, vehicle: Carrier) -> ScanningSonar:
        """Mount it on its link; raises UnknownName if the vehicle has no such link."""
        random = world.stream(f"{vehicle.name}/{self.name}/noise")
        return ScanningSonar(self, vehicle.mount(self), world, random)


@dataclass(slots=True)
class ScanningState(Record):
    """What a scanning sonar has drawn and seen."""

    random: np.random.Generator
    """The generator of its speckle."""
    scan: npt.NDArray[np.float32]
    """The last ping of each azimuth, (bins, n)."""
    n_pings: int = 0
    """The pings so far."""


class ScanningSonar:
    """Echoes of one beam after the other."""

    def __init__(
        self, spec: ScanningSonarSpec, mount: Body, world: SensorWorld, random: np.random.Generator
    ) -> None:
        self._spec, self._mount = spec, mount
        step = math.radians(spec.beam_width) / RAYS_A_WIDTH
        self._echoes = Echoes(spec, world, np.zeros(1), step)
        self._azimuths, self._ranges = spec.azimuths, self._echoes.ranges
        self._levels = Levels(spec, self._ranges)
        self.state = ScanningState(random, np.zeros((spec.bins, len(self._azimuths)), np.float32))
        """What it has drawn and seen."""

    @cached_property
    def _fan(self) -> FanImage:
        return FanImage(self._azimuths, self._ranges)

    @property
    def _place(self) -> int:
        """Number of the azimuth that the next ping goes to."""
        n = len(self._azimuths)
        if self._spec.is_round or n == 1:
            return self.state.n_pings % n
        place = self.state.n_pings % (2 * n - 2)
        return min(place, 2 * n - 2 - place)

    def sample(self, time: float) -> ProjectedSonarImage:
        """Ping now, at ``time`` [s], and turn."""
        place = self._place
        azimuth = float(self._azimuths[place])
        sonar_from_head = Pose(np.zeros(3), rotation_z(azimuth))
        world_from_head = self._mount.world_from_body @ sonar_from_head
        amplitude = self._echoes.ping(world_from_head, int(self.state.random.integers(2**63)))
        self.state.scan[:, place] = amplitude[:, 0]
        self.state.n_pings += 1
        return sonar_image(
            amplitude,
            self._spec,
            directions=level_directions(np.array([azimuth])),
            ranges=self._ranges,
            sound_speed=self._echoes.sound_speed(world_from_head),
            time=time,
        )

    def image(self, time: float) -> Image:
        """The last ping of each azimuth, ahead is up, stamped ``time`` [s]."""
        losses = self._echoes.losses(self._mount.world_from_body)
        greys = self._levels.of(self.state.scan, losses)
        return image(self._fan.of(greys), time=time, frame_id=self._spec.name)

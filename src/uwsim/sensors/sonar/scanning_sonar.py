"""A sonar whose head turns from ping to ping; an extension of the dialect.

.. code-block:: xml

    <u:scanningSonar>
      <name>scanner</name> <relativeTo>base_link</relativeTo>
      <range>20</range> <bins>500</bins> <verticalAperture>25</verticalAperture>
      <initAngle>-180</initAngle> <finalAngle>180</finalAngle> <angleIncr>1.8</angleIncr>
    </u:scanningSonar>

A sample is one ping, after which the head turns by a step: in full circles, or to and fro in a
sector. See
`uwsim.sensors.sonar.echoes` for the echoes.
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
from .fan_image import FanImage, GreyLevels
from .message import level_directions, sonar_image
from .spec import SonarSpec

RAYS_PER_BEAM_WIDTH = 4
"""The number of rays side by side in the width of a beam."""


@dataclass(frozen=True, kw_only=True)
class ScanningSonarSpec(SonarSpec):
    """A ``<u:scanningSonar>``."""

    message_type: ClassVar[type] = ProjectedSonarImage

    init_angle: float = element(default=-180.0, minimum=-360, maximum=360)
    """The azimuth of the first ping, positive to port [deg]."""
    final_angle: float = element(default=180.0, minimum=-360, maximum=360)
    """The azimuth at which the head turns back [deg]; 360 degrees from ``initAngle``, it does not
    turn back but continues."""
    angle_incr: float = element(default=1.8, minimum=0.001, maximum=180)
    """The step of the head from ping to ping [deg]."""

    @property
    def n_pings(self) -> int:
        """The number of pings of a scan."""
        n_steps = round(abs(self.final_angle - self.init_angle) / self.angle_incr)
        return max(1, n_steps + (not self.is_full_circle))

    @property
    def n_cells(self) -> int:
        """The number of bins of all pings of a scan."""
        return self.bins * self.n_pings

    @property
    def azimuths(self) -> Array:
        """The azimuths of the pings of a scan, positive to port, (n,) [rad]."""
        sector = self.final_angle - self.init_angle
        steps = math.copysign(self.angle_incr, sector) * np.arange(self.n_pings)
        azimuths: Array = np.radians(self.init_angle + steps)
        return azimuths

    @property
    def is_full_circle(self) -> bool:
        """True if the sonar scans full circles."""
        return abs(self.final_angle - self.init_angle) >= 360.0

    def bind(self, world: SensorWorld, vehicle: Carrier) -> ScanningSonar:
        """Mount the sensor on its link; raise UnknownName if the vehicle has no such link."""
        rng = world.stream(f"{vehicle.name}/{self.name}/noise")
        return ScanningSonar(self, vehicle.mount(self), world, rng)


@dataclass(slots=True)
class ScanningState(Record):
    """The state of a scanning sonar."""

    rng: np.random.Generator
    """The generator of the speckle and the noise."""
    scan: npt.NDArray[np.float32]
    """The amplitudes of the last ping at each azimuth, (bins, n) [Pa]."""
    n_pings: int = 0
    """The number of pings so far."""


class ScanningSonar:
    """A sonar with a single beam, which turns from ping to ping."""

    def __init__(
        self, spec: ScanningSonarSpec, mount: Body, world: SensorWorld, rng: np.random.Generator
    ) -> None:
        self._spec, self._mount = spec, mount
        step = math.radians(spec.beam_width) / RAYS_PER_BEAM_WIDTH
        self._echoes = Echoes(spec, world, np.zeros(1), step)
        self._azimuths, self._ranges = spec.azimuths, self._echoes.ranges
        self._levels = GreyLevels(spec, self._ranges)
        self.state = ScanningState(rng, np.zeros((spec.bins, len(self._azimuths)), np.float32))
        """The state: the last scan, and the generator of speckle and noise."""

    @cached_property
    def _fan(self) -> FanImage:
        return FanImage(self._azimuths, self._ranges)

    @property
    def _azimuth_index(self) -> int:
        """The index of the next ping's azimuth."""
        n = len(self._azimuths)
        if self._spec.is_full_circle or n == 1:
            return self.state.n_pings % n
        index = self.state.n_pings % (2 * n - 2)
        return min(index, 2 * n - 2 - index)

    def sample(self, time: float) -> ProjectedSonarImage:
        """Ping at ``time`` [s], and turn the head."""
        index = self._azimuth_index
        azimuth = float(self._azimuths[index])
        sonar_from_head = Pose(np.zeros(3), rotation_z(azimuth))
        world_from_head = self._mount.world_from_body @ sonar_from_head
        amplitude = self._echoes.ping(world_from_head, int(self.state.rng.integers(2**63)))
        self.state.scan[:, index] = amplitude[:, 0]
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
        """Return the last scan as a fan with ahead at the top, stamped ``time`` [s]."""
        absorption = self._echoes.absorption(self._mount.world_from_body)
        greys = self._levels.to_grey(self.state.scan, absorption)
        return image(self._fan.draw(greys), time=time, frame_id=self._spec.name)

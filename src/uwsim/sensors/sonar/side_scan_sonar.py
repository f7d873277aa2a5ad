"""A side-scan sonar; an extension of the dialect.

.. code-block:: xml

    <u:sideScanSonar>
      <name>sidescan</name> <relativeTo>base_link</relativeTo>
      <range>40</range> <bins>1000</bins> <beamWidth>0.5</beamWidth>
      <verticalAperture>50</verticalAperture> <tilt>25</tilt> <lines>400</lines>
    </u:sideScanSonar>

A sample is one ping, to port and to starboard. As the vehicle moves, successive pings form an
image, the waterfall. See `uwsim.sensors.sonar.echoes` for the echoes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from ...base.geometry import Pose, rotation_y, rotation_z
from ...base.numerics.linear import product
from ...base.record import Record
from ...messages import Image, ProjectedSonarImage, image
from ...schema import element
from ...world import Body, SensorWorld
from ..sensor import Carrier
from .echoes import Echoes
from .fan_image import GreyLevels
from .message import sonar_image
from .scanning_sonar import RAYS_PER_BEAM_WIDTH
from .spec import SonarSpec

SIDES = (0.5 * math.pi, -0.5 * math.pi)
"""The azimuths of the beams: port, starboard [rad]."""


@dataclass(frozen=True, kw_only=True)
class SideScanSonarSpec(SonarSpec):
    """A ``<u:sideScanSonar>``: +x is the direction of travel, +z up."""

    message_type: ClassVar[type] = ProjectedSonarImage

    vertical_aperture: float = element(default=50.0, exclusive_minimum=0, maximum=160)
    """The vertical width of each beam at -3 dB of the one-way pattern [deg]."""
    beam_width: float = element(default=0.5, exclusive_minimum=0, maximum=30)
    """The horizontal width of each beam at -3 dB of the two-way pattern [deg]."""
    rows: int = element(default=256, minimum=1, maximum=2048)
    """The number of rays of a beam, one above the other. Small targets get additional rays; a part
    of a large body that is lower than the spacing of the rays may be missed."""
    tilt: float = element(default=25.0, minimum=-90, maximum=90)
    """The angle of the axis of each beam below the x-y plane of the sonar [deg]."""
    lines: int = element(default=400, minimum=1, maximum=10000)
    """The number of pings in the waterfall."""

    @property
    def n_cells(self) -> int:
        """The number of range bins of all pings in the waterfall."""
        return 2 * self.bins * self.lines

    def bind(self, world: SensorWorld, vehicle: Carrier) -> SideScanSonar:
        """Mount the sensor on its link; raise UnknownName if the vehicle has no such link."""
        rng = world.stream(f"{vehicle.name}/{self.name}/noise")
        return SideScanSonar(self, vehicle.mount(self), world, rng)


@dataclass(slots=True)
class SideScanState(Record):
    """The state of a side-scan sonar."""

    rng: np.random.Generator
    """The generator of the speckle and the noise."""
    waterfall: npt.NDArray[np.uint8]
    """The grey values of the last pings, a ring buffer of lines, (lines, 2 * bins)."""
    n_pings: int = 0
    """The number of pings so far."""


class SideScanSonar:
    """A sonar with a beam to port and one to starboard, and a waterfall of the last pings."""

    def __init__(
        self, spec: SideScanSonarSpec, mount: Body, world: SensorWorld, rng: np.random.Generator
    ) -> None:
        self._spec, self._mount = spec, mount
        step = math.radians(spec.beam_width) / RAYS_PER_BEAM_WIDTH
        self._echoes = Echoes(spec, world, np.zeros(1), step, max_elevation=0.5 * math.pi)
        self._ranges, self._levels = self._echoes.ranges, GreyLevels(spec, self._echoes.ranges)
        down = rotation_y(math.radians(spec.tilt))
        self._sonar_from_beams = tuple(
            Pose(np.zeros(3), product(rotation_z(side), down)) for side in SIDES
        )
        self.state = SideScanState(rng, np.zeros((spec.lines, 2 * spec.bins), dtype=np.uint8))
        """The state: the waterfall, and the generator of speckle and noise."""

    def sample(self, time: float) -> ProjectedSonarImage:
        """Ping at ``time`` [s]; the first beam of the message points to port."""
        world_from_sonar = self._mount.world_from_body
        seeds = [int(seed) for seed in self.state.rng.integers(2**63, size=2)]
        beams = [
            self._echoes.ping(world_from_sonar @ sonar_from_beam, seed)
            for sonar_from_beam, seed in zip(self._sonar_from_beams, seeds, strict=True)
        ]
        amplitude = np.concatenate(beams, axis=1)
        greys = self._levels.to_grey(amplitude, self._echoes.absorption(world_from_sonar))
        line = self.state.n_pings % self._spec.lines
        self.state.waterfall[line] = np.concatenate([greys[::-1, 0], greys[:, 1]])
        self.state.n_pings += 1
        return sonar_image(
            amplitude,
            self._spec,
            directions=np.stack([beam.rotation[:, 0] for beam in self._sonar_from_beams]),
            ranges=self._ranges,
            sound_speed=self._echoes.sound_speed(world_from_sonar),
            time=time,
        )

    def image(self, time: float) -> Image:
        """Return the waterfall, newest ping at the top, port on the left, stamped ``time`` [s]."""
        newest_line = (self.state.n_pings - 1) % self._spec.lines
        rows = np.roll(self.state.waterfall, -1 - newest_line, axis=0)[::-1]
        return image(rows, time=time, frame_id=self._spec.name)

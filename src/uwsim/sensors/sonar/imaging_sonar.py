"""A forward-looking imaging sonar; an extension of the dialect.

.. code-block:: xml

    <u:imagingSonar>
      <name>sonar</name> <relativeTo>base_link</relativeTo>
      <position> <x>0.8</x> <y>0</y> <z>0.2</z> </position> <u:lookAt>forward</u:lookAt>
      <range>20</range> <bins>500</bins> <verticalAperture>20</verticalAperture>
      <horizontalAperture>90</horizontalAperture> <beams>512</beams>
    </u:imagingSonar>

All beams receive the echoes of each ping; see `uwsim.sensors.sonar.echoes`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, Pose
from ...base.record import Record
from ...messages import Image, ProjectedSonarImage, image
from ...schema import element
from ...world import Body, SensorWorld
from ..sensor import Carrier
from .echoes import Echoes
from .fan_image import FanImage, GreyLevels
from .message import level_directions, sonar_image
from .ray_grid import n_columns
from .spec import SonarSpec


@dataclass(frozen=True, kw_only=True)
class ImagingSonarSpec(SonarSpec):
    """A ``<u:imagingSonar>``."""

    message_type: ClassVar[type] = ProjectedSonarImage

    horizontal_aperture: float = element(default=90.0, exclusive_minimum=0, maximum=360)
    """The angle from the axis of the first beam to the axis of the last [deg]."""
    beams: int = element(default=512, minimum=2, maximum=4096)
    """The number of beams side by side."""

    @property
    def n_cells(self) -> int:
        """The number of range bins of all beams."""
        return self.bins * self.beams

    @property
    def n_rays(self) -> int:
        """The number of rays of a ping, without rays outside the fan or to small targets."""
        n = n_columns(math.radians(self.beam_width), self._step, self.beams)
        return self.rows * max(n, self.beams)

    @property
    def _step(self) -> float:
        """The angle between beams [rad]."""
        return math.radians(self.horizontal_aperture) / (self.beams - 1)

    @property
    def azimuths(self) -> Array:
        """The azimuths of the beams, positive to port, from starboard to port, (n,) [rad]."""
        half = 0.5 * math.radians(self.horizontal_aperture)
        return np.linspace(-half, half, self.beams)

    def bind(self, world: SensorWorld, vehicle: Carrier) -> ImagingSonar:
        """Mount the sensor on its link; raise UnknownName if the vehicle has no such link."""
        rng = world.stream(f"{vehicle.name}/{self.name}/noise")
        return ImagingSonar(self, vehicle.mount(self), world, rng)


@dataclass(slots=True)
class ImagingState(Record):
    """The state of an imaging sonar."""

    rng: np.random.Generator
    """The generator of the speckle and the noise."""
    last_ping: npt.NDArray[np.float32]
    """The amplitudes of the last ping, (bins, beams) [Pa]."""


class ImagingSonar:
    """A sonar that measures echoes in bins of azimuth and range."""

    def __init__(
        self, spec: ImagingSonarSpec, mount: Body, world: SensorWorld, rng: np.random.Generator
    ) -> None:
        self._spec, self._mount = spec, mount
        azimuths = spec.azimuths
        self.echoes = Echoes(spec, world, azimuths, float(azimuths[1] - azimuths[0]))
        """The echoes of pings from any pose."""
        self._ranges, self._directions = self.echoes.ranges, level_directions(azimuths)
        self._azimuths, self._levels = azimuths, GreyLevels(spec, self._ranges)
        self.state = ImagingState(rng, np.zeros((spec.bins, spec.beams), np.float32))
        """The state: the last ping, and the generator of speckle and noise."""

    @property
    def spec(self) -> ImagingSonarSpec:
        """The spec of the sonar."""
        return self._spec

    @property
    def world_from_sonar(self) -> Pose:
        """The pose of the sonar in W: x ahead, y to port, z up."""
        return self._mount.world_from_body

    def ping_grey(self, world_from_sonar: Pose, seed: int) -> npt.NDArray[np.uint8]:
        """Return the grey values of a ping from any pose, (bins, beams); the state is unchanged.

        Args:
            world_from_sonar: the pose of the sonar.
            seed: the seed of the speckle and the noise.
        """
        amplitudes = self.echoes.ping(world_from_sonar, seed)
        return self._levels.to_grey(amplitudes, self.echoes.absorption(world_from_sonar))

    @cached_property
    def _fan(self) -> FanImage:
        return FanImage(self._azimuths, self._ranges)

    def sample(self, time: float) -> ProjectedSonarImage:
        """Ping at ``time`` [s]."""
        pose, spec = self._mount.world_from_body, self._spec
        self.state.last_ping = self.echoes.ping(pose, int(self.state.rng.integers(2**63)))
        return sonar_image(
            self.state.last_ping,
            spec,
            directions=self._directions,
            ranges=self._ranges,
            sound_speed=self.echoes.sound_speed(pose),
            time=time,
        )

    def image(self, time: float) -> Image:
        """Return the last ping as a fan with ahead at the top, stamped ``time`` [s]."""
        absorption = self.echoes.absorption(self._mount.world_from_body)
        greys = self._levels.to_grey(self.state.last_ping, absorption)
        return image(self._fan.draw(greys), time=time, frame_id=self._spec.name)

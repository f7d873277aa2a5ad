"""Position on Earth, at the surface.

.. code-block:: xml

    <nedOrigin> <lat>41.775</lat> <lon>3.033</lon> </nedOrigin>
    <vehicle> ...
      <gpsSensor>
        <name>gpsSensor</name> <relativeTo>base_link</relativeTo> <std>0.5</std>
      </gpsSensor>

With ``<nedOrigin>`` it measures latitude and longitude on WGS84 [deg] and the altitude [m]. Without
``<nedOrigin>`` it measures x and y in L [m], as the original UWSim does, and no altitude. Deeper
than ``<u:maxDepth>`` it has no fix.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..base.geometry import Array
from ..base.numerics.calls import FUNCTION
from ..base.numerics.draws import STREAM, normal, stream_of
from ..base.numerics.memory import carray, pointer, view_doubles
from ..base.record import RandomState
from ..messages import NavSatFix, NavSatStatus, header
from ..schema import MAX_DISTANCE, element
from ..world import Mount, SensorWorld
from ..world.mounts import MOUNT, read_frame, read_surface
from .sensor import Carrier, CompiledSensor, SensorSpec, create_sampler

NO_FIX, FIX = -1, 0
"""The statuses of NavSatStatus."""
GPS = 1
"""The service GPS of NavSatStatus."""
COVARIANCE_UNKNOWN, COVARIANCE_DIAGONAL = 0, 2
"""The covariance types of NavSatFix."""


@dataclass(frozen=True, kw_only=True)
class GpsSensorSpec(SensorSpec):
    """A ``<gpsSensor>``."""

    message_type: ClassVar[type] = NavSatFix

    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """The position of the sensor in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """The orientation of the sensor in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    std: float = element(default=0.0, minimum=0, maximum=1000)
    """The standard deviation of the noise of each coordinate [m]."""
    max_depth: float = element(namespaced=True, default=0.5, minimum=0, maximum=MAX_DISTANCE)
    """The depth below the surface from which on the receiver has no fix [m]."""

    def bind(self, world: SensorWorld, vehicle: Carrier) -> GpsSensor:
        """Mount the sensor on its link; raise UnknownName if the vehicle has no such link."""
        rng = world.stream(f"{vehicle.name}/{self.name}/noise")
        return GpsSensor(self, vehicle.mount(self), world, rng)


GNSS = np.dtype(
    [
        ("mount", MOUNT),
        ("stream", STREAM),
        ("std", np.float64),  # [m]
        ("waves", FUNCTION),  # see `read_surface`
    ]
)
"""The parameters of a satellite receiver, for compiled code."""
N_VALUES = 7
"""The number of values of a sample: the position in W, its noise along x, y and z, and the
elevation of the surface above its still height [m]."""


class GpsSensor(CompiledSensor):
    """A satellite receiver."""

    def __init__(
        self, spec: GpsSensorSpec, mount: Mount, world: SensorWorld, rng: np.random.Generator
    ) -> None:
        self._spec, self._world = spec, world
        self.state = RandomState(rng)
        """The state: the generator of the noise."""
        self._publishes_metres = "gps-metres" in world.compatibility
        row = np.zeros(1, GNSS)
        row["mount"], row["stream"], row["std"] = mount.functions, stream_of(rng), spec.std
        row["waves"] = world.surface.wave_addresses
        self.sampler = create_sampler(mount, sample_gps, row, N_VALUES, (self.state, world.surface))
        """The sampler that takes samples in compiled code."""

    def message(self, time: float, values: Array) -> NavSatFix | None:
        """Return the message of a sample at ``time`` [s]; None for no message."""
        position, noise, elevation = values[:3], values[3:6], float(values[6])
        if self._world.surface.height + elevation - float(position[2]) >= self._spec.max_depth:
            return None if self._publishes_metres else self._no_fix(time)
        latitude, longitude, altitude = self._coordinates(position, noise)
        return NavSatFix(
            header=header(0.0) if self._publishes_metres else header(time, self._spec.name),
            status=NavSatStatus(status=FIX, service=0 if self._publishes_metres else GPS),
            latitude=latitude,
            longitude=longitude,
            altitude=altitude,
            position_covariance=(self._spec.std**2 * np.eye(3)).reshape(9),
            position_covariance_type=COVARIANCE_DIAGONAL,
        )

    def _coordinates(self, position: Array, noise: Array) -> tuple[float, float, float]:
        """Return latitude, longitude [deg] and altitude [m]; or x and y in L [m], and 0."""
        origin = self._world.earth_origin
        if origin is None or self._publishes_metres:
            x, y, _ = self._world.world_from_localized.inverse().transform(position[None])[0]
            return float(x + noise[0]), float(y + noise[1]), 0.0
        east, north, up = (position + noise).tolist()
        geodetic = origin.position_at(np.array([north, east, -up]))
        return math.degrees(geodetic.latitude), math.degrees(geodetic.longitude), geodetic.altitude

    def _no_fix(self, time: float) -> NavSatFix:
        return NavSatFix(
            header=header(time, self._spec.name),
            status=NavSatStatus(status=NO_FIX, service=GPS),
            latitude=math.nan,
            longitude=math.nan,
            altitude=math.nan,
            position_covariance_type=COVARIANCE_UNKNOWN,
        )


def sample_gps(parameters: int, values: int, time: float) -> None:
    """Take a sample of a satellite receiver; see `uwsim.base.numerics.calls`."""
    sensor, output, frame = (
        carray(pointer(parameters), (1,), GNSS)[0],
        view_doubles(values, N_VALUES),
        np.empty(12),
    )
    read_frame(sensor.mount, frame)
    for k in range(3):
        output[k] = frame[k]
    for k in range(3, 6):
        output[k] = sensor.std * normal(sensor.stream)
    output[6], _ = read_surface(sensor.waves, frame, time)

"""The distance to the first surface along +x, by one ray or by the rays of a narrow beam.

.. code-block:: xml

    <rangeSensor>
      <name>sonar</name> <relativeTo>part0</relativeTo> <range>10</range> <visible>0</visible>
    </rangeSensor>

It measures the distance to visible surfaces, the vehicle's own parts included. With a beam width,
the nearest hit of the beam's rays counts, as in an echo sounder that detects the first echo.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ..base.geometry import Array
from ..base.numerics.calls import address_of, function_address
from ..base.numerics.draws import STREAM, normal, stream_of
from ..base.numerics.jit import njit
from ..base.numerics.linear import rotate_rows
from ..base.numerics.memory import carray, pointer, view_doubles
from ..base.record import RandomState
from ..base.sampling import Sampler
from ..messages import Range, header
from ..rays import Hits
from ..rays.scene_record import RAYS, cast_from
from ..schema import MAX_DISTANCE, element
from ..world import Mount, SensorWorld
from ..world.mounts import MOUNT, read_frame
from .pencil import pencil_rays
from .sensor import Carrier, CompiledSensor, LookAt, SensorSpec


@dataclass(frozen=True, kw_only=True)
class RangeSensorSpec(SensorSpec):
    """A ``<rangeSensor>``."""

    message_type: ClassVar[type] = Range

    range: float = element(minimum=0, maximum=MAX_DISTANCE)
    """The length of the ray, which is also the measured value without a hit [m]."""
    visible: bool = False
    """True if the viewer draws the ray."""
    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """The position of the sensor in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """The orientation of the sensor in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    look_at: LookAt = element(namespaced=True, default=None)
    """The viewing target at the start, instead of ``orientation``: a point in L [m], or a direction
    of the vehicle. The sensor stays fixed to its link."""
    beam_width: float = element(namespaced=True, default=0.0, minimum=0, maximum=120)
    """The width of the beam at -3 dB [deg]; 0: a single ray."""
    std: float = element(namespaced=True, default=0.0, minimum=0, maximum=1000)
    """The standard deviation of the noise of the distance [m]."""

    def bind(self, world: SensorWorld, vehicle: Carrier) -> RangeSensor:
        """Mount the sensor on its link; raise UnknownName if the vehicle has no such link."""
        mount = vehicle.mount(self, visual="visual-frames" in world.compatibility)
        return RangeSensor(self, mount, world, world.stream(f"{vehicle.name}/{self.name}/noise"))


RANGE = np.dtype(
    [
        ("mount", MOUNT),
        ("rays", RAYS),
        ("stream", STREAM),
        ("std", np.float64),  # of the noise [m]
        ("reach", np.float64),  # the length of the rays [m]
        ("directions", np.int64),  # the address of the rays' unit vectors, sensor frame, (n, 3)
        ("n", np.int64),  # the number of rays
    ]
)
"""The parameters of a range sensor, for compiled code."""


class RangeSensor(CompiledSensor):
    """A sensor that measures the distance to the first surface in a beam."""

    def __init__(
        self, spec: RangeSensorSpec, mount: Mount, world: SensorWorld, rng: np.random.Generator
    ) -> None:
        self._spec = spec
        self.state = RandomState(rng)
        """The state: the generator of the noise."""
        self._width = math.radians(spec.beam_width)
        x, y = np.array([[1.0, 0.0, 0.0]]), np.array([[0.0, 1.0, 0.0]])
        directions = np.ascontiguousarray(pencil_rays(x, y, self._width)[0][0])  # (n, 3)
        row, rays = np.zeros(1, RANGE), world.rays
        row["mount"], row["rays"] = mount.functions, rays.functions
        row["stream"], row["std"], row["reach"] = stream_of(rng), spec.std, spec.range
        row["directions"], row["n"] = address_of(directions), len(directions)

        def prepare(time: float) -> None:
            mount.prepare()
            rays.prepare()

        self.sampler = Sampler(
            function=function_address(sample_range),
            parameters=row,
            n_values=1,
            prepare=prepare,
            can_skip_prepare=lambda _: mount.is_compiled and rays.is_compiled,
            memory_owners=(self.state, mount, rays, directions),
        )
        """The sampler that takes samples in compiled code."""

    def message(self, time: float, values: Array) -> Range:
        """Return the message of a sample at ``time`` [s]."""
        spec = self._spec
        return Range(
            header=header(time, spec.name),
            radiation_type=Range.ULTRASOUND,
            field_of_view=self._width,
            min_range=0.0,
            max_range=spec.range,
            range=float(values[0]),
            variance=spec.std**2,
        )


def sample_range(parameters: int, values: int, time: float) -> None:
    """Take a sample of a range sensor; see `uwsim.base.numerics.calls`."""
    sensor = carray(pointer(parameters), (1,), RANGE)[0]
    distance = nearest_hit(sensor)
    noise = sensor.std * normal(sensor.stream)
    if distance <= sensor.reach:
        distance += noise
    view_doubles(values, 1)[0] = min(max(distance, 0.0), sensor.reach)


@njit
def nearest_hit(sensor: Any) -> float:
    """Return the distance to the first surface in the beam [m]; infinite if there is none."""
    n = sensor.n
    frame, starts = np.empty(12), np.zeros(n)
    hits = Hits(np.empty(n), np.empty((n, 3)), np.empty(n, np.int32))
    read_frame(sensor.mount, frame)
    directions = view_doubles(sensor.directions, 3 * n).reshape((-1, 3))
    world_directions = rotate_rows(frame[3:].reshape((3, 3)), directions)
    cast_from(sensor.rays, frame[:3], world_directions, starts, sensor.reach, hits)
    distance: float = hits.distance.min()
    return distance

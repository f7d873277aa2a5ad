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
from .pencil import pencil
from .sensor import Carrier, CompiledSensor, LookAt, SensorSpec


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


RANGE = np.dtype(
    [
        ("mount", MOUNT),
        ("rays", RAYS),
        ("stream", STREAM),
        ("std", np.float64),
        ("reach", np.float64),  # [m]
        ("directions", np.int64),  # the address of those of the rays in the sensor, (n, 3)
        ("n", np.int64),
    ]
)
"""A range sensor, for compiled code."""


class RangeSensor(CompiledSensor):
    """The distance from the sensor to the first surface in its beam."""

    def __init__(
        self, spec: RangeSensorSpec, mount: Mount, world: SensorWorld, random: np.random.Generator
    ) -> None:
        self._spec = spec
        self.state = RandomState(random)
        """What it draws."""
        self._width = math.radians(spec.beam_width)
        x, y = np.array([[1.0, 0.0, 0.0]]), np.array([[0.0, 1.0, 0.0]])
        directions = np.ascontiguousarray(pencil(x, y, self._width)[0][0])  # (n, 3)
        row, rays = np.zeros(1, RANGE), world.rays
        row["mount"], row["rays"] = mount.functions, rays.functions
        row["stream"], row["std"], row["reach"] = stream_of(random), spec.std, spec.range
        row["directions"], row["n"] = address_of(directions), len(directions)

        def prepare(time: float) -> None:
            mount.prepare()
            rays.prepare()

        self.sampler = Sampler(
            function=function_address(sample_range),
            parameters=row,
            n_values=1,
            prepare=prepare,
            is_alone=lambda _: mount.is_compiled and rays.is_compiled,
            memory_owners=(self.state, mount, rays, directions),
        )
        """What takes the numbers of a sample."""

    def message(self, time: float, values: Array) -> Range:
        """Make the message of a sample taken at ``time`` [s]."""
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
    nearest = nearest_hit(sensor)
    noise = sensor.std * normal(sensor.stream)
    if nearest <= sensor.reach:
        nearest += noise
    view_doubles(values, 1)[0] = min(max(nearest, 0.0), sensor.reach)


@njit
def nearest_hit(sensor: Any) -> float:
    """Return the distance to the first surface in its beam; infinite if there is none [m]."""
    n = sensor.n
    frame, begins = np.empty(12), np.zeros(n)
    hits = Hits(np.empty(n), np.empty((n, 3)), np.empty(n, np.int32))
    read_frame(sensor.mount, frame)
    directions = view_doubles(sensor.directions, 3 * n).reshape((-1, 3))
    along = rotate_rows(frame[3:].reshape((3, 3)), directions)
    cast_from(sensor.rays, frame[:3], along, begins, sensor.reach, hits)
    nearest: float = hits.distance.min()
    return nearest

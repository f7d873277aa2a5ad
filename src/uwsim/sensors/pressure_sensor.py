r"""Depth, or pressure, at the sensor.

.. code-block:: xml

    <pressureSensor>
      <name>pressureSensor</name> <relativeTo>base_link</relativeTo> <std>0.02</std>
    </pressureSensor>
    <pressureSensor>
      <name>barometer</name> <relativeTo>base_link</relativeTo> <std>200</std>
      <u:measures>pressure</u:measures> <u:atmosphere>100800</u:atmosphere>
    </pressureSensor>

The pressure is :math:`p = p_0 + g \int_0^d \rho \, dz + p_w` at the depth d below the still
surface, with the water's density over depth and the dynamic pressure :math:`p_w` of waves. Above
the surface it is the air pressure :math:`p_0`. A measured depth is :math:`d + p_w / (\rho g)`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, Literal

import numpy as np

from ..base.geometry import Array
from ..base.numerics.calls import FUNCTION, address_of
from ..base.numerics.draws import STREAM, normal, stream_of
from ..base.numerics.jit import njit
from ..base.numerics.memory import carray, pointer, view_doubles
from ..base.record import RandomState
from ..messages import Pressure, header
from ..schema import MAX_DISTANCE, element
from ..world import GRAVITY, Mount, SensorWorld
from ..world.mounts import MOUNT, read_frame, read_surface
from .sensor import Carrier, CompiledSensor, SensorSpec, create_sampler

Quantity = Literal["depth", "pressure", "gauge"]
"""A measured quantity: depth below the surface [m], absolute pressure or gauge pressure [Pa]."""
STANDARD_ATMOSPHERE = 101325.0
"""The pressure of the standard atmosphere [Pa]."""


@dataclass(frozen=True, kw_only=True)
class PressureSensorSpec(SensorSpec):
    """A ``<pressureSensor>``."""

    message_type: ClassVar[type] = Pressure

    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """The position of the sensor in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """The orientation of the sensor in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    std: float = element(default=0.0, minimum=0, maximum=1e6)
    """The standard deviation of the noise of the measured quantity [m], or [Pa]."""
    measures: Quantity = element(namespaced=True, default="depth")
    """The measured quantity: ``depth`` below the surface [m], absolute ``pressure`` [Pa], or
    ``gauge`` pressure, relative to that of the air [Pa]."""
    atmosphere: float = element(
        namespaced=True, default=STANDARD_ATMOSPHERE, minimum=0, maximum=1e7
    )
    """The pressure of the air at the surface [Pa]."""

    def bind(self, world: SensorWorld, vehicle: Carrier) -> PressureSensor:
        """Mount the sensor on its link; raise UnknownName if the vehicle has no such link."""
        rng = world.stream(f"{vehicle.name}/{self.name}/noise")
        return PressureSensor(self, vehicle.mount(self), world, rng)


PRESSURE = np.dtype(
    [
        ("mount", MOUNT),
        ("stream", STREAM),
        ("std", np.float64),  # of the noise [m or Pa]
        ("measures", np.int64),  # DEPTH, PRESSURE_ABSOLUTE, PRESSURE_GAUGE or HEIGHT
        ("surface", np.float64),  # height of the still surface in W [m]
        ("waves", FUNCTION),  # see `read_surface`
        ("atmosphere", np.float64),  # [Pa]
        ("levels", np.int64),  # the address of depths [m] and densities [kg/m3], (n, 2)
        ("n_levels", np.int64),
        ("upward", np.float64, 3),  # the z axis of L in W
        ("origin", np.float64),  # z of the origin of W in L [m]
    ]
)
"""The parameters of a pressure sensor, for compiled code."""
DEPTH, PRESSURE_ABSOLUTE, PRESSURE_GAUGE, HEIGHT = range(4)
"""The measured quantities; HEIGHT is z in L, which the original UWSim measures (``pressure-z``)."""


class PressureSensor(CompiledSensor):
    """A pressure sensor; its message contains a depth or a pressure."""

    def __init__(
        self,
        spec: PressureSensorSpec,
        mount: Mount,
        world: SensorWorld,
        rng: np.random.Generator,
    ) -> None:
        self.state = RandomState(rng)
        """The state: the generator of the noise."""
        measures_height = "pressure-z" in world.compatibility
        self._frame_id = "world" if measures_height else spec.name
        row, levels = np.zeros(1, PRESSURE), np.array(world.density_levels, dtype=np.float64)
        row["mount"], row["stream"], row["std"] = mount.functions, stream_of(rng), spec.std
        measures = {"depth": DEPTH, "pressure": PRESSURE_ABSOLUTE, "gauge": PRESSURE_GAUGE}[
            spec.measures
        ]
        row["measures"] = HEIGHT if measures_height else measures
        row["surface"], row["atmosphere"] = world.surface.height, spec.atmosphere
        row["waves"] = world.surface.wave_addresses
        row["levels"], row["n_levels"] = address_of(levels), len(levels)
        localized_from_world = world.world_from_localized.inverse()
        row["upward"] = localized_from_world.rotation[2]
        row["origin"] = localized_from_world.position[2]
        self.sampler = create_sampler(
            mount, sample_pressure, row, 1, (self.state, levels, world.surface)
        )
        """The sampler that takes samples in compiled code."""

    def message(self, time: float, values: Array) -> Pressure:
        """Return the message of a sample at ``time`` [s]."""
        return Pressure(header=header(time, self._frame_id), pressure=float(values[0]))


def sample_pressure(parameters: int, values: int, time: float) -> None:
    """Take a sample of a pressure sensor; see `uwsim.base.numerics.calls`."""
    sensor = carray(pointer(parameters), (1,), PRESSURE)[0]
    view_doubles(values, 1)[0] = compute_noise_free_value(sensor, time) + sensor.std * normal(
        sensor.stream
    )


@njit
def compute_noise_free_value(sensor: Any, time: float) -> float:
    """Return the measured quantity without noise [m, or Pa]."""
    frame = np.empty(12)
    read_frame(sensor.mount, frame)
    if sensor.measures == HEIGHT:
        up = sensor.upward
        height: float = up[0] * frame[0] + up[1] * frame[1] + up[2] * frame[2] + sensor.origin
        return height
    elevation, wave_pressure = read_surface(sensor.waves, frame, time)
    signed_depth = sensor.surface - frame[2]
    if signed_depth <= -elevation:  # above the surface
        signed_depth, wave_pressure = 0.0, 0.0
    if sensor.measures == DEPTH:
        depth: float = signed_depth + wave_pressure / GRAVITY
        return depth if depth > 0.0 else 0.0
    levels = view_doubles(sensor.levels, 2 * sensor.n_levels).reshape((-1, 2))
    mass = column_mass(levels, signed_depth) if signed_depth > 0.0 else levels[0, 1] * signed_depth
    gauge: float = GRAVITY * mass + levels[0, 1] * wave_pressure
    gauge = gauge if gauge > 0.0 else 0.0
    return gauge if sensor.measures == PRESSURE_GAUGE else sensor.atmosphere + gauge


@njit
def column_mass(levels: Array, depth: float) -> float:
    """Return the mass of the water column from the surface to a depth, per area [kg/m2].

    Args:
        levels: rising depths [m] and the densities there [kg/m3], (n, 2); the density is linear
            between levels, and constant above the first and below the last.
        depth: the depth below the surface, at least 0 [m].
    """
    total, n = 0.0, len(levels)
    for i in range(n + 1):
        top, top_density = (0.0, levels[0, 1]) if i == 0 else (levels[i - 1, 0], levels[i - 1, 1])
        bottom, bottom_density = (
            (levels[i, 0], levels[i, 1]) if i < n else (depth, levels[n - 1, 1])
        )
        if i == n and bottom < levels[n - 1, 0]:
            bottom = levels[n - 1, 0]
        if bottom <= top or top >= depth:
            continue
        low = min(bottom, depth)
        low_density = top_density + (bottom_density - top_density) * (low - top) / (bottom - top)
        total += 0.5 * (top_density + low_density) * (low - top)
    return total

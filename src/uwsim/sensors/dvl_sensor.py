"""Velocity over ground and through the water, by four beams of sound.

.. code-block:: xml

    <dvlSensor>
      <name>dvlSensor</name> <relativeTo>base_link</relativeTo> <std>0</std>
      <u:beamStd>0.005</u:beamStd> <u:rangeStd>0.02</u:rangeStd> <u:dropout>0.01</u:dropout>
    </dvlSensor>

The z axis of the sensor is the middle of its beams and looks down. A beam finds the first surface
on its axis, but for those of its own vehicle. See `uwsim.sensors.janus` for its geometry, and
`uwsim.sensors.dvl_message` for what is published.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.calls import CompiledFunction, address_of, function_address
from ..base.numerics.draws import stream_of
from ..base.numerics.linear import product
from ..base.record import Record
from ..base.sampling import Sampler
from ..messages import DVL, header
from ..schema import MAX_DISTANCE, element
from ..world import MovingBody, SensorWorld
from . import dvl_kernel as kernel
from .dvl_message import dvl_message
from .janus import Flags, Janus
from .sensor import Carrier, CompiledSensor, LookAt, SensorSpec


@dataclass(frozen=True, kw_only=True)
class DvlSensorSpec(SensorSpec):
    """A ``<dvlSensor>``."""

    message_type: ClassVar[type] = DVL

    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """Of the sensor in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """Of the sensor in the link's frame, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""
    look_at: LookAt = element(namespaced=True, default=None)
    """Where its z axis points at the start, instead of ``orientation``: a point in L [m], or a
    direction of the vehicle. Its x axis then is the top of what a camera would see: forward for
    ``down``. It stays fixed to its link."""
    std: float = element(default=0.0, minimum=0, maximum=10)
    """Noise of each component, standard deviation [m/s]."""
    beam_angle: float = element(namespaced=True, default=30.0, above=0, maximum=60)
    """From the z axis of the sensor to each beam [deg]."""
    min_altitude: float = element(namespaced=True, default=0.5, minimum=0, maximum=MAX_DISTANCE)
    """Nearest bottom, along the z axis of the sensor [m]."""
    max_altitude: float = element(namespaced=True, default=81.0, above=0, maximum=MAX_DISTANCE)
    """Farthest bottom, along the z axis of the sensor [m]."""
    beam_std: float = element(namespaced=True, default=0.0, minimum=0, maximum=10)
    """Noise along each beam on the bottom, standard deviation [m/s]."""
    scale_std: float = element(namespaced=True, default=0.0, minimum=0, maximum=1)
    """Constant error of each beam in a run, of its velocity; standard deviation [1]."""
    water_std: float | None = element(namespaced=True, default=None, minimum=0, maximum=10)
    """Noise along each beam in the water [m/s]; three times that on the bottom if not given."""
    range_std: float = element(namespaced=True, default=0.0, minimum=0, maximum=1000)
    """Noise of each range, standard deviation [m]."""
    dropout: float = element(namespaced=True, default=0.0, minimum=0, maximum=1)
    """Probability that a beam hears nothing of a ping [1]."""
    water_layer: float = element(namespaced=True, default=2.0, above=0, maximum=MAX_DISTANCE)
    """Where the water is tracked, along the z axis of the sensor [m]."""

    def is_bottom(self, axial: Array) -> Flags:
        """Whether beams have the bottom in their reach, by the distance along the z axis [m]."""
        found: Flags = (axial >= self.min_altitude) & (axial <= self.max_altitude)
        return found

    def bind(self, world: SensorWorld, vehicle: Carrier) -> Dvl:
        """Mount it on its link; raises UnknownName if the vehicle has no such link."""
        return Dvl(self, vehicle.moving_mount(self), world, vehicle)


@dataclass(slots=True)
class TrackState(Record):
    """What is known of the velocity over one thing."""

    numbers: Array
    """The velocity in the axes of the sensor and in W [m/s], the error velocity [m/s], east, north
    and up since the beginning over the time with a velocity [m], when the last ping was, NaN before
    the first, and when there was a velocity last [s], (12,)."""

    @staticmethod
    def unknown() -> TrackState:
        """Return that of a sensor that has not pinged."""
        numbers = np.full(kernel.N_TRACK, math.nan)
        numbers[kernel.MADE_GOOD : kernel.TIME], numbers[kernel.LAST] = 0.0, 0.0
        return TrackState(numbers)


@dataclass(slots=True)
class DvlState(Record):
    """What changes of a Doppler velocity log."""

    random: np.random.Generator
    """The generator of its noise."""
    scale: Array
    """The scale of each beam, drawn once, (4,) [1]."""
    bottom: TrackState
    """The velocity over the bottom."""
    water: TrackState
    """The velocity through the water."""
    before: Array
    """When the original's looked last, NaN before the first time [s], and its place in W [m]."""


class Dvl(CompiledSensor):
    """A Doppler velocity log."""

    def __init__(
        self, spec: DvlSensorSpec, mount: MovingBody, world: SensorWorld, vehicle: Carrier
    ) -> None:
        self._spec, self._mount, self._world, self._vehicle = spec, mount, world, vehicle
        self._base = vehicle.compiled_vehicle.base_mount()
        self._janus = Janus(math.radians(spec.beam_angle))
        random = world.stream(f"{vehicle.name}/{spec.name}/noise")
        scale = 1.0 + spec.scale_std * random.standard_normal(4)
        bottom, water = TrackState.unknown(), TrackState.unknown()
        self.state = DvlState(random, scale, bottom, water, np.full(4, math.nan))
        """What changes of it."""
        self._is_original = "dvl-differences" in world.compatibility
        self._flow = np.zeros((4, 3))  # of the water at the beams, in W, if Python is asked [m/s]
        self._is_own = np.array([each == vehicle.name for each in world.rays.vehicles], np.uint8)
        self._row = self._parameters()
        self._water: CompiledFunction | None = None  # what the row has the addresses of
        self.sampler = Sampler(
            function=function_address(kernel.sample_dvl),
            parameters=self._row,
            n_values=kernel.N_VALUES,
            prepare=self._prepare,
            is_alone=self._is_alone,
        )
        """What takes the numbers of a sample."""

    def _parameters(self) -> npt.NDArray[np.void]:
        """Return what compiled code has to know of it, a record of `dvl_kernel.DVL`, (1,)."""
        spec, janus, state, row = self._spec, self._janus, self.state, np.zeros(1, kernel.DVL)
        row["mount"], row["base"] = self._mount.functions, self._base.functions
        row["rays"], row["stream"] = self._world.rays.functions, stream_of(state.random)
        row["directions"], row["cosine"] = janus.directions, janus.cosine
        row["error_share"] = janus.error_share
        row["std"], row["beam_std"], row["range_std"] = spec.std, spec.beam_std, spec.range_std
        row["water_std"] = 3.0 * spec.beam_std if spec.water_std is None else spec.water_std
        row["dropout"], row["water_layer"] = spec.dropout, spec.water_layer
        row["min_altitude"], row["max_altitude"] = spec.min_altitude, spec.max_altitude
        row["surface"], row["is_original"] = self._world.surface_height, self._is_original
        row["is_own"], row["flow"] = address_of(self._is_own), address_of(self._flow)
        row["scale"], row["before"] = address_of(state.scale), address_of(state.before)
        row["bottom"] = address_of(state.bottom.numbers)
        row["through"] = address_of(state.water.numbers)
        return row

    def _is_alone(self, until: float) -> bool:
        """Whether samples until a time [s] need no preparation."""
        if not (self._mount.is_compiled and self._base.is_compiled):
            return False
        return self._is_original or (self._world.rays.is_compiled and self._has_water(until))

    def _has_water(self, until: float) -> bool:
        """Let compiled code read the water until a time [s]; whether it can."""
        water = self._world.compiled_water(self._vehicle.name, len(self._flow))
        if water is not self._water:
            self._water = water
            self._row["water"] = (0, 0) if water is None else water.addresses
        if water is not None:
            water.prepare(until)
        return water is not None

    def _prepare(self, time: float) -> None:
        """Look up where everything is, and how the water moves at ``time`` [s]."""
        self._mount.prepare()
        self._base.prepare()
        if self._is_original:
            return
        self._world.rays.prepare()
        if not self._has_water(time):
            pose, reach = self._mount.world_from_body, self._spec.water_layer / self._janus.cosine
            points = pose.position + reach * product(self._janus.directions, pose.rotation.T)
            self._flow[:] = self._world.water_velocity(points, time, self._vehicle.name)

    def message(self, time: float, values: Array) -> DVL:
        """Make the message of a sample taken at ``time`` [s]."""
        if self._is_original:
            x, y, z = values[:3].tolist()
            return DVL(bi_x_axis=x, bi_y_axis=y, bi_z_axis=z)
        spec = self._spec
        return dvl_message(
            header(time, spec.name),
            values,
            water=self._world.sea_water,
            water_layer=spec.water_layer,
        )

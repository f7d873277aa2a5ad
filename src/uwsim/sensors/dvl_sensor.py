"""Velocity over ground and through the water, measured along four acoustic beams.

.. code-block:: xml

    <dvlSensor>
      <name>dvlSensor</name> <relativeTo>base_link</relativeTo> <std>0</std>
      <u:beamStd>0.005</u:beamStd> <u:rangeStd>0.02</u:rangeStd> <u:dropout>0.01</u:dropout>
    </dvlSensor>

The z axis of the sensor is the middle of its beams and points down. A beam measures on the first
surface along its axis that is not a part of its own vehicle. See `uwsim.sensors.janus` for the
geometry of the beams, and `uwsim.sensors.dvl_message` for the message.
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
    """The position of the sensor in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """The orientation of the sensor in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    look_at: LookAt = element(namespaced=True, default=None)
    """The target of the z axis at the start, instead of ``orientation``: a point in L [m], or a
    direction of the vehicle. The x axis points where the top of a camera's image does: forward for
    ``down``. The sensor stays fixed to its link."""
    std: float = element(default=0.0, minimum=0, maximum=10)
    """The standard deviation of the noise of each component of a velocity [m/s]."""
    beam_angle: float = element(namespaced=True, default=30.0, exclusive_minimum=0, maximum=60)
    """The angle from the z axis of the sensor to each beam [deg]."""
    min_altitude: float = element(namespaced=True, default=0.5, minimum=0, maximum=MAX_DISTANCE)
    """The minimum distance to the seabed, along the z axis of the sensor [m]."""
    max_altitude: float = element(
        namespaced=True, default=81.0, exclusive_minimum=0, maximum=MAX_DISTANCE
    )
    """The greatest distance to the seabed, along the z axis of the sensor [m]."""
    beam_std: float = element(namespaced=True, default=0.0, minimum=0, maximum=10)
    """The standard deviation of the noise of the velocity over the seabed along each beam [m/s]."""
    scale_std: float = element(namespaced=True, default=0.0, minimum=0, maximum=1)
    """The standard deviation of the constant scale error of each beam's velocity in a run [1]."""
    water_std: float | None = element(namespaced=True, default=None, minimum=0, maximum=10)
    """The standard deviation of the noise of the velocity through the water along each beam [m/s];
    by default three times ``beamStd``."""
    range_std: float = element(namespaced=True, default=0.0, minimum=0, maximum=1000)
    """The standard deviation of the noise of each range [m]."""
    dropout: float = element(namespaced=True, default=0.0, minimum=0, maximum=1)
    """The probability that a beam receives no echo of a ping [1]."""
    water_layer: float = element(
        namespaced=True, default=2.0, exclusive_minimum=0, maximum=MAX_DISTANCE
    )
    """The distance to the tracked layer of water, along the z axis of the sensor [m]."""

    def is_bottom(self, axial_distances: Array) -> Flags:
        """Return True for beams that detect the seabed at distances along the z axis [m]."""
        is_far_enough: Flags = axial_distances >= self.min_altitude
        return is_far_enough & (axial_distances <= self.max_altitude)

    def bind(self, world: SensorWorld, vehicle: Carrier) -> Dvl:
        """Mount the sensor on its link; raise UnknownName if the vehicle has no such link."""
        return Dvl(self, vehicle.moving_mount(self), world, vehicle)


@dataclass(slots=True)
class TrackState(Record):
    """A bottom track or a water track: the velocity over the seabed, or through the water."""

    numbers: Array
    """The velocity in the sensor's frame (3) and in W (3) [m/s], the error velocity [m/s], the
    distance made good along x, y and z of W (3) [m], the time of the last ping [s], NaN before the
    first, and the time of the last valid velocity [s], (12,)."""

    @staticmethod
    def create() -> TrackState:
        """Return the state before the first ping."""
        numbers = np.full(kernel.N_TRACK, math.nan)
        numbers[kernel.MADE_GOOD : kernel.TIME], numbers[kernel.LAST_VALID] = 0.0, 0.0
        return TrackState(numbers)


@dataclass(slots=True)
class DvlState(Record):
    """The state of a Doppler velocity log."""

    rng: np.random.Generator
    """The generator of the noise."""
    scale: Array
    """The scale factor of each beam's velocity, drawn once, (4,) [1]."""
    bottom: TrackState
    """The bottom track."""
    water: TrackState
    """The water track."""
    last_sample: Array
    """The time of the last sample [s], NaN before the first, and the position of the sensor in W at
    that time (3) [m], (4,); written only with the quirk ``dvl-differences``."""


class Dvl(CompiledSensor):
    """A Doppler velocity log."""

    def __init__(
        self, spec: DvlSensorSpec, mount: MovingBody, world: SensorWorld, vehicle: Carrier
    ) -> None:
        self._spec, self._mount, self._world, self._vehicle = spec, mount, world, vehicle
        self._base = vehicle.compiled_vehicle.base_mount()
        self._janus = Janus(math.radians(spec.beam_angle))
        rng = world.stream(f"{vehicle.name}/{spec.name}/noise")
        scale = 1.0 + spec.scale_std * rng.standard_normal(4)
        bottom, water = TrackState.create(), TrackState.create()
        self.state = DvlState(rng, scale, bottom, water, np.full(4, math.nan))
        """The state: the tracks, the scale factors, and the generator of the noise."""
        self._measures_differences = "dvl-differences" in world.compatibility
        self._flow = np.zeros((4, 3))  # water velocity on the beams in W, set by `_prepare` [m/s]
        self._is_own = np.array([name == vehicle.name for name in world.rays.vehicles], np.uint8)
        self._row = self._create_parameters()
        self._water: CompiledFunction | None = None  # whose addresses `_row` has
        self.sampler = Sampler(
            function=function_address(kernel.sample_dvl),
            parameters=self._row,
            n_values=kernel.N_VALUES,
            prepare=self._prepare,
            can_skip_prepare=self._can_skip_prepare,
        )
        """The sampler that takes samples in compiled code."""

    def _create_parameters(self) -> npt.NDArray[np.void]:
        """Return the parameters for compiled code, a record of `dvl_kernel.DVL`, (1,)."""
        spec, janus, state, row = self._spec, self._janus, self.state, np.zeros(1, kernel.DVL)
        row["mount"], row["base"] = self._mount.functions, self._base.functions
        row["rays"], row["stream"] = self._world.rays.functions, stream_of(state.rng)
        row["directions"], row["cosine"] = janus.directions, janus.cosine
        row["error_scale"] = janus.error_scale
        row["std"], row["beam_std"], row["range_std"] = spec.std, spec.beam_std, spec.range_std
        row["water_std"] = 3.0 * spec.beam_std if spec.water_std is None else spec.water_std
        row["dropout"], row["water_layer"] = spec.dropout, spec.water_layer
        row["min_altitude"], row["max_altitude"] = spec.min_altitude, spec.max_altitude
        row["surface"], row["measures_differences"] = (
            self._world.surface.height,
            self._measures_differences,
        )
        row["is_own"], row["flow"] = address_of(self._is_own), address_of(self._flow)
        row["scale"], row["last_sample"] = address_of(state.scale), address_of(state.last_sample)
        row["bottom_track"] = address_of(state.bottom.numbers)
        row["water_track"] = address_of(state.water.numbers)
        return row

    def _can_skip_prepare(self, end_time: float) -> bool:
        """Return True if samples until a time [s] need no preparation."""
        if not (self._mount.is_compiled and self._base.is_compiled):
            return False
        return self._measures_differences or (
            self._world.rays.is_compiled and self._prepare_water(end_time)
        )

    def _prepare_water(self, end_time: float) -> bool:
        """Prepare the compiled function of the water's velocity until a time [s], if there is one.

        Returns:
            True if there is such a function; otherwise `_prepare` sets the velocities.
        """
        water = self._world.compiled_water(self._vehicle.name, len(self._flow))
        if water is not self._water:
            self._water = water
            self._row["water_function"] = (0, 0) if water is None else water.addresses
        if water is not None:
            water.prepare(end_time)
        return water is not None

    def _prepare(self, time: float) -> None:
        """Update the poses, and the water's velocity at ``time`` [s], for compiled code."""
        self._mount.prepare()
        self._base.prepare()
        if self._measures_differences:
            return
        self._world.rays.prepare()
        if not self._prepare_water(time):
            pose, reach = self._mount.world_from_body, self._spec.water_layer / self._janus.cosine
            points = pose.position + reach * product(self._janus.directions, pose.rotation.T)
            self._flow[:] = self._world.water_velocity(points, time, self._vehicle.name)

    def message(self, time: float, values: Array) -> DVL:
        """Return the message of a sample at ``time`` [s]."""
        if self._measures_differences:
            x, y, z = values[:3].tolist()
            return DVL(bi_x_axis=x, bi_y_axis=y, bi_z_axis=z)
        spec = self._spec
        return dvl_message(
            header(time, spec.name),
            values,
            water=self._world.sea_water,
            water_layer=spec.water_layer,
        )

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

from ..base.geometry import Array, Pose
from ..base.numerics.linear import product, turned_back
from ..base.record import Record
from ..messages import DVL, header
from ..schema import MAX_DISTANCE, element
from ..world import MovingBody, SensorWorld
from .dvl_message import Track, TrackState, dvl_message
from .janus import Flags, Janus
from .sensor import Carrier, LookAt, SensorSpec

THROUGH = 1e-6
"""How far behind a surface of its own vehicle a beam goes on [m]."""
MAX_OWN = 32
"""Surfaces of its own vehicle that a beam goes through at most."""


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
    before: tuple[float, tuple[float, ...]] | None = None
    """When the original's looked last [s], and where it was in W [m]."""


class Dvl:
    """A Doppler velocity log."""

    def __init__(
        self, spec: DvlSensorSpec, mount: MovingBody, world: SensorWorld, vehicle: Carrier
    ) -> None:
        self._spec, self._mount, self._world, self._vehicle = spec, mount, world, vehicle
        self._janus = Janus(math.radians(spec.beam_angle))
        random = world.stream(f"{vehicle.name}/{spec.name}/noise")
        scale = 1.0 + spec.scale_std * random.standard_normal(4)
        self._bottom, self._water = Track(), Track()
        self.state = DvlState(random, scale, self._bottom.state, self._water.state)
        """What changes of it."""
        self._is_original = "dvl-differences" in world.compatibility

    def sample(self, time: float) -> DVL:
        """Ping now, at ``time`` [s]."""
        pose = self._mount.world_from_body
        draws = self.state.random.standard_normal((4, 4)), self.state.random.random(4)
        if self._is_original:
            x, y, z = (self._difference(pose, time) + self._spec.std * draws[0][3, :3]).tolist()
            return DVL(bi_x_axis=x, bi_y_axis=y, bi_z_axis=z)
        return self._ping(pose, time, *draws)

    def _ping(self, pose: Pose, time: float, normal: Array, uniform: Array) -> DVL:
        """Measure with these random numbers, (4, 4) and (4,)."""
        spec, janus, world = self._spec, self._janus, self._world
        ranges = self.ranges(pose)
        is_heard = uniform >= spec.dropout
        is_good = is_heard & spec.is_bottom(ranges * janus.cosine)
        velocity = turned_back(pose.rotation, self._mount.motion().velocity)
        on_bottom = product(janus.directions, velocity)
        along = self.state.scale * on_bottom + spec.beam_std * normal[0]
        through, is_wet = self._along_water(pose, time, on_bottom, ranges)
        water_std = 3.0 * spec.beam_std if spec.water_std is None else spec.water_std
        through = self.state.scale * through + water_std * normal[1]
        noise = spec.std * normal[3, :3]
        ranges = np.where(is_good, ranges + spec.range_std * normal[2], math.nan)
        self._bottom.take(time, pose, janus.velocity(along, is_good), noise)
        self._water.take(time, pose, janus.velocity(through, is_heard & is_wet), noise)
        down = -product(janus.directions, pose.rotation[2])  # drop of each beam over its length [1]
        heights = (ranges * down)[is_good]
        depth = world.surface_height - float(pose.position[2])
        return dvl_message(
            header(time, spec.name),
            (self._bottom, self._water),
            heights=(float(heights.mean()) if heights.size else math.nan, spec.water_layer),
            ship_from_world=self._vehicle.world_from_base.rotation.T,
            water=world.sea_water,
            depth=max(0.0, depth),
            beams=(ranges, np.where(is_good, along, math.nan)),
        )

    def ranges(self, pose: Pose) -> Array:
        """Return the distances along the beams to what is not the vehicle, (4,) [m]; inf: none."""
        reach = self._spec.max_altitude / self._janus.cosine + 1.0
        begins, found = np.zeros(4), np.full(4, math.inf)
        waiting = np.arange(4)
        own = self._world.rays.vehicles
        for _ in range(MAX_OWN):
            directions = np.ascontiguousarray(self._janus.directions[waiting])
            hits = self._world.rays.cast(pose, directions, reach, begins[waiting])
            is_own = np.array([s >= 0 and own[s] == self._vehicle.name for s in hits.surface])
            found[waiting[~is_own]] = hits.distance[~is_own]
            begins[waiting[is_own]] = hits.distance[is_own] + THROUGH
            waiting = waiting[is_own]
            if not len(waiting):
                break
        return found

    def _along_water(
        self, pose: Pose, time: float, over_ground: Array, ranges: Array
    ) -> tuple[Array, Flags]:
        """Velocities through the water along the beams (4,) [m/s], and where there is water."""
        reach = self._spec.water_layer / self._janus.cosine
        beams = product(self._janus.directions, pose.rotation.T)  # in W
        points = pose.position + reach * beams
        flow = self._world.water_velocity(points, time, self._vehicle.name)
        is_wet = (ranges > reach) & (points[:, 2] < self._world.surface_height)
        return over_ground - (beams * flow).sum(axis=1), is_wet

    def _difference(self, pose: Pose, time: float) -> Array:
        """The mean velocity since the last sample in the sensor's axes, as the original has it."""
        before, self.state.before = self.state.before, (time, tuple(pose.position.tolist()))
        if before is None or time <= before[0]:
            return np.zeros(3)
        moved = pose.position - np.array(before[1])
        return turned_back(pose.rotation, moved / (time - before[0]))

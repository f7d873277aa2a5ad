"""A fan of beams in the sensor's y-z plane.

.. code-block:: xml

    <multibeamSensor underwaterParticles="false">
      <name>multibeam</name> <relativeTo>part0</relativeTo>
      <initAngle>-60</initAngle> <finalAngle>60</finalAngle> <angleIncr>0.1</angleIncr>
      <range>10</range>
    </multibeamSensor>

A beam at the angle t points along (0, sin t, -cos t). Its range is that of the first surface. With
a beam width, the range is the mean over the insonified surface, weighted by the beam
pattern, as in bottom detection by amplitude. If the beam covers two surfaces, one behind the other,
the range is that of the surface that covers more of the beam.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.record import RandomState
from ...messages import LaserScan, header
from ...schema import MAX_DISTANCE, element
from ...world import Body, SensorWorld
from ..pencil import pencil_rays
from ..sensor import SCAN_AXES, Carrier, LookAt, SensorSpec
from .multibeam_images import DepthImages


@dataclass(frozen=True, kw_only=True)
class FanSpec(SensorSpec):
    """The shared spec of multibeam and profiling sonars."""

    frame_rpy: ClassVar[tuple[float, float, float]] = SCAN_AXES
    message_type: ClassVar[type] = LaserScan

    visible: bool = False
    """True if the viewer draws the beams."""
    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """The position of the sensor in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """The orientation of the sensor in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    look_at: LookAt = element(namespaced=True, default=None)
    """The viewing target at the start, instead of ``orientation``: a point in L [m], or a direction
    of the vehicle. The sensor stays fixed to its link."""
    init_angle: float
    """The angle of the first beam; 0 is -z, positive towards +y [deg]."""
    final_angle: float
    """The angle of the last beam [deg]."""
    angle_incr: float = element(exclusive_minimum=0)
    """The angle between beams [deg]."""
    range: float = element(exclusive_minimum=0, maximum=MAX_DISTANCE)
    """The longest measured distance, which is also the value of a beam without a hit [m]."""
    beam_width: float = element(namespaced=True, default=0.0, minimum=0, maximum=30)
    """The width of each round beam at -3 dB [deg]; 0: a single ray."""
    std: float = element(namespaced=True, default=0.0, minimum=0, maximum=1000)
    """The standard deviation of the noise of each range [m]."""

    @property
    def camera_field(self) -> float:
        """The largest field of view of each depth camera of the original UWSim [deg]."""
        return 120.0

    @property
    def n_beams(self) -> int:
        """The number of beams, as in the original UWSim."""
        return int(abs(self.final_angle - self.init_angle) / self.angle_incr) + 1

    def bind(self, world: SensorWorld, vehicle: Carrier) -> BeamFan:
        """Mount the sensor on its link; raise UnknownName if the vehicle has no such link."""
        mount = vehicle.mount(self, visual="visual-frames" in world.compatibility)
        return BeamFan(self, mount, world, world.stream(f"{vehicle.name}/{self.name}/noise"))


@dataclass(frozen=True, kw_only=True)
class MultibeamSensorSpec(FanSpec):
    """A ``<multibeamSensor>``."""

    underwater_particles: bool = element(attribute=True, default=False)
    """An attribute that is read but not used: there are no particles in the water."""


class BeamFan:
    """A sensor of the ranges of adjacent beams, as sensor_msgs/LaserScan."""

    def __init__(
        self, spec: FanSpec, mount: Body, world: SensorWorld, rng: np.random.Generator
    ) -> None:
        self._spec, self._mount, self._world = spec, mount, world
        self.state = RandomState(rng)
        """The state: the generator of the noise."""
        sign = 1.0 if spec.final_angle >= spec.init_angle else -1.0
        self._first_angle = math.radians(spec.init_angle)
        self._step = sign * math.radians(spec.angle_incr)
        angles: Array = self._first_angle + self._step * np.arange(spec.n_beams, dtype=np.float64)
        axes = np.stack([np.zeros(len(angles)), np.sin(angles), -np.cos(angles)], axis=1)
        normals = np.broadcast_to([1.0, 0.0, 0.0], axes.shape)
        rays, self._weights = pencil_rays(axes, normals, math.radians(spec.beam_width))
        self._rays = np.ascontiguousarray(rays.reshape(-1, 3))
        self._images: DepthImages | None = None
        if "multibeam-images" in world.compatibility:
            field = math.radians(spec.camera_field)
            self._images = DepthImages(angles, self._step, field, spec.range)

    def sample(self, time: float) -> LaserScan:
        """Measure at ``time`` [s]."""
        spec = self._spec
        ranges = self._ranges()
        if spec.std > 0.0:
            noise = spec.std * self.state.rng.standard_normal(len(ranges))
            ranges = np.where(ranges < spec.range, ranges + noise, ranges)
        n_steps = len(ranges) - 1
        return LaserScan(
            header=header(time, spec.name),
            angle_min=self._first_angle,
            angle_max=self._first_angle + self._step * n_steps,
            angle_increment=self._step,
            range_max=spec.range,
            ranges=np.clip(ranges, 0.0, spec.range).astype(np.float32),
        )

    def _ranges(self) -> Array:
        """Return the ranges without noise, (n,) [m]; without a hit the greatest range."""
        reach = self._spec.range
        if self._images is not None:
            image_ranges = self._images.ranges(self._world.rays, self._mount.world_from_body)
            return np.minimum(image_ranges, reach)
        hits = self._world.rays.cast(self._mount.world_from_body, self._rays, reach)
        distances = hits.distance.reshape(-1, len(self._weights))
        if len(self._weights) == 1:
            return np.minimum(distances[:, 0], reach)
        is_hit = find_surface_rays(distances, self._weights, math.radians(self._spec.beam_width))
        weights = np.where(is_hit, self._weights, 0.0).sum(axis=1)
        total = np.where(is_hit, self._weights * np.where(is_hit, distances, 0.0), 0.0).sum(axis=1)
        ranges: Array = np.where(weights > 0.0, total / np.maximum(weights, 1e-300), reach)
        return ranges


def find_surface_rays(distances: Array, weights: Array, width: float) -> npt.NDArray[np.bool_]:
    """Return the rays of each beam on the surface that covers most of the beam, (n, k).

    The sorted distances of a beam are split at their largest gap, if it is greater than half their
    spread and than :math:`r w^2`, the range variation of a flat surface within the beam. On one
    sloping surface, gaps are smaller. The part with more weight remains, and is split again.

    Args:
        distances: the distances of the rays of each beam; inf without a hit, (n, k) [m].
        weights: the weights of the rays, (k,).
        width: the width of a beam [rad].
    """
    is_hit = np.isfinite(distances)
    for beam in np.flatnonzero(is_hit.sum(axis=1) > 1).tolist():
        rays = np.flatnonzero(is_hit[beam])
        while len(rays) > 1:
            rays = rays[np.argsort(distances[beam, rays], kind="stable")]
            ray_distances = distances[beam, rays]
            gaps = np.diff(ray_distances)
            gap_index = int(np.argmax(gaps))
            spread = ray_distances[-1] - ray_distances[0]
            if gaps[gap_index] <= 0.5 * spread or gaps[gap_index] <= ray_distances[0] * width**2:
                break
            near, far = rays[: gap_index + 1], rays[gap_index + 1 :]
            rays = near if weights[near].sum() >= weights[far].sum() else far
            is_hit[beam] = False
            is_hit[beam, rays] = True
    return is_hit

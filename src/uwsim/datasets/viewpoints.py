r"""Camera poses around the vehicles and objects of a scene.

A pose looks at a target from a distance d, an azimuth and an elevation, with a small roll. The
camera aims at a random point of the target's middle, so that targets are not always in the centre
of the image. A pose is drawn again until it is useful:

- the camera is in the water, and at least the clearance from every surface in 26 directions;
- no surface is between the target and the camera, seen from the target: the camera is not inside
  an object, whose surfaces are seen from outside only;
- a sufficient share of points of the target's surface projects into the image, and rays from the
  camera to a sufficient share of these hit the target first.

Rays are cast exactly (`uwsim.rays`), so that poses do not depend on a graphics driver.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array, Intrinsics, Pose, rotation_z
from ..base.numerics.linear import length, product
from ..errors import RunFailed
from ..scene.mounts import camera_axes
from ..simulation import Simulation
from .instances import Instance, InstanceTable
from .request import DatasetRequest, Range

MAX_ATTEMPTS = 400
"""The number of poses that are drawn before a target is given up."""
MIN_FRAMED = 0.5
"""The least share of the points of a target that project into the image [1]."""
MIN_DEPTH = 0.05
"""The least depth of the camera below the surface of the water [m]."""
DEFAULT_NEAREST, DEFAULT_FARTHEST = 1.3, 4.0
"""The default distances, over the distance at which the target fills the height of the image."""
SONAR_NEAREST = 4.0
"""The least default distance of a sonar, over the half diagonal of the target [1]."""
SONAR_FARTHEST = 4.0
"""The greatest default distance of a sonar, over the least [1]."""
AIM_SHARE = 0.5
"""The share of the half edges of a target's box within which the camera aims [1]."""
HIT_TOLERANCE = 0.02
"""The distance by which a ray may end before a point that it reaches [m]."""
UP = np.array([0.0, 0.0, 1.0])
"""The upward direction in W, (3,)."""


def _directions() -> Array:
    cube = [d for d in itertools.product((-1.0, 0.0, 1.0), repeat=3) if d != (0.0, 0.0, 0.0)]
    return np.array([np.array(d) / length(d) for d in cube])


CLEARANCE_DIRECTIONS = _directions()
"""The directions in which the clearance is measured, unit vectors (26, 3)."""


@dataclass(frozen=True, eq=False)
class Viewpoint:
    """A useful pose of the camera."""

    world_from_camera: Pose
    """The pose of the camera in W; OpenGL axes."""
    target: str
    """The name of the instance that the camera views."""
    distance: float
    """The distance to the centre of the target [m]."""


class ViewpointSampler:
    """The choice of camera poses in a scene at its present poses.

    Args:
        simulation: the scene.
        table: its instances.
        request: the request, with the targets and the ranges.
        intrinsics: the camera, or the frame of a sonar.
        reach: the range of a sonar [m]; None: a camera.
    """

    def __init__(
        self,
        simulation: Simulation,
        table: InstanceTable,
        request: DatasetRequest,
        intrinsics: Intrinsics,
        reach: float | None = None,
    ) -> None:
        self._reach = reach
        self._rays = simulation.world.rays
        self._surface_height = simulation.world.model.scene.ocean_state.ocean_surface_height
        self._table, self._request, self._intrinsics = table, request, intrinsics
        self._targets = table.find_targets(request.targets)

    def sample(self, rng: np.random.Generator) -> Viewpoint:
        """Draw a target and a useful pose; other targets follow if it has none.

        Raises:
            RunFailed: no target has a useful pose.
        """
        for index in rng.permutation(len(self._targets)).tolist():
            target = self._targets[index]
            bounds = self._request.distance or self._default_distance(target)
            for _ in range(MAX_ATTEMPTS):
                pose, distance = self._draw(target, bounds, rng)
                if self._is_useful(target, pose):
                    return Viewpoint(pose, target.name, distance)
        names = ", ".join(target.name for target in self._targets)
        raise RunFailed(
            f"No camera pose views {names}: {MAX_ATTEMPTS} poses each were above the water, too "
            "near to a surface, or had no free view. Change --distance, --elevation, --clearance, "
            "--min-visibility or --target."
        )

    def _default_distance(self, target: Instance) -> Range:
        if self._reach is not None:
            low = max(SONAR_NEAREST * target.radius, 2.0 * self._request.clearance)
            low = min(low, 0.5 * self._reach)
            return Range(low, min(SONAR_FARTHEST * low, 0.9 * self._reach))
        i = self._intrinsics
        filling = target.radius * min(i.fx / i.width, i.fy / i.height) * 2.0 + target.radius * 0.5
        least_distance = max(DEFAULT_NEAREST * filling, 2.0 * self._request.clearance, 2.0 * i.near)
        return Range(least_distance, least_distance * DEFAULT_FARTHEST / DEFAULT_NEAREST)

    def _draw(
        self, target: Instance, bounds: Range, rng: np.random.Generator
    ) -> tuple[Pose, float]:
        """Draw a pose; every attempt draws the same number of numbers."""
        shares = rng.uniform(size=7)
        azimuth = 2.0 * math.pi * shares[0]
        elevation = math.radians(self._request.elevation.value(shares[1]))
        roll = math.radians(self._request.roll.value(shares[2]))
        distance = bounds.value(shares[3])
        offset = (shares[4:] - 0.5) * AIM_SHARE * target.size
        centre = target.world_from_box.position
        direction = np.array(
            [
                math.cos(elevation) * math.cos(azimuth),
                math.cos(elevation) * math.sin(azimuth),
                math.sin(elevation),
            ]
        )
        eye = centre + distance * direction
        sight = target.world_from_box.transform(offset[None])[0] - eye
        axes = camera_axes(sight / max(length(sight), 1e-9), UP)
        return Pose(eye, product(axes, rotation_z(roll))), distance

    def _is_useful(self, target: Instance, pose: Pose) -> bool:
        eye, request = pose.position, self._request
        is_wet = target.world_from_box.position[2] < self._surface_height
        if is_wet and eye[2] > self._surface_height - MIN_DEPTH:
            return False
        camera_points = pose.inverse().transform(target.points)
        pixels = self._intrinsics.project(camera_points)
        i = self._intrinsics
        is_framed = (
            (pixels[:, 0] >= -0.5)
            & (pixels[:, 0] < i.width - 0.5)
            & (pixels[:, 1] >= -0.5)
            & (pixels[:, 1] < i.height - 0.5)
        )
        if is_framed.sum() < MIN_FRAMED * len(is_framed):
            return False
        world = Pose(eye, np.eye(3))
        clearance = max(request.clearance, i.near)
        hits = self._rays.cast(world, CLEARANCE_DIRECTIONS, clearance)
        if np.isfinite(hits.distance).any():
            return False
        return self._visible_share(target, eye, target.points[is_framed]) >= request.min_visibility

    def _visible_share(self, target: Instance, eye: Array, points: Array) -> float:
        """Return the share of points whose ray from the eye hits the target first [1].

        Half the points of a closed surface are on its far side: rays to these hit the near side.
        """
        offsets = points - eye
        distances = np.sqrt((offsets * offsets).sum(axis=1))
        distances = np.maximum(distances, 1e-6)
        directions = offsets / distances[:, None]
        reach = float(distances.max()) + HIT_TOLERANCE
        hits = self._rays.cast(Pose(eye, np.eye(3)), directions, reach)
        ids = self._table.instance_numbers
        surfaces = np.where((hits.surface >= 0) & (hits.surface < len(ids)), hits.surface, 0)
        is_hit = np.isfinite(hits.distance) & (ids[surfaces] == target.number)
        share = float(is_hit.mean())
        if share < self._request.min_visibility:
            return share
        # the same ray backwards: a surface that is met only so encloses the camera
        for index in np.flatnonzero(is_hit)[:4].tolist():
            start = eye + directions[index] * (hits.distance[index] - HIT_TOLERANCE)
            back = self._rays.cast(
                Pose(start, np.eye(3)),
                -directions[index][None],
                max(float(hits.distance[index]) - HIT_TOLERANCE, 0.0),
            )
            if np.isfinite(back.distance).any():
                return 0.0
        return share

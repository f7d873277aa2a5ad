"""The sun's shadow map: one depth image of the casters."""

from __future__ import annotations

import math

import moderngl
import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, Pose
from ...base.numerics.jit import njit
from ...base.numerics.linear import cross, multiply_matrices, product
from ..instance import INSTANCE, Instances, Numbers
from ..program import build
from .caster_map import CasterMap

SMALL_MAP_SIZE, LARGE_MAP_SIZE = 512, 1024
"""The edges of the map [texels]; drawing the small one takes a third of the time."""

MAX_SMALL_MAP_TEXEL = 0.008
"""The largest texel of the small map; above it, the large map is used [m]."""

MAX_CASTER_RADIUS = 5.0
"""The bounding radius above which a model casts no shadow: tanks and sea floors [m]."""

LOW_SUN_SINE = 0.3
"""The sine of the elevation below which the sun is low [1]."""
SHADOW_MARGIN = 0.05
"""The distance by which shadows may reach beyond boxes: the map's largest texel [m]."""

_TO_TEXTURE = np.array(
    [[0.5, 0.0, 0.0, 0.5], [0.0, 0.5, 0.0, 0.5], [0.0, 0.0, 0.5, 0.5], [0.0, 0.0, 0.0, 1.0]]
)


class SunShadow:
    """The shadow map of the sun.

    Terrain receives shadows and casts none: else a tank's walls would shade all of it, although a
    real water surface scatters the light inward. Points farther from the casters than their
    shadows reach are lit. Not modelled: refraction at the surface.
    """

    def __init__(self, context: moderngl.Context) -> None:
        program = build(context, "shadow", defines={}, blocks=[INSTANCE], samplers={})
        self._maps = {
            size: CasterMap(context, program, size) for size in (SMALL_MAP_SIZE, LARGE_MAP_SIZE)
        }
        self._map = self._maps[SMALL_MAP_SIZE]
        self._map_key: object = None
        self.texture_from_world = np.eye(4)
        """The matrix from W to texture coordinates and depth of the map, 0..1."""
        self.lift = 0.0
        """The offset of a receiver along its normal, against shadows of its own surface [m]."""

    @property
    def texture(self) -> moderngl.Texture:
        """The map now in use."""
        return self._map.texture

    @property
    def n_drawn(self) -> int:
        """The number of batches drawn into maps so far."""
        return sum(caster_map.n_drawn for caster_map in self._maps.values())

    def update(self, instances: Instances, casters: Numbers, sun: Array) -> None:
        """Draw the map again if it is out of date.

        Args:
            instances: All instances.
            casters: Numbers of the batches that cast shadows, (k,).
            sun: Unit vector towards the sun in W, (3,).
        """
        key = instances.version, casters.tobytes(), sun.tobytes()
        if key == self._map_key:
            return
        self._map_key = key
        clip_from_world, edge = _fit_sun_camera(instances.spheres[casters], sun)
        size = SMALL_MAP_SIZE if edge / SMALL_MAP_SIZE <= MAX_SMALL_MAP_TEXEL else LARGE_MAP_SIZE
        self._map = self._maps[size]
        self._map.update(instances, casters, clip_from_world)
        self.texture_from_world = product(_TO_TEXTURE, clip_from_world)
        self.lift = 1.5 * edge / size


def find_shadow_pairs(
    instances: Instances,
    casters: Numbers,
    receivers: Numbers,
    sun: Array,
    world_from_camera: Pose,
    corner_rays: Array,
) -> npt.NDArray[np.bool_]:
    """Return on which visible batches each caster may cast a shadow, (receivers, casters).

    Boxes in the sun's coordinates decide: they must overlap, and the caster's must not be entirely
    behind. Of a receiver only the part between its least and greatest depth in the image counts.

    Args:
        instances: All instances.
        casters: Numbers of the batches that cast shadows, k.
        receivers: Numbers of the batches in view, n.
        sun: Unit vector towards the sun in W, (3,).
        world_from_camera: The pose of the camera.
        corner_rays: The corner rays of its image, 1 m deep, camera frame, (4, 3) [m].
    """
    rays = product(corner_rays, world_from_camera.rotation.T)  # (4, 3) [m]
    may_cast = np.empty((len(receivers), len(casters)), dtype=bool)
    _write_shadow_pairs(
        instances.corners,
        casters,
        receivers,
        sunbeam_frame(sun),
        rays,
        world_from_camera.position,
        np.ascontiguousarray(world_from_camera.rotation[:, 2]),
        may_cast,
    )
    return may_cast


@njit
def _write_shadow_pairs(
    corners: Array,
    casters: Numbers,
    receivers: Numbers,
    frame: Array,
    rays: Array,
    position: Array,
    back: Array,
    may_cast: npt.NDArray[np.bool_],
) -> None:
    """Compute `find_shadow_pairs` into ``may_cast``.

    Args:
        corners: of the boxes of all batches in W, (m, 8, 3) [m].
        casters: which cast shadows, (k,).
        receivers: which are in view, (n,).
        frame: coordinates as the sun sees them, (3, 3).
        rays: towards the corners of the image, 1 m deep, in W, (4, 3).
        position: of the camera in W, (3,) [m].
        back: its z axis in W, (3,).
        may_cast: into which it is written, (n, k).
    """
    slices = np.empty((8, 3))
    boxes, slice_box = np.empty((len(casters), 2, 3)), np.empty((2, 3))
    for k in range(len(casters)):
        compute_box(corners[casters[k]], frame, boxes[k])
    box = np.empty((2, 3))
    for n in range(len(receivers)):
        points = corners[receivers[n]]
        min_depth, max_depth = np.inf, -np.inf
        for c in range(8):
            depth = 0.0
            for j in range(3):
                depth += (position[j] - points[c, j]) * back[j]
            min_depth, max_depth = min(min_depth, depth), max(max_depth, depth)
        for c in range(4):
            for j in range(3):
                slices[c, j] = position[j] + max(0.0, min_depth) * rays[c, j]
                slices[4 + c, j] = position[j] + max(0.0, max_depth) * rays[c, j]
        compute_box(points, frame, box)
        compute_box(slices, frame, slice_box)
        for k in range(len(casters)):
            may_cast[n, k] = boxes[k, 1, 2] >= max(box[0, 2], slice_box[0, 2]) - SHADOW_MARGIN
            for j in range(2):
                low, high = max(box[0, j], slice_box[0, j]), min(box[1, j], slice_box[1, j])
                has_overlap = (
                    boxes[k, 0, j] <= high + SHADOW_MARGIN and boxes[k, 1, j] >= low - SHADOW_MARGIN
                )
                may_cast[n, k] = may_cast[n, k] and has_overlap


@njit
def compute_box(points: Array, frame: Array, box: Array) -> None:
    """Compute least and greatest coordinates of points (k, 3) in another frame, into (2, 3)."""
    box[0], box[1] = np.inf, -np.inf
    for i in range(len(points)):
        for k in range(3):
            total = 0.0
            for j in range(3):
                total += points[i, j] * frame[k, j]
            box[0, k], box[1, k] = min(box[0, k], total), max(box[1, k], total)


def sunbeam_frame(sun: Array) -> Array:
    """Return coordinates of W whose first two are constant on a sunbeam, (3, 3).

    The first two locate the intersection of a beam with the level of W's origin, or with a plane
    normal to the beam if the sun is low. The third is the distance towards the sun.
    """
    if sun[2] < LOW_SUN_SINE:
        return np.stack([*_sun_axes(sun)[:2], sun])
    return np.array([[1.0, 0.0, -sun[0] / sun[2]], [0.0, 1.0, -sun[1] / sun[2]], sun])


@njit
def _sun_axes(sun: Array) -> Array:
    """Return the right, up and forward vectors of a camera that looks from the sun, (3, 3)."""
    axes, pole = np.empty((3, 3)), np.zeros(3)
    pole[2 if abs(sun[2]) < 0.9 else 0] = 1.0
    axes[2] = -sun
    right = cross(axes[2], pole)
    squares = 0.0
    for k in range(3):
        squares += right[k] * right[k]
    axes[0] = right / math.sqrt(squares)
    axes[1] = cross(axes[0], axes[2])
    return axes


@njit
def _fit_sun_camera(spheres: Array, sun: Array) -> tuple[Array, float]:
    """Return the sun's orthographic view of all casters, (4, 4), and the edge of its view [m].

    Args:
        spheres: round the casters in W: centre and radius, (n, 4) [m].
        sun: Unit vector towards the sun in W, (3,).
    """
    axes = _sun_axes(sun)
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    centres = multiply_matrices(np.ascontiguousarray(spheres[:, :3]), np.ascontiguousarray(axes.T))
    for n in range(len(spheres)):
        for k in range(3):
            low[k] = min(low[k], centres[n, k] - spheres[n, 3])
            high[k] = max(high[k], centres[n, k] + spheres[n, 3])
    half = max(high[0] - low[0], high[1] - low[1]) / 2.0
    reach = 20.0  # [m] below the casters where shadows still fall
    middle = (low + high) / 2.0
    middle[2] = (high[2] + reach + low[2]) / 2.0
    scale = np.array([1.0 / half, 1.0 / half, 2.0 / (high[2] + reach - low[2])])
    matrix = np.eye(4)
    for k in range(3):
        matrix[k, :3] = axes[k] * scale[k]
        matrix[k, 3] = -scale[k] * middle[k]
    return matrix, 2.0 * half

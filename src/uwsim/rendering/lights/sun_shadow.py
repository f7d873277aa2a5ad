"""The sun's shadow map: one depth image of the casters."""

from __future__ import annotations

import math

import moderngl
import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, Pose
from ...base.numerics.jit import njit
from ...base.numerics.linear import cross, multiply_matrices, product
from ..instance import Indices, Instances
from .caster_map import CasterMap
from .caster_programs import CasterPrograms

SMALL_MAP_SIZE, LARGE_MAP_SIZE = 512, 1024
"""The edges of the two maps [texels]; to draw the small map takes a third of the time."""

MAX_SMALL_MAP_TEXEL = 0.008
"""The largest texel of the small map; above it, the large map is used [m]."""

MAX_CASTER_RADIUS = 5.0
"""The radius above which a model, such as a tank or a sea floor, casts no shadow [m]."""
MAX_HULL_RADIUS = 20.0
"""The radius up to which a hull below the surface of physical water casts a shadow [m]."""

LOW_SUN_SINE = 0.3
"""The sine of the elevation below which the sun is low [1]."""
SHADOW_MARGIN, HULL_MARGIN = 0.05, 2.05
"""The distance by which shadows may reach beyond bounding boxes: the map's largest texel, and with
hulls the radius of the mean of diffuse light (``shadow.glsl``) [m]."""

_TO_TEXTURE = np.array(
    [[0.5, 0.0, 0.0, 0.5], [0.0, 0.5, 0.0, 0.5], [0.0, 0.0, 0.5, 0.5], [0.0, 0.0, 0.0, 1.0]]
)


class SunShadow:
    """The shadow map of the sun.

    Terrain receives shadows and casts none: otherwise the walls of a tank would shade the whole
    tank, although a real water surface scatters light into it. In physical water, hulls of wrecks
    (`Instances.find_hulls`) cast shadows, of diffuse light, too: its share that arrives is the mean
    of the map around a point (``shadow.glsl``). Points that are more than 20 m below
    all casters are lit. Not modelled: refraction at the water's surface.
    """

    def __init__(self, context: moderngl.Context, programs: CasterPrograms) -> None:
        self._maps = {
            size: CasterMap(context, programs, size) for size in (SMALL_MAP_SIZE, LARGE_MAP_SIZE)
        }
        self._map = self._maps[SMALL_MAP_SIZE]
        self._map_key: object = None
        self.texture_from_world = np.eye(4)
        """The matrix from W to texture coordinates and depth of the map, 0..1, (4, 4)."""
        self.lift = 0.0
        """The offset of a receiver along its normal, against shadows that a surface casts on itself
        because of the map's resolution [m]."""

    @property
    def texture(self) -> moderngl.Texture:
        """The shadow map in use."""
        return self._map.texture

    @property
    def n_drawn(self) -> int:
        """The number of batches drawn into maps so far."""
        return sum(caster_map.n_drawn for caster_map in self._maps.values())

    def update(self, instances: Instances, casters: Indices, sun: Array) -> None:
        """Draw the map again if it is out of date.

        Args:
            instances: all instances.
            casters: the indices of the batches that cast shadows, (k,).
            sun: the unit vector towards the sun in W, (3,).
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
    casters: Indices,
    receivers: Indices,
    sun: Array,
    world_from_camera: Pose,
    corner_rays: Array,
    margin: float = SHADOW_MARGIN,
) -> npt.NDArray[np.bool_]:
    """Return for each visible batch and each caster whether the caster may shade the batch, (n, k).

    The bounding boxes in sunbeam coordinates (`sunbeam_frame`) must overlap, and the caster's box
    must not be entirely farther from the sun. Only the part of a batch in the camera's frustum
    counts.

    Args:
        instances: all instances.
        casters: the indices of the batches that cast shadows, (k,).
        receivers: the indices of the batches in view, (n,).
        sun: the unit vector towards the sun in W, (3,).
        world_from_camera: the pose of the camera.
        corner_rays: the corners of the image at a depth of 1 m in the camera's frame, (4, 3) [m].
        margin: the distance by which shadows may reach beyond bounding boxes [m].
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
        margin,
        may_cast,
    )
    return may_cast


@njit
def _write_shadow_pairs(
    corners: Array,
    casters: Indices,
    receivers: Indices,
    frame: Array,
    rays: Array,
    position: Array,
    back: Array,
    margin: float,
    may_cast: npt.NDArray[np.bool_],
) -> None:
    """Compute `find_shadow_pairs` into ``may_cast``.

    Args:
        corners: the corners of the bounding boxes of all batches in W, (m, 8, 3) [m].
        casters: the indices of the batches that cast shadows, (k,).
        receivers: the indices of the batches in view, (n,).
        frame: the matrix from W to sunbeam coordinates, (3, 3).
        rays: the vectors in W from the camera to the image's corners, 1 m deep, (4, 3) [m].
        position: the position of the camera in W, (3,) [m].
        back: the z axis of the camera in W, (3,).
        margin: the distance by which shadows may reach beyond bounding boxes [m].
        may_cast: the output, (n, k).
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
            may_cast[n, k] = boxes[k, 1, 2] >= max(box[0, 2], slice_box[0, 2]) - margin
            for j in range(2):
                low, high = max(box[0, j], slice_box[0, j]), min(box[1, j], slice_box[1, j])
                has_overlap = boxes[k, 0, j] <= high + margin and boxes[k, 1, j] >= low - margin
                may_cast[n, k] = may_cast[n, k] and has_overlap


@njit
def compute_box(points: Array, frame: Array, box: Array) -> None:
    """Compute the minimum and maximum coordinates of points in another frame.

    Args:
        points: the points in W, (k, 3) [m].
        frame: the matrix from W to the other coordinates, (3, 3).
        box: the output: least and greatest coordinates, (2, 3) [m].
    """
    box[0], box[1] = np.inf, -np.inf
    for i in range(len(points)):
        for k in range(3):
            total = 0.0
            for j in range(3):
                total += points[i, j] * frame[k, j]
            box[0, k], box[1, k] = min(box[0, k], total), max(box[1, k], total)


def sunbeam_frame(sun: Array) -> Array:
    """Return the matrix from W to sunbeam coordinates, (3, 3).

    The first two coordinates are constant along a sunbeam. They give its intersection with the
    plane z = 0 of W, or, if the sun is low, with a plane normal to the beam. The third is the
    distance towards the sun. ``sun`` is the unit vector towards the sun in W, (3,).
    """
    if sun[2] < LOW_SUN_SINE:
        return np.stack([*_sun_axes(sun)[:2], sun])
    return np.array([[1.0, 0.0, -sun[0] / sun[2]], [0.0, 1.0, -sun[1] / sun[2]], sun])


@njit
def _sun_axes(sun: Array) -> Array:
    """Return the right, up and forward vectors in W of a camera that looks from the sun, (3, 3)."""
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
    """Return the matrix from W to clip space of the sun's view, (4, 4), and its edge [m].

    Args:
        spheres: the bounding spheres of the casters in W: centre and radius, (n, 4) [m].
        sun: the unit vector towards the sun in W, (3,).
    """
    axes = _sun_axes(sun)
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    centres = multiply_matrices(np.ascontiguousarray(spheres[:, :3]), np.ascontiguousarray(axes.T))
    for n in range(len(spheres)):
        for k in range(3):
            low[k] = min(low[k], centres[n, k] - spheres[n, 3])
            high[k] = max(high[k], centres[n, k] + spheres[n, 3])
    half = max(high[0] - low[0], high[1] - low[1]) / 2.0
    reach = 20.0  # the distance from the lowest caster to which shadows reach [m]
    middle = (low + high) / 2.0
    middle[2] = (high[2] + reach + low[2]) / 2.0
    scale = np.array([1.0 / half, 1.0 / half, 2.0 / (high[2] + reach - low[2])])
    matrix = np.eye(4)
    for k in range(3):
        matrix[k, :3] = axes[k] * scale[k]
        matrix[k, 3] = -scale[k] * middle[k]
    return matrix, 2.0 * half

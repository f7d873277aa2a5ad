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

SMALL, LARGE = 512, 1024
"""Edges of the map [texels]; the small one costs a third of the large one to draw."""

FINE_TEXEL = 0.008
"""The small map is used while its texels are no larger than this [m]."""

MAX_CASTER_RADIUS = 5.0
"""Bounding radius [m] above which a model casts no shadow: tanks and sea floors."""

LOW_SUN = 0.3
"""Sine of the height below which the sun is low [1]."""
MARGIN = 0.05
"""By how much shadows may reach beyond boxes: the map's texels are that large at most [m]."""

_TO_TEXTURE = np.array(
    [[0.5, 0.0, 0.0, 0.5], [0.0, 0.5, 0.0, 0.5], [0.0, 0.0, 0.5, 0.5], [0.0, 0.0, 0.0, 1.0]]
)


class SunShadow:
    """The shadow map of the sun.

    Terrain receives shadows and casts none: the walls of a tank would put all of it in the dark,
    where in truth the surface of the water scatters the light inward. Points farther from the
    casters than their shadows reach are lit. Not modelled: refraction at the surface.
    """

    def __init__(self, context: moderngl.Context) -> None:
        program = build(context, "shadow", defines={}, blocks=[INSTANCE], samplers={})
        self._maps = {size: CasterMap(context, program, size) for size in (SMALL, LARGE)}
        self._map = self._maps[SMALL]
        self._drawn: object = None
        self.texture_from_world = np.eye(4)
        """W to texture coordinates and depth of the map, 0..1."""
        self.lift = 0.0
        """How far a receiver is pushed off along its normal [m]."""

    @property
    def texture(self) -> moderngl.Texture:
        """The map now in use."""
        return self._map.texture

    @property
    def n_drawn(self) -> int:
        """Number of batches drawn into maps so far."""
        return sum(each.n_drawn for each in self._maps.values())

    def update(self, instances: Instances, casters: Numbers, sun: Array) -> None:
        """Bring the map up to date.

        Args:
            instances: All there are.
            casters: Numbers of the batches that cast shadows, (k,).
            sun: Unit vector towards the sun in W, (3,).
        """
        key = instances.version, casters.tobytes(), sun.tobytes()
        if key == self._drawn:
            return
        self._drawn = key
        clip_from_world, edge = _fit(instances.spheres[casters], sun)
        size = SMALL if edge / SMALL <= FINE_TEXEL else LARGE
        self._map = self._maps[size]
        self._map.update(instances, casters, clip_from_world)
        self.texture_from_world = product(_TO_TEXTURE, clip_from_world)
        self.lift = 1.5 * edge / size


def reached(
    instances: Instances,
    casters: Numbers,
    seen: Numbers,
    sun: Array,
    world_from_camera: Pose,
    corner_rays: Array,
) -> npt.NDArray[np.bool_]:
    """Return on which visible instances each caster may cast a shadow, (seen, casters).

    By boxes as the sun sees them: one must overlap the other, and not lie behind all of it. Of
    what is seen only the part between its least and greatest depth in the image counts.

    Args:
        instances: All there are.
        casters: Numbers of the batches that cast shadows, k.
        seen: Numbers of the batches in view, n.
        sun: Unit vector towards the sun in W, (3,).
        world_from_camera: Where the camera is.
        corner_rays: Of its image, 1 m deep, camera frame, (4, 3) [m].
    """
    rays = product(corner_rays, world_from_camera.rotation.T)  # (4, 3) [m]
    may = np.empty((len(seen), len(casters)), dtype=bool)
    _reach(
        instances.corners,
        casters,
        seen,
        along(sun),
        rays,
        world_from_camera.position,
        np.ascontiguousarray(world_from_camera.rotation[:, 2]),
        may,
    )
    return may


@njit
def _reach(
    corners: Array,
    casters: Numbers,
    seen: Numbers,
    frame: Array,
    rays: Array,
    place: Array,
    back: Array,
    may: npt.NDArray[np.bool_],
) -> None:
    """Do as `reached`, into ``may``.

    Args:
        corners: of the boxes of all batches in W, (m, 8, 3) [m].
        casters: which cast shadows, (k,).
        seen: which are in view, (n,).
        frame: coordinates as the sun sees them, (3, 3).
        rays: towards the corners of the image, 1 m deep, in W, (4, 3).
        place: of the camera in W, (3,) [m].
        back: its z axis in W, (3,).
        may: into which it is written, (n, k).
    """
    slices = np.empty((8, 3))
    boxes, slice_box = np.empty((len(casters), 2, 3)), np.empty((2, 3))
    for k in range(len(casters)):
        bound(corners[casters[k]], frame, boxes[k])
    box = np.empty((2, 3))
    for n in range(len(seen)):
        points = corners[seen[n]]
        least, most = np.inf, -np.inf
        for c in range(8):
            depth = 0.0
            for j in range(3):
                depth += (place[j] - points[c, j]) * back[j]
            least, most = min(least, depth), max(most, depth)
        for c in range(4):
            for j in range(3):
                slices[c, j] = place[j] + max(0.0, least) * rays[c, j]
                slices[4 + c, j] = place[j] + max(0.0, most) * rays[c, j]
        bound(points, frame, box)
        bound(slices, frame, slice_box)
        for k in range(len(casters)):
            may[n, k] = boxes[k, 1, 2] >= max(box[0, 2], slice_box[0, 2]) - MARGIN
            for j in range(2):
                low, high = max(box[0, j], slice_box[0, j]), min(box[1, j], slice_box[1, j])
                over = boxes[k, 0, j] <= high + MARGIN and boxes[k, 1, j] >= low - MARGIN
                may[n, k] = may[n, k] and over


@njit
def bound(points: Array, frame: Array, found: Array) -> None:
    """Least and greatest coordinates of points (k, 3) in another frame, into (2, 3)."""
    found[0], found[1] = np.inf, -np.inf
    for i in range(len(points)):
        for k in range(3):
            total = 0.0
            for j in range(3):
                total += points[i, j] * frame[k, j]
            found[0, k], found[1, k] = min(found[0, k], total), max(found[1, k], total)


def along(sun: Array) -> Array:
    """Coordinates of W in which a sunbeam keeps the first two and falls along the third, (3, 3).

    Where a beam meets the level of W's origin, or of a plane that it meets squarely when the sun
    is low; and how far towards the sun.
    """
    if sun[2] < LOW_SUN:
        return np.stack([*_axes(sun)[:2], sun])
    return np.array([[1.0, 0.0, -sun[0] / sun[2]], [0.0, 1.0, -sun[1] / sun[2]], sun])


@njit
def _axes(sun: Array) -> Array:
    """Right, up and forward vectors of a camera that looks from the sun, (3, 3)."""
    axes, pole = np.empty((3, 3)), np.zeros(3)
    pole[2 if abs(sun[2]) < 0.9 else 0] = 1.0
    axes[2] = -sun
    aside = cross(axes[2], pole)
    squares = 0.0
    for k in range(3):
        squares += aside[k] * aside[k]
    axes[0] = aside / math.sqrt(squares)
    axes[1] = cross(axes[0], axes[2])
    return axes


@njit
def _fit(spheres: Array, sun: Array) -> tuple[Array, float]:
    """The sun's orthographic camera round all casters, (4, 4), and the edge of its view [m].

    Args:
        spheres: round the casters in W: centre and radius, (n, 4) [m].
        sun: Unit vector towards the sun in W, (3,).
    """
    axes = _axes(sun)
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

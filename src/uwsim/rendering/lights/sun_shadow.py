"""The sun's shadow map: one depth image of the casters, redrawn only when they moved."""

from __future__ import annotations

from collections.abc import Sequence

import moderngl
import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, Pose
from ...base.numerics.jit import njit
from ...base.numerics.linear import cross, length, product, solve
from ..instance import INSTANCE, Instances, Slots
from ..program import build

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
        self._context = context
        self._maps = {size: _depth_map(context, size) for size in (SMALL, LARGE)}
        self.texture = self._maps[SMALL]
        """The map now in use."""
        self._framebuffers = {
            size: context.framebuffer(depth_attachment=texture)
            for size, texture in self._maps.items()
        }
        self._program = build(context, "shadow", defines={}, blocks=[INSTANCE], samplers={})
        self._slots = Slots(context)
        self._drawn: object = None
        self.texture_from_world = np.eye(4)
        """W to texture coordinates and depth of the map, 0..1."""
        self.lift = 0.0
        """How far a receiver is pushed off along its normal [m]."""

    def update(
        self, instances: Instances, casters: Sequence[int], sun: Array, version: object
    ) -> None:
        """Draw the map, unless all is as at the last drawing.

        Args:
            instances: All there are.
            casters: Numbers of the batches that cast shadows.
            sun: Unit vector towards the sun in W, (3,).
            version: Changes whenever a caster moved, came or went.
        """
        key = (version, tuple(casters), tuple(sun))
        if key == self._drawn:
            return
        self._drawn = key
        spheres = instances.spheres[list(casters)]
        clip_from_world, edge = _fit(spheres, sun)
        size = SMALL if edge / SMALL <= FINE_TEXEL else LARGE
        self.texture = self._maps[size]
        self.texture_from_world = product(_TO_TEXTURE, clip_from_world)
        self.lift = 1.5 * edge / size
        context = self._context
        self._framebuffers[size].use()
        self._framebuffers[size].clear(depth=1.0)
        context.enable_only(moderngl.DEPTH_TEST)
        context.depth_func = "<="
        context.polygon_offset = 1.5, 2.0
        self._slots.fill(instances, clip_from_world)
        is_mirrored = instances.is_mirrored
        for number in casters:
            row, batch = instances.batch(number)
            self._slots.bind(row)
            context.front_face = "cw" if is_mirrored[row] else "ccw"
            batch.draw(self._program)
        context.polygon_offset = 0.0, 0.0

    def take_over(self) -> None:
        """Bind the shadow map as the render target and flush earlier draw calls."""
        self._framebuffers[SMALL].use()


def reached(
    instances: Instances,
    casters: Sequence[int],
    seen: Sequence[int],
    sun: Array,
    world_from_camera: Pose,
    clip_from_camera: Array,
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
        clip_from_camera: Its projection, (4, 4).
    """
    rays = product(_corner_rays(clip_from_camera), world_from_camera.rotation.T)  # (4, 3), 1 m deep
    may = np.empty((len(seen), len(casters)), dtype=bool)
    _reach(
        instances.corners,
        np.array(casters, dtype=np.intp),
        np.array(seen, dtype=np.intp),
        _along(sun),
        rays,
        world_from_camera.position,
        np.ascontiguousarray(world_from_camera.rotation[:, 2]),
        may,
    )
    return may


@njit
def _reach(
    corners: Array,
    casters: npt.NDArray[np.intp],
    seen: npt.NDArray[np.intp],
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
        _bound(corners[casters[k]], frame, boxes[k])
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
        _bound(points, frame, box)
        _bound(slices, frame, slice_box)
        for k in range(len(casters)):
            may[n, k] = boxes[k, 1, 2] >= max(box[0, 2], slice_box[0, 2]) - MARGIN
            for j in range(2):
                low, high = max(box[0, j], slice_box[0, j]), min(box[1, j], slice_box[1, j])
                over = boxes[k, 0, j] <= high + MARGIN and boxes[k, 1, j] >= low - MARGIN
                may[n, k] = may[n, k] and over


@njit
def _bound(points: Array, frame: Array, found: Array) -> None:
    """Least and greatest coordinates of points (k, 3) in another frame, into (2, 3)."""
    found[0], found[1] = np.inf, -np.inf
    for i in range(len(points)):
        for k in range(3):
            total = 0.0
            for j in range(3):
                total += points[i, j] * frame[k, j]
            found[0, k], found[1, k] = min(found[0, k], total), max(found[1, k], total)


def _along(sun: Array) -> Array:
    """Coordinates of W in which a sunbeam keeps the first two and falls along the third, (3, 3).

    Where a beam meets the level of W's origin, or of a plane that it meets squarely when the sun
    is low; and how far towards the sun.
    """
    if sun[2] < LOW_SUN:
        return np.stack([*_axes(sun), sun])
    return np.array([[1.0, 0.0, -sun[0] / sun[2]], [0.0, 1.0, -sun[1] / sun[2]], sun])


def _corner_rays(clip_from_camera: Array) -> Array:
    """Towards the corners of the image, 1 m deep, camera frame, (4, 3)."""
    corners = np.array([[x, y, 1.0] for x in (-1.0, 1.0) for y in (-1.0, 1.0)])
    # With z = -1: x_clip = P00 x + P01 y - P02, y_clip = P11 y - P12, w = 1.
    matrix = clip_from_camera[:2, :3]
    xy = solve(matrix[:, :2], (corners[:, :2] + matrix[:, 2]).T).T
    return np.column_stack([xy, -corners[:, 2]])


def _axes(sun: Array) -> tuple[Array, Array]:
    """Right and up vectors of a camera that looks from the sun, (3,) each."""
    aside = cross(-sun, np.eye(3)[2 if abs(sun[2]) < 0.9 else 0])
    aside /= length(aside)
    return aside, cross(aside, -sun)


def _fit(spheres: Array, sun: Array) -> tuple[Array, float]:
    """The sun's orthographic camera round all casters, (4, 4), and the edge of its view [m].

    Args:
        spheres: round the casters in W: centre and radius, (n, 4) [m].
        sun: Unit vector towards the sun in W, (3,).
    """
    axes = np.stack([*_axes(sun), -sun])  # (3, 3)
    centres, radii = product(spheres[:, :3], axes.T), spheres[:, 3:]  # (n, 3), (n, 1) [m]
    low, high = (centres - radii).min(axis=0), (centres + radii).max(axis=0)
    half = max(high[0] - low[0], high[1] - low[1]) / 2.0
    reach = 20.0  # [m] below the casters where shadows still fall
    middle = (low + high) / 2.0
    scale = np.array([1.0 / half, 1.0 / half, 2.0 / (high[2] + reach - low[2])])
    matrix = np.eye(4)
    matrix[:3, :3] = axes * scale[:, None]
    matrix[:3, 3] = -scale * [middle[0], middle[1], (high[2] + reach + low[2]) / 2.0]
    return matrix, 2.0 * half


def _depth_map(context: moderngl.Context, size: int) -> moderngl.Texture:
    texture = context.depth_texture((size, size))
    texture.compare_func = "<="
    texture.filter = (moderngl.LINEAR, moderngl.LINEAR)
    texture.repeat_x = texture.repeat_y = False
    return texture

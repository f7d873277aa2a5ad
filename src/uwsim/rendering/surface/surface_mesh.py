"""The mesh of the water's surface: rings around the camera, finer near it.

The radius of the rings grows by a constant factor, so that triangles have about the same size in an
image. Sectors that a camera does not see are left out. The elevation is added by the vertex shader.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import moderngl
import numpy as np

from ...base.geometry import Array, Intrinsics, Pose
from ...base.numerics.elementwise import arctan2, exp
from ...base.numerics.linear import rotate_rows

N_SECTORS = 32
"""The number of sectors, which are drawn or left out."""
SECTOR_EDGES = 8
"""The number of edges of a ring in a sector."""
FIRST_RADIUS, LAST_RADIUS = 0.2, 2e5
"""The radius of the first and of the last ring [m]."""
FINE_RADIUS, WAVE_RADIUS = 12.0, 1500.0
"""The radii up to which rings show short waves, and long waves [m]."""
N_FINE_RINGS, N_RINGS, N_FAR_RINGS = 80, 48, 15
"""The number of rings up to each of these radii, and beyond. Rings that are closer to each other
have triangles of a few pixels, which take most of the time."""
COARSE_STEP = 2
"""The rings and edges of the mesh in one of the coarse mesh for a camera under water. It sees no
crests against the sky, and slopes are those of each pixel."""
N_BORDER_POINTS = 12
"""The number of rays along each side of an image that find the sectors in view."""


class SurfaceMesh:
    """The vertices and triangles of the surface.

    Args:
        context: the context of the renderer.
        step: the number of rings and edges that are joined to one, 1 or `COARSE_STEP`.
    """

    def __init__(self, context: moderngl.Context, step: int = 1) -> None:
        radii = _compute_radii()[::step]
        self._radii = radii
        n_edges = SECTOR_EDGES // step
        n_angles = N_SECTORS * n_edges
        angles = 2.0 * math.pi * np.arange(n_angles + 1) / n_angles
        vertices = np.stack(
            [radii[:, None] * np.cos(angles), radii[:, None] * np.sin(angles)], axis=-1
        )
        row = n_angles + 1
        first = np.arange(len(radii) - 1)[:, None] * row + np.arange(n_angles)[None, :]
        next_ring = first + row
        corners = np.stack(
            [first, next_ring, next_ring + 1, first, next_ring + 1, first + 1], axis=-1
        )  # (rings, edges, 6)
        self._ring_size = n_edges * 6
        shape = len(radii) - 1, N_SECTORS, self._ring_size
        triangles = corners.reshape(shape).transpose(1, 0, 2)
        self.vertices = context.buffer(vertices.astype(np.float32).tobytes())
        """The offsets of the vertices from the camera, two floats each [m]."""
        self.indices = context.buffer(np.ascontiguousarray(triangles, np.uint32).tobytes())
        """The vertices of the triangles, sector by sector, from the camera outwards."""
        self._sector_size = (len(radii) - 1) * self._ring_size

    def find_ranges(self, view: SurfaceView) -> tuple[tuple[int, int], ...]:
        """Return the first index and the number of indices of each visible sector."""
        first = max(int(np.searchsorted(self._radii, view.min_radius)) - 2, 0)
        last_index = min(
            int(np.searchsorted(self._radii, view.max_radius)) + 1, len(self._radii) - 1
        )
        ring_size, n_rings = self._ring_size, max(last_index - first, 0)
        return tuple(
            (sector * self._sector_size + first * ring_size, n_rings * ring_size)
            for sector in view.sectors
            if n_rings
        )


@dataclass(frozen=True, kw_only=True)
class SurfaceView:
    """The part of the surface that a camera may see."""

    sectors: tuple[int, ...]
    """The indices of the sectors."""
    min_radius: float
    """The least horizontal distance from the camera [m]."""
    max_radius: float
    """The greatest horizontal distance from the camera [m]."""


def find_view(
    world_from_camera: Pose, intrinsics: Intrinsics, height: float, max_elevation: float
) -> SurfaceView:
    """Return the part of the surface that a camera may see.

    Args:
        world_from_camera: the pose of the camera; OpenGL axes.
        intrinsics: the pinhole of the camera.
        height: the height of the camera above the still surface [m].
        max_elevation: the greatest elevation of the waves [m].
    """
    lens = intrinsics
    u = np.linspace(-0.5, lens.width - 0.5, N_BORDER_POINTS)
    v = np.linspace(-0.5, lens.height - 0.5, N_BORDER_POINTS)
    columns = np.concatenate([u, u, np.full_like(v, u[0]), np.full_like(v, u[-1])])
    rows = np.concatenate([np.full_like(u, v[0]), np.full_like(u, v[-1]), v, v])
    y = -(rows - lens.cy) / lens.fy
    x = (columns - lens.cx - lens.skew * y) / lens.fx
    rays = rotate_rows(world_from_camera.rotation, np.stack([x, y, np.full_like(x, -1.0)], axis=1))
    side = -1.0 if height > 0.0 else 1.0
    sees_centre = _sees_vertical(world_from_camera, lens, side)
    sees_all = sees_centre or _sees_vertical(world_from_camera, lens, -side)
    sectors = range(N_SECTORS) if sees_all else _find_sectors(world_from_camera, rays)
    near, far = abs(height) - max_elevation, abs(height) + max_elevation
    climbs = side * rays[:, 2] / np.sqrt(rays[:, 0] ** 2 + rays[:, 1] ** 2)
    looks_towards = side * world_from_camera.rotation[2, 2] < 0.0
    max_climb, min_climb = 1.05 * float(climbs.max()), 0.95 * float(climbs.min())
    min_radius, max_radius = 0.0, LAST_RADIUS
    if near > 0.0:
        if not sees_centre and max_climb <= 0.0:
            sectors = range(0)
        if not sees_centre:
            min_radius = near / max(max_climb, 1e-9)
        if min_climb > 0.0 and (not sees_all or looks_towards):
            max_radius = min(far / min_climb, LAST_RADIUS)
    return SurfaceView(sectors=tuple(sectors), min_radius=min_radius, max_radius=max_radius)


def _find_sectors(world_from_camera: Pose, rays: Array) -> list[int]:
    """Return the indices of the sectors between rays along the border of an image."""
    axis = -world_from_camera.rotation[:, 2]
    middle = math.atan2(axis[1], axis[0])
    angles = arctan2(rays[:, 1], rays[:, 0]) - middle
    angles -= 2.0 * math.pi * np.floor(angles / (2.0 * math.pi) + 0.5)
    step = 2.0 * math.pi / N_SECTORS
    first = math.floor((middle + float(angles.min())) / step - 0.25)
    last_index = math.floor((middle + float(angles.max())) / step + 0.25)
    return sorted({sector % N_SECTORS for sector in range(first, last_index + 1)})


def _sees_vertical(world_from_camera: Pose, lens: Intrinsics, side: float) -> bool:
    """Return whether the zenith, or with ``side`` -1 the nadir, is in view or near its border."""
    x, y, z = side * world_from_camera.rotation[2]  # W's z axis in the camera frame
    if z >= -1e-6:
        return False
    u = lens.fx * x / -z + lens.skew * y / -z + lens.cx
    v = -lens.fy * y / -z + lens.cy
    margin = 0.1 * lens.width
    return bool(-margin <= u <= lens.width + margin and -margin <= v <= lens.height + margin)


def _compute_radii() -> Array:
    limits = FIRST_RADIUS, FINE_RADIUS, WAVE_RADIUS, LAST_RADIUS
    parts = [np.zeros(1), np.array([FIRST_RADIUS])]
    for start, end, n in zip(
        limits[:-1], limits[1:], (N_FINE_RINGS, N_RINGS, N_FAR_RINGS), strict=True
    ):
        parts.append(exp(np.linspace(math.log(start), math.log(end), n + 1)[1:]))
    radii: Array = np.concatenate(parts)
    return radii

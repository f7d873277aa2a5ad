"""Surfaces of the scene vertically below a point."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import product
from ...model.parts import Part
from ..live_scene import LiveScene
from .scenery import Scenery


@dataclass(frozen=True)
class LowerSurface:
    """A surface vertically below a point."""

    name: str
    """The name of the object or link to which the surface belongs."""
    height: float
    """The z coordinate of the surface in W [m]."""


def surfaces_below_vehicle(world: LiveScene, vehicle: str) -> tuple[LowerSurface, ...]:
    """Return the visible surfaces below a vehicle's origin, nearest first; not its own surfaces."""
    index = world.vehicles.find(vehicle).index
    parts = world.scenery.parts
    visible_parts = [part for part in parts if part.vehicle != index and not part.is_hidden]
    return surfaces_below(world.engine.poses.vehicle(index).position, world.scenery, visible_parts)


def surfaces_below(
    point: Array, scenery: Scenery, parts: Iterable[Part]
) -> tuple[LowerSurface, ...]:
    """Return the surfaces of ``parts`` below a point of W, (3,) [m], the highest first.

    Of several surfaces with the same name, only the highest is returned. Seen from above, the
    point and each pair of corners of a triangle span the signed areas :math:`a, b, c`. The vertical
    through the point crosses the triangle if these have the same sign, at the height
    :math:`(a z_0 + b z_1 + c z_2) / (a + b + c)`. Vertical triangles have no crossing.
    """
    heights: dict[str, float] = {}
    for part in parts:
        if part.grid is not None:
            height = part.grid.height_at(float(point[0]), float(point[1]))
            if height is not None and height <= point[2]:
                heights[part.name] = max(height, heights.get(part.name, height))
            continue
        frame = scenery.world_from_mesh(part)
        for mesh in part.model.meshes:
            corners = product(mesh.vertices, frame[:3, :3].T) + frame[:3, 3]  # (n, 3) [m]
            height = _highest_crossing(point, corners[mesh.triangles])
            if height is not None:
                heights[part.name] = max(height, heights.get(part.name, height))
    surfaces = [LowerSurface(name, height) for name, height in heights.items()]
    return tuple(sorted(surfaces, key=lambda surface: -surface.height))


def _highest_crossing(point: Array, triangles: Array) -> float | None:
    """Return the height in W [m] of the highest crossing below the point; None without any.

    Args:
        point: the point in W, (3,) [m].
        triangles: the corners of the triangles in W, (n, 3, 3) [m].
    """
    corners = triangles[:, :, :2] - point[:2]  # (n, 3, 2) [m], the point is the origin
    next_corners = np.roll(corners, -1, axis=1)
    areas = (
        corners[..., 0] * next_corners[..., 1] - corners[..., 1] * next_corners[..., 0]
    )  # (n, 3) [m2]
    # the area of corners i + 1 and i + 2 with the point is the weight of corner i
    total = areas.sum(axis=1)
    is_inside = ((areas >= 0.0).all(axis=1) | (areas <= 0.0).all(axis=1)) & (np.abs(total) > 0.0)
    if not is_inside.any():
        return None
    weights = np.roll(areas[is_inside], -1, axis=1) / total[is_inside, None]
    heights = (weights * triangles[is_inside, :, 2]).sum(axis=1)
    lower = heights[heights <= point[2]]
    return float(lower.max()) if lower.size else None

"""Sea floors, 48 x 48 m, z up, about z = 0: ``terrain/seabed/sand`` and ``gravel``.

Three scales meet: dunes and hollows in the mesh, ripples and gravel in the normal map, and patches
of sand and gravel by tiles in random order (`seabed_tiles`).
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from uwsim.base import rng
from uwsim.base.geometry import rotation_from_rpy

from ..baked import bake
from ..cached import cache_image
from ..fields import noise3
from ..parts import Part
from ..shapes import Shape, join, surface
from ..surfaces import Material
from .rocks import GRANITE, paint_rock, rock_radius
from .seabed_tiles import TILE, seabed_material, tile_corners, tile_frame

N_TILES, CUTS = 40, 1
"""The numbers of tiles along a side, and of squares along a tile."""
REACH = 0.5 * N_TILES * TILE
"""The reach of a floor from its middle [m]."""
OCTAVES = ((17.0, 0.45), (6.0, 0.14), (2.1, 0.035))
"""The cells of each octave of the heights, and its deviation [m]."""


def sand() -> tuple[Part, ...]:
    """Return rippled sand with few patches of gravel."""
    return (_floor("sand", gravel_level=1.25),)


def gravel() -> tuple[Part, ...]:
    """Return sand and gravel, about half of each, with stones of 0.1 to 0.9 m."""
    return _floor("gravel", gravel_level=0.3), _stones("gravel", 80)


def _floor(name: str, *, gravel_level: float) -> Part:
    """Return a floor; gravel is where the noise of patches is above a level."""
    points = np.stack(
        [*np.meshgrid(*[np.arange(N_TILES + 1, dtype=np.float32) * TILE - REACH] * 2)], axis=2
    )
    patches = noise3(f"seabed/{name}/patches", _lift_points(points), 5.0, octaves=4, gain=0.6)
    corners = (patches > gravel_level).astype(int)  # [row y, column x]
    stream = rng.stream(0, f"assets/seabed/{name}/tiles")
    cases: dict[tuple[int, ...], list[int]] = {}
    for index, case in enumerate(tile_corners()):
        cases.setdefault(case, []).append(index)
    shapes = []
    for row, column in np.ndindex(N_TILES, N_TILES):
        case = (
            *corners[row, column : column + 2].tolist(),
            *corners[row + 1, column : column + 2].tolist(),
        )
        index = cases[case][int(stream.integers(len(cases[case])))]
        shapes.append(_patch(name, column * TILE - REACH, row * TILE - REACH, tile_frame(index)))
    return _material().cover(join(*shapes), crease=2.0)


def _patch(name: str, x0: float, y0: float, frame: tuple[float, float, float, float]) -> Shape:
    t, s = np.meshgrid(*[np.linspace(0.0, 1.0, CUTS + 1)] * 2, indexing="ij")
    xy = np.stack([x0 + s * TILE, y0 + t * TILE], axis=2)
    points = np.concatenate([xy, heights(name, xy)[..., None]], axis=2)
    u0, v0, u1, v1 = frame
    return surface(points, np.stack([u0 + s * (u1 - u0), v0 + t * (v1 - v0)], axis=2))


def heights(name: str, xy: np.ndarray) -> np.ndarray:
    """Return the heights of a floor at points (..., 2) [m]."""
    points = _lift_points(xy)
    total = np.zeros(points.shape[:-1])
    for cell, deviation in OCTAVES:
        key = f"seabed/{name}/{cell:g}"
        total += deviation * noise3(key, points, cell, octaves=1).astype(np.float64)
    return total


def _lift_points(xy: np.ndarray) -> np.ndarray:
    """Return points at the height 0.37 m, float32, on which noise is drawn."""
    plane_points = np.round(np.asarray(xy, dtype=np.float64), 6)
    height = np.full((*plane_points.shape[:-1], 1), 0.37)
    return np.concatenate([plane_points, height], axis=-1).astype(np.float32)


def _stones(name: str, count: int) -> Part:
    """Return stones that lie on a floor, copies of one at several sizes and attitudes."""
    axes = np.array((0.5, 0.42, 0.34), dtype=np.float32)
    stone = bake(
        "seabed/stone",
        partial(rock_radius, "stone", axes),
        partial(paint_rock, "stone", 0.42, GRANITE),
        n=4,
        side=128,
    )
    stream = rng.stream(0, f"assets/seabed/{name}/stones")
    mesh = stone.mesh
    vertices, normals, triangles = [], [], []
    for k in range(count):
        size = 0.1 * (1.0 + 8.0 * float(stream.random()) ** 3) / 0.84
        rotation = rotation_from_rpy(*(float(angle) for angle in stream.uniform(-3.1, 3.1, 3)))
        xy = stream.uniform(-0.8 * REACH, 0.8 * REACH, 2)
        z = float(heights(name, xy[None])[0]) + 0.08 * size
        stone_vertices = np.einsum("ij,kj->ik", mesh.vertices.astype(np.float64), rotation)
        vertices.append(stone_vertices * size + np.array([*xy, z]))
        normals.append(np.einsum("ij,kj->ik", mesh.normals.astype(np.float64), rotation))
        triangles.append(mesh.triangles + np.uint32(k * len(mesh.vertices)))
    stones = replace(
        mesh,
        vertices=np.concatenate(vertices).astype(np.float32),
        normals=np.concatenate(normals).astype(np.float32),
        uvs=np.tile(mesh.uvs, (count, 1)),
        triangles=np.concatenate(triangles),
    )
    return replace(stone, mesh=stones)


@cache_image
def _material() -> Material:
    return seabed_material()

"""Sea floors: ``terrain/seafloor``, ``terrain/shipwreck`` (z up) and ``terrain/desert``.

They are at z = -15 m and extend 40 m each way: the vehicles of UWSim's scenes start at 10 and 11 m.
``terrain/sand`` is a plane through the origin.
"""

from __future__ import annotations

import cv2
import numpy as np

from uwsim.assets.mesh import Mesh, Texture
from uwsim.base.geometry import Array, rotation_from_rpy, rotation_y

from ..cached import cache_image
from ..shapes import Shape, cylinder, join, mesh, quad, sphere, surface
from ..textures import fill, mix, noise, shading, smoothstep, to_texture, worn_paint
from .ships import hull

DEPTH, REACH = 15.0, 40.0
"""The mean depth of the floor, and its reach from the middle [m]."""
FLAT_SIDE = 24.0
"""The edge of the plane of sand [m]."""


@cache_image
def sand() -> Texture:
    """Return rippled sand with grit, 4 m an image."""
    size = 512
    grain = noise("seafloor/grain", size, size, cells=64, octaves=4, gain=0.9)
    waves = noise("seafloor/broad", size, size, cells=3, octaves=5)
    rows = np.arange(size, dtype=np.float32)[:, None] * np.float32(2 * np.pi * 20 / size)
    ripples = np.sin(rows + 1.5 * waves)
    image = fill(size, size, (0.66, 0.60, 0.46)) * (1.0 + 0.07 * grain + 0.05 * waves)[..., None]
    image = mix(image, (0.34, 0.32, 0.26), 0.6 * smoothstep(1.4, 2.4, grain))
    return to_texture("seafloor/sand", image * shading(ripples, 0.5, tiles=True)[..., None])


def _terrain(name: str, n: int, height: float) -> Shape:
    """Return a square of sand dunes about z = 0, n x n pieces."""
    rise = noise(name, 128, 128, cells=3, octaves=5, gain=0.5, tiles=False)
    heights = cv2.resize(rise, (n + 1, n + 1), interpolation=cv2.INTER_AREA)
    y, x = np.meshgrid(*[np.linspace(-REACH, REACH, n + 1)] * 2, indexing="ij")
    points: Array = np.stack([x, y, height * heights], axis=2)
    return surface(points, np.stack([x, y], axis=2) / 4.0)


def _boulders(places: list[tuple[float, float, float]]) -> Shape:
    """Return boulders: squashed spheres at x, y with a radius."""
    stones = []
    for k, (x, y, radius) in enumerate(places):
        rotation = rotation_from_rpy(0.4 * k, 0.7 * k, 1.3 * k)
        stone = sphere(radius, n=12).scale(1.0, 0.8, 0.6).rotate(rotation)
        stones.append(stone.project_uv(2.0).shift(x, y, -DEPTH + 0.1 * radius))
    return join(*stones)


STONES = [(6.0, -4.0, 0.9), (-3.0, 5.0, 1.4), (9.0, 8.5, 0.6), (-9.0, -7.0, 1.8), (2.5, 10.0, 0.5)]


def seafloor() -> tuple[Mesh, ...]:
    """Return sand dunes with some boulders."""
    rock = worn_paint("seafloor/rock", (0.38, 0.37, 0.33), grain=0.16)
    return (
        mesh(_terrain("seafloor/dunes", 44, 0.7).shift(z=-DEPTH), texture=sand()),
        mesh(_boulders(STONES), texture=rock),
    )


def shipwreck() -> tuple[Mesh, ...]:
    """Return the sea floor with a wooden wreck, listing and half sunk into the sand."""
    wood = worn_paint("seafloor/wood", (0.30, 0.24, 0.17), grain=0.14)
    list_rotation = rotation_from_rpy(0.45, -0.06, 0.6)
    parts = [hull(16.0, 4.6, 1.8, 1.2).scale_uv(6.0, 6.0)]
    parts.append(cylinder((1.5, 0.0, 1.0), (1.2, 0.0, 7.5), 0.20, n=10))
    parts.append(cylinder((-4.5, -2.4, 1.4), (-4.5, 3.6, 1.6), 0.12, n=8))
    for k in range(5):
        x = -6.5 + 1.1 * k
        parts.append(cylinder((x, 2.0, 0.8), (x - 0.1, 2.3, 2.4 - 0.2 * k), 0.09, n=6))
    wreck = join(*parts).rotate(list_rotation).shift(4.0, 5.0, -DEPTH + 0.6)
    return (*seafloor(), mesh(wreck, texture=wood, crease=0.7))


def desert() -> tuple[Mesh, ...]:
    """Return a sand floor through the origin with +x up: the scene pitches it by 1.57 rad."""
    floor = _terrain("desert/dunes", 40, 0.4).rotate(rotation_y(np.pi / 2))
    return (mesh(floor, texture=sand(), two_sided=True),)


def flat_sand() -> tuple[Mesh, ...]:
    """A plane of rippled sand through the origin, 24 x 24 m, z up."""
    half = 0.5 * FLAT_SIDE
    n_images = FLAT_SIDE / 4.0  # along each edge
    corners = [(-half, -half, 0.0), (half, -half, 0.0), (half, half, 0.0), (-half, half, 0.0)]
    return (mesh(quad(*corners, uv=(0.0, 0.0, n_images, n_images), cuts=(10, 10)), texture=sand()),)

"""The test tank of the underwater robotics centre (CIRS) in Girona: ``terrain/CIRS``.

Frame: z up, water level 0, x along the basin. Geometry as in UWSim's model: a basin with a
shelf at each end, ramps down to a flat bottom, an image of a sea floor laid on it, a window in
one wall, and the facade of the laboratory behind.
"""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np

from uwsim.assets.mesh import Mesh, Texture

from ..shapes import Shape, box, join, mesh, quad
from ..textures import cement, fill, mix, noise, paint_text, smoothstep, to_texture, worn_paint
from .seabed_image import mosaic

WEST, EAST, SOUTH, NORTH = -8.01, 7.99, -4.0, 4.0
"""The inner walls of the basin [m]."""
RIM_X, RIM_Y, RIM_TOP = 8.3, 4.3, 0.25
"""The outer edge and the height of the deck round the basin [m]."""
PROFILE = (
    (WEST, -0.65),
    (-6.01, -0.65),
    (-2.01, -4.85),
    (1.99, -4.85),
    (5.99, -0.65),
    (EAST, -0.65),
)
"""The bottom along x: shelf, ramp, flat, ramp, shelf; (x, z) [m]."""
IMAGE_SIZE, IMAGE_TOP = (3.48, 7.0), -4.81
"""The image on the bottom: x, y and height [m]."""
GRASS = 15.0
"""The reach of the ground from the middle [m]."""


def _floor() -> Shape:
    strips = []
    for (xa, za), (xb, zb) in itertools.pairwise(PROFILE):
        strips.append(
            quad((xa, SOUTH, za), (xb, SOUTH, zb), (xb, NORTH, zb), (xa, NORTH, za), cuts=(4, 8))
        )
    return join(*strips)


def _walls(low: float | None, high: float) -> Shape:
    """Return the four inner walls from ``low`` (None: the bottom) to ``high``, facing inward."""
    parts = []
    for (xa, za), (xb, zb) in itertools.pairwise(PROFILE):
        a, b = (za, zb) if low is None else (low, low)
        cuts = (4, 4) if low is None else (4, 1)
        parts += [
            quad((xb, SOUTH, b), (xa, SOUTH, a), (xa, SOUTH, high), (xb, SOUTH, high), cuts=cuts),
            quad((xa, NORTH, a), (xb, NORTH, b), (xb, NORTH, high), (xa, NORTH, high), cuts=cuts),
        ]
    end = PROFILE[0][1] if low is None else low
    cuts = (8, 1)
    parts += [
        quad((WEST, SOUTH, end), (WEST, NORTH, end), (WEST, NORTH, high), (WEST, SOUTH, high),
             cuts=cuts),
        quad((EAST, NORTH, end), (EAST, SOUTH, end), (EAST, SOUTH, high), (EAST, NORTH, high),
             cuts=cuts),
    ]  # fmt: skip
    return join(*parts)


def _deck() -> Shape:
    """Return the rim: a top face of four parts, and outer sides down into the ground."""
    x, y, z = RIM_X, RIM_Y, RIM_TOP
    return join(
        quad((-x, -y, z), (x, -y, z), (EAST, SOUTH, z), (WEST, SOUTH, z), cuts=(8, 1)),
        quad((x, -y, z), (x, y, z), (EAST, NORTH, z), (EAST, SOUTH, z), cuts=(6, 1)),
        quad((x, y, z), (-x, y, z), (WEST, NORTH, z), (EAST, NORTH, z), cuts=(8, 1)),
        quad((-x, y, z), (-x, -y, z), (WEST, SOUTH, z), (WEST, NORTH, z), cuts=(6, 1)),
        quad((-x, -y, 0.1), (x, -y, 0.1), (x, -y, z), (-x, -y, z)),
        quad((x, -y, 0.1), (x, y, 0.1), (x, y, z), (x, -y, z)),
        quad((x, y, 0.1), (-x, y, 0.1), (-x, y, z), (x, y, z)),
        quad((-x, y, 0.1), (-x, -y, 0.1), (-x, -y, z), (-x, y, z)),
    )


def _ground() -> Shape:
    x, y, g, low, high = RIM_X, RIM_Y, GRASS, 0.11, 0.15
    return join(
        quad((-g, -g, high), (g, -g, high), (x, -y, low), (-x, -y, low), cuts=(6, 3)),
        quad((g, -g, high), (g, g, high), (x, y, low), (x, -y, low), cuts=(6, 3)),
        quad((g, g, high), (-g, g, high), (-x, y, low), (x, y, low), cuts=(6, 3)),
        quad((-g, g, high), (-g, -g, high), (-x, -y, low), (-x, y, low), cuts=(6, 3)),
    )


def _grass() -> Texture:
    size = 512
    clumps = noise("tank/grass", size, size, cells=8, octaves=7, gain=0.8)
    earth_cover = smoothstep(0.9, 2.0, noise("tank/grass/bare", size, size, cells=4, octaves=4))
    image = fill(size, size, (0.25, 0.38, 0.14)) * (1.0 + 0.22 * clumps)[:, :, None]
    earth = fill(size, size, (0.42, 0.35, 0.22)) * (1.0 + 0.12 * clumps)[:, :, None]
    return to_texture("tank/grass", mix(image, earth, np.float32(0.7) * earth_cover))


def _facade() -> Texture:
    """Return a rendered wall with two rows of windows and a door, for the whole front."""
    height, width = 384, 768
    stain = noise("tank/facade", height, width, cells=4, octaves=7)
    image = fill(height, width, (0.80, 0.76, 0.68)) * (1.0 + 0.04 * stain)[:, :, None]
    for row in (0.16, 0.55):
        for column in range(7):
            left, top = 0.05 + column * 0.133, row
            if row > 0.5 and column == 3:
                continue
            a, b = round(left * width), round((left + 0.085) * width)
            c, d = round(top * height), round((top + 0.26) * height)
            image[c - 5 : d + 5, a - 5 : b + 5] = (0.92, 0.92, 0.90)
            sky = noise("tank/facade/glass", d - c, b - a, cells=2, octaves=3)
            image[c:d, a:b] = fill(d - c, b - a, (0.22, 0.30, 0.38)) * (
                1.0 + 0.15 * sky[:, :, None]
            )
            image[c:d, (a + b) // 2 - 2 : (a + b) // 2 + 2] = (0.92, 0.92, 0.90)
    image[round(0.52 * height) :, 345:420] = (0.30, 0.34, 0.40)
    image[round(0.52 * height) :, 381:384] = (0.70, 0.70, 0.70)
    image[round(0.94 * height) :] *= 0.6
    return to_texture("tank/facade", image, repeats=False)


def _title() -> Texture:
    """Return the board on the roof: lettering on wood."""
    height, width = 128, 1024
    grain = noise("tank/board", height, width, cells=8, octaves=4, gain=0.8)
    image = fill(height, width, (0.55, 0.38, 0.20)) * (1.0 + 0.06 * grain)[:, :, None]
    image[:6] = image[-6:] = image[:, :6] = image[:, -6:] = (0.25, 0.16, 0.08)
    cream = (0.96, 0.93, 0.84)
    paint_text(
        image, "UNDERWATER ROBOTICS TEST TANK", (0.5, 0.40), width=0.90, height=0.38, colour=cream
    )
    paint_text(image, "uwsim  -  16 x 8 x 5 m", (0.5, 0.77), height=0.17, colour=cream)
    return to_texture("tank/title", image, repeats=False)


def _window() -> Texture:
    """Return the observation window: panes, frames, and a dim room behind."""
    height, width = 128, 576
    glow = noise("tank/window", height, width, cells=2, octaves=5)
    image = fill(height, width, (0.10, 0.17, 0.21)) * (1.0 + 0.25 * glow)[:, :, None]
    for k in range(4):
        edge = round(k * (width - 10) / 3)
        image[:, edge : edge + 10] = (0.62, 0.66, 0.68)
    image[:8] = image[-8:] = (0.62, 0.66, 0.68)
    return to_texture("tank/window", image, repeats=False)


def _wall_under_water() -> Texture:
    """Return painted cement, bluish under water, with joints every half metre."""
    return cement("tank/under-water", (0.50, 0.66, 0.74), joints=4)


def tank() -> tuple[Mesh, ...]:
    """Return the basin, the objects in it, and its surroundings."""
    wet_wall, dry_wall = _wall_under_water(), cement("tank/cement", (0.66, 0.65, 0.62), size=256)
    (px, py), pz = IMAGE_SIZE, IMAGE_TOP
    floor_z = -4.85
    slab = quad((-px / 2, -py / 2, pz), (px / 2, -py / 2, pz), (px / 2, py / 2, pz),
                (-px / 2, py / 2, pz), cuts=(6, 12))  # fmt: skip
    sides = [
        quad((-px / 2, -py / 2, floor_z), (px / 2, -py / 2, floor_z), (px / 2, -py / 2, pz),
             (-px / 2, -py / 2, pz)),
        quad((px / 2, -py / 2, floor_z), (px / 2, py / 2, floor_z), (px / 2, py / 2, pz),
             (px / 2, -py / 2, pz)),
        quad((px / 2, py / 2, floor_z), (-px / 2, py / 2, floor_z), (-px / 2, py / 2, pz),
             (px / 2, py / 2, pz)),
        quad((-px / 2, py / 2, floor_z), (-px / 2, -py / 2, floor_z), (-px / 2, -py / 2, pz),
             (-px / 2, py / 2, pz)),
    ]  # fmt: skip
    window = quad((-2.7, 3.96, -1.95), (2.7, 3.96, -1.95), (2.7, 3.96, -0.75), (-2.7, 3.96, -0.75))
    frame = join(
        box((-2.8, 3.93, -2.05), (2.8, 4.0, -1.95)),
        box((-2.8, 3.93, -0.75), (2.8, 4.0, -0.65)),
        box((-2.8, 3.93, -1.95), (-2.7, 4.0, -0.75)),
        box((2.7, 3.93, -1.95), (2.8, 4.0, -0.75)),
    )
    house = box((-8.3, 4.32, 0.1), (8.3, 9.6, 4.67))
    front = quad((-8.3, 4.3, 0.1), (8.3, 4.3, 0.1), (8.3, 4.3, 4.67), (-8.3, 4.3, 4.67))
    board = quad((-5.12, 4.22, 4.6), (5.12, 4.22, 4.6), (5.12, 4.22, 5.93), (-5.12, 4.22, 5.93))
    steel = (0.62, 0.65, 0.67)
    return (
        mesh(slab, texture=mosaic()),
        mesh(*sides, frame, colour=steel),
        mesh(_floor().project_uv(2.0), _walls(None, 0.0).project_uv(2.0), texture=wet_wall),
        mesh(_walls(0.0, RIM_TOP).project_uv(2.0), _deck().project_uv(2.0), texture=dry_wall),
        mesh(window, texture=_window()),
        mesh(front, texture=_facade()),
        mesh(house.project_uv(3.0), texture=cement("tank/render", (0.74, 0.70, 0.63), size=256)),
        mesh(board, texture=_title()),
        mesh(
            box((-5.14, 4.24, 4.58), (5.14, 4.34, 5.92)),
            texture=worn_paint("tank/wood", (0.4, 0.27, 0.14)),
        ),
        mesh(_ground().project_uv(3.0), texture=_grass()),
    )


def higher_tank() -> tuple[Mesh, ...]:
    """Return the older model ``cirs``: the same tank, 0.43 m higher."""
    up = np.array([0.0, 0.0, 0.43], dtype=np.float32)
    return tuple(replace(part, vertices=part.vertices + up) for part in tank())

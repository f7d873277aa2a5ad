"""A tiled pool of 12 x 8 m, 4 m deep: ``terrain/pool/pool``; the water at z = 0, x along it."""

from __future__ import annotations

import numpy as np

from uwsim.base import rng

from ..parts import Part
from ..shapes import Shape, box, cylinder, quad, ring, tube
from ..surfaces import Material, make_material
from ..textures import Colour, noise, smoothstep
from .vehicle_parts import make_paint

HALF_LENGTH, HALF_WIDTH, DEPTH, RIM = 6.0, 4.0, 4.0, 0.25
"""The half length and width, the depth, and the height of the rim above the water [m]."""
TILES, IMAGE_SIDE = 8, 1.6
"""The tiles along an image, and the side of an image [m]."""
LANE = 0.2
"""The width of the lane marks [m]."""


def pool() -> tuple[Part, ...]:
    """Return the pool."""
    x, y, low, high = HALF_LENGTH, HALF_WIDTH, -DEPTH, RIM
    white = _tiles("white", (0.62, 0.70, 0.72))
    blue = _tiles("blue", (0.07, 0.17, 0.36))
    steel = make_paint("pool-steel", (0.68, 0.69, 0.70), 0.25, metallic=0.9)
    walls = [
        quad((-x, -y, low), (x, -y, low), (x, y, low), (-x, y, low), cuts=(6, 4)),
        quad((x, -y, low), (-x, -y, low), (-x, -y, high), (x, -y, high), cuts=(6, 2)),
        quad((-x, y, low), (x, y, low), (x, y, high), (-x, y, high), cuts=(6, 2)),
        quad((-x, -y, low), (-x, y, low), (-x, y, high), (-x, -y, high), cuts=(4, 2)),
        quad((x, y, low), (x, -y, low), (x, -y, high), (x, y, high), cuts=(4, 2)),
    ]
    marks = [_mark(lane) for lane in (-2.0, 0.0, 2.0)]
    marks += [
        box((side * (x - 0.004) - 0.004, -y, -0.2), (side * (x - 0.004) + 0.004, y, 0.0))
        for side in (-1.0, 1.0)
    ]
    edge = [
        box((-x - 0.5, -y - 0.5, high - 0.06), (x + 0.5, -y, high)),
        box((-x - 0.5, y, high - 0.06), (x + 0.5, y + 0.5, high)),
        box((-x - 0.5, -y, high - 0.06), (-x, y, high)),
        box((x, -y, high - 0.06), (x + 0.5, y, high)),
    ]
    return (
        white.cover(*(shape.project_uv(IMAGE_SIDE) for shape in (*walls, *edge))),
        blue.cover(*(shape.project_uv(IMAGE_SIDE) for shape in marks)),
        steel.cover(*(shape.project_uv(0.4) for shape in _make_steel()), crease=1.0),
    )


def _mark(y: float) -> Shape:
    x, z = HALF_LENGTH - 1.6, -DEPTH + 0.003
    y0, y1 = y - LANE / 2.0, y + LANE / 2.0
    return quad((-x, y0, z), (x, y0, z), (x, y1, z), (-x, y1, z))


def _make_steel() -> list[Shape]:
    """Return a ladder, the drain, and nozzles in the walls."""
    y = -HALF_WIDTH + 0.12
    shapes = []
    for x in (4.3, 4.8):
        line = [(x, y, -1.6), (x, y, 0.7), (x, y - 0.12, 0.95), (x, y - 0.5, 0.98),
                (x, y - 0.62, 0.85), (x, y - 0.62, RIM)]  # fmt: skip
        shapes.append(tube(line, 0.021, n=14))
    shapes += [
        cylinder((4.3, y, z), (4.8, y, z), 0.02, n=12) for z in (-1.4, -1.1, -0.8, -0.5, -0.2)
    ]
    z = -DEPTH
    shapes.append(ring(0.2, 0.16, z, z + 0.012, n=32).shift(-3.0, 1.0))
    for k in range(7):
        offset = -0.15 + 0.05 * k
        shapes.append(box((-3.15, 1.0 + offset, z + 0.004), (-2.85, 1.012 + offset, z + 0.01)))
    for x in (-4.0, 0.0, 4.0):
        y = HALF_WIDTH
        shapes.append(cylinder((x, y - 0.02, -0.5), (x, y, -0.5), 0.06, n=24, bevel=0.005))
    return shapes


def _tiles(name: str, colour: Colour) -> Material:
    """Return glazed tiles of 0.2 m with joints; each has its own shade and tilt."""
    size = 512
    cells = size // TILES
    stream = rng.stream(0, f"assets/pool/{name}")
    shade = np.kron(stream.normal(1.0, 0.028, (TILES, TILES)), np.ones((cells, cells)))
    line = np.arange(size) % cells
    gap = np.minimum(line + 0.5, cells - line - 0.5)
    gap = np.minimum(gap[:, None], gap[None, :]).astype(np.float32)
    tile = smoothstep(1.2, 2.8, gap)
    dirt = noise(f"pool/{name}/dirt", size, size, cells=3, octaves=6)
    grain = noise(f"pool/{name}/grain", size, size, cells=size // 8, octaves=2)
    image = np.array(colour, dtype=np.float32) * shade[..., None].astype(np.float32)
    image = image * (1.0 + 0.025 * dirt)[..., None]
    grout = np.array((0.42, 0.43, 0.40), dtype=np.float32) * (1.0 + 0.08 * grain)[..., None]
    image = grout + (image - grout) * tile[..., None]
    tilt = stream.normal(0.0, 0.0009, (2, TILES, TILES))
    slope_x, slope_y = (np.kron(part, np.ones((cells, cells))) for part in tilt)
    tile_shares = (line - 0.5 * cells) / cells
    bend = slope_x * tile_shares[None, :] + slope_y * tile_shares[:, None]
    height = (0.0016 * smoothstep(0.5, 5.0, gap) + bend).astype(np.float32)
    roughness = np.clip(0.85 - 0.68 * tile + 0.05 * np.maximum(dirt, 0.0), 0.08, 1.0)
    pixel = IMAGE_SIDE / size
    return make_material(
        f"pool/{name}", image, height, roughness, pixel=(pixel, pixel), occlusion_depth=0.004
    )

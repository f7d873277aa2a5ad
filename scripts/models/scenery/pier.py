"""A pier on concrete piles: ``objects/pier``; still water at z = 0, the sea floor at z = -8 m.

The piles have the zones of a shore: bare concrete, green algae, barnacles about the water line,
mussels below it, and turf and sponges further down.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from uwsim.base import rng

from ..cached import cache_image
from ..fields import Points, Values, cells3, noise3
from ..parts import Part
from ..shapes import (
    Shape,
    box,
    cylinder,
    join,
    rotation_to,
    rounded_box,
    surface,
    torus,
    tube,
)
from ..surfaces import Material, make_material
from ..textures import Colour, noise, smoothstep
from .growth import scatter_growth
from .steel import Coat, weathered_steel

FOOT, TOP, RADIUS = -8.6, 1.7, 0.28
"""The heights of the ends of the piles, and their radius [m]."""
PILES = [(x, y) for x in (-5.2, -1.75, 1.75, 5.2) for y in (-2.0, 2.0)]
HALF_LENGTH, HALF_WIDTH, DECK = 6.2, 2.6, 2.2
"""The half length and half width of the deck, and its height [m]."""
IMAGE = (1152, 192)
"""The rows and columns of the image round a pile."""
CEMENT, ALGAE, MUSSEL = (0.44, 0.425, 0.39), (0.25, 0.27, 0.15), (0.11, 0.11, 0.12)
TURF, BARNACLE, STAIN = (0.29, 0.27, 0.19), (0.56, 0.54, 0.49), (0.30, 0.27, 0.23)


def pier() -> tuple[Part, ...]:
    """Return the pier."""
    steel = weathered_steel("pier", Coat(paint_share=0.1, growth=0.3), size=256, metres=1.5)
    rubber = weathered_steel(
        "rubber", Coat(paint=(0.06, 0.06, 0.065), paint_share=1.6, growth=0.25, streaks=0.1),
        size=128, metres=1.5,
    )  # fmt: skip
    beams = [shape.project_uv(1.5) for shape in _make_beams()]
    piles = _pile_material().cover(
        *(_make_pile(k, *pile) for k, pile in enumerate(PILES)), crease=2
    )
    return (
        piles,
        _timber().cover(*_make_planks(), crease=0.4),
        _cement().cover(*beams, crease=0.4),
        steel.cover(*_make_ladder(), *_make_fittings(), crease=1.0),
        rubber.cover(*_make_fenders(), crease=2.0),
        *_make_growth(piles),
    )


def _zones(points: Points) -> tuple[Values, Values, Values, Values]:
    """Return the covers by algae, barnacles, mussels and turf at points, 0..1."""
    z = points[..., 2] + 0.22 * noise3("pier/zones", points, 0.8, octaves=4)
    patches = noise3("pier/patches", points, 0.45, octaves=5, gain=0.6)
    algae = smoothstep(0.85, 0.35, z) * smoothstep(-0.9, -0.2, z)
    barnacles = (
        smoothstep(0.55, 0.25, z) * smoothstep(-2.2, -0.3, z) * smoothstep(-0.5, 0.4, patches)
    )
    mussels = smoothstep(-0.15, -0.5, z) * smoothstep(-4.2, -2.0, z)
    mussels = mussels * smoothstep(-0.9, 0.1, patches)
    turf = smoothstep(-1.2, -2.8, z) * smoothstep(-1.0, 0.4, patches + 0.3)
    return algae, barnacles, mussels, turf


def _thickness(points: Points) -> Values:
    """Return the thickness of the growth on a pile [m]."""
    _, _, mussels, turf = _zones(points)
    lumps = noise3("pier/lumps", points, 0.3, octaves=3)
    return 0.075 * mussels * (1.0 + 0.5 * lumps) + 0.03 * turf * (1.0 + 0.6 * lumps)


def _pile_points(n_rows: int, n_columns: int) -> Points:
    """Return points on a pile at the origin, (rows, columns, 3), from top to foot [m]."""
    z = np.linspace(TOP, FOOT, n_rows)[:, None]
    angle = np.linspace(0.0, 2.0 * math.pi, n_columns)[None, :]
    x, y = RADIUS * np.cos(angle), RADIUS * np.sin(angle)
    grid = np.broadcast_arrays(x, y, z)
    return np.stack(grid, axis=2).astype(np.float32)


def _make_pile(index: int, x: float, y: float) -> Shape:
    """Return a pile, which is turned so that neighbours look different."""
    n_rows, n_columns = 36, 16
    points = _pile_points(n_rows, n_columns + 1)[::-1].astype(np.float64)
    radius = RADIUS + _thickness(points.astype(np.float32)).astype(np.float64)
    points[..., :2] *= (radius / RADIUS)[..., None]
    pile = surface(points)
    turn = 1.7 * index
    cos, sin = math.cos(turn), math.sin(turn)
    rotation = np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
    return pile.rotate(rotation).shift(x, y)


@cache_image
def _pile_material() -> Material:
    points = _pile_points(IMAGE[0], IMAGE[1] + 1)[:, :-1]
    algae, barnacles, mussels, turf = _zones(points)
    grain = noise3("pier/grain", points, 0.08, octaves=4, gain=0.7)
    clouds = noise3("pier/broad", points, 1.1, octaves=4)
    tufts = noise3("pier/tufts", points, 0.045, octaves=3, gain=0.8)
    image = np.array(CEMENT, dtype=np.float32) * (1.0 + 0.09 * grain + 0.08 * clouds)[..., None]
    image = _blend(image, STAIN, 0.6 * smoothstep(1.4, 0.3, points[..., 2] + 0.4 * clouds))
    image = _blend(image, ALGAE, algae * (0.8 + 0.2 * tufts))
    distance, rank = cells3("pier/barnacles", points, 0.034)
    cone = np.clip(1.5 - 3.2 * distance, 0.0, 1.0) * (barnacles > rank)
    mouth = smoothstep(0.17, 0.10, distance) * (barnacles > rank)
    image = _blend(image, BARNACLE, smoothstep(0.0, 0.3, cone) * (0.65 + 0.35 * rank))
    shells, shade = cells3("pier/mussels", points * np.array([1, 1, 0.6], dtype=np.float32), 0.05)
    dome = np.sqrt(np.clip(1.0 - 2.2 * shells * shells, 0.0, 1.0))
    mussel_image = (
        np.array(MUSSEL, dtype=np.float32) * (0.6 + 1.1 * dome * (0.4 + shade))[..., None]
    )
    image = image + (mussel_image - image) * (0.95 * mussels)[..., None]
    turf_image = np.array(TURF, dtype=np.float32) * (1.0 + 0.4 * tufts)[..., None]
    image = image + (turf_image - image) * (0.85 * turf)[..., None]
    image *= (1.0 - 0.6 * mouth)[..., None]
    height = 0.001 * grain + 0.010 * cone - 0.009 * mouth + 0.02 * dome * mussels
    height = height + turf * (0.008 + 0.006 * tufts)
    roughness = np.clip(0.85 - 0.4 * mussels * dome + 0.1 * turf, 0.3, 1.0)
    pixel = (2.0 * math.pi * RADIUS / IMAGE[1], (TOP - FOOT) / IMAGE[0])
    return make_material("pier/pile", image, height, roughness, pixel=pixel, occlusion_depth=0.03)


def _make_planks() -> list[Shape]:
    stream = rng.stream(0, "assets/pier/planks")
    shapes, x = [], -HALF_LENGTH
    while x < HALF_LENGTH - 0.15:
        width = float(stream.uniform(0.17, 0.21))
        overhang = float(stream.uniform(-0.05, 0.05))
        low, high = (
            (x, -HALF_WIDTH + overhang, DECK - 0.06),
            (x + width, HALF_WIDTH + overhang, DECK),
        )
        plank = box(low, high).project_uv(0.8)
        shapes.append(replace(plank, uvs=plank.uvs + stream.random(2)))
        x += width + 0.018
    return shapes


def _make_beams() -> list[Shape]:
    xs = sorted({x for x, _ in PILES})
    beams = [
        rounded_box((x - 0.3, -2.5, TOP - 0.35), (x + 0.3, 2.5, TOP + 0.1), radius=0.03) for x in xs
    ]
    for y in (-2.0, 0.0, 2.0):
        low, high = (-6.1, y - 0.14, TOP + 0.1), (6.1, y + 0.14, DECK - 0.06)
        beams.append(rounded_box(low, high, radius=0.02))
    return beams


def _make_ladder() -> list[Shape]:
    """Return a ladder at the side y = -2.6 m, down to 3 m below the water."""
    x, y, low, high = 0.0, -2.75, -3.0, DECK + 0.9
    shapes = []
    for side in (-0.22, 0.22):
        curve = [(x + side, y, low), (x + side, y, high - 0.2), (x + side, y + 0.12, high),
                 (x + side, y + 0.45, high), (x + side, y + 0.5, DECK)]  # fmt: skip
        shapes.append(tube(curve, 0.028, n=10))
    shapes += [
        cylinder((x - 0.22, y, z), (x + 0.22, y, z), 0.016, n=8)
        for z in np.arange(low + 0.15, DECK, 0.3).tolist()
    ]
    for z in (1.4, 0.0):
        for side in (-0.22, 0.22):
            shapes.append(cylinder((x + side, y, z), (x + side, y + 0.4, z), 0.02, n=8))
    return shapes


def _make_fittings() -> list[Shape]:
    """Return bollards, braces between the piles, and the chains of the fenders."""
    shapes = []
    for x in (-4.6, 4.6):
        for part in (
            cylinder((x, -2.25, DECK), (x, -2.25, DECK + 0.32), 0.11, n=16),
            cylinder((x, -2.25, DECK + 0.32), (x, -2.25, DECK + 0.42), 0.16, n=16, bevel=0.03),
        ):
            shapes.append(part)
    for y in (-2.0, 2.0):
        shapes.append(cylinder((-5.2, y, -1.2), (-1.75, y, 1.1), 0.05, n=10))
        shapes.append(cylinder((5.2, y, -1.2), (1.75, y, 1.1), 0.05, n=10))
    for x in (-3.5, 3.5):
        shapes += [
            cylinder((x + dx, -2.62, DECK - 0.05), (x + 0.4 * dx, -2.78, 0.95), 0.014, n=6)
            for dx in (-0.25, 0.25)
        ]
    return [shape.project_uv(1.5) for shape in shapes]


def _make_fenders() -> list[Shape]:
    rotation = rotation_to(np.array([0.0, 1.0, 0.0]))
    tyre = join(
        torus(0.36, 0.13, n=28, m=12).scale(1.0, 1.0, 0.85),
        torus(0.3, 0.11, n=28, m=8),
    )
    return [tyre.rotate(rotation).shift(x, -2.8, 0.62).project_uv(1.5) for x in (-3.5, 3.5)]


def _make_growth(piles: Part) -> list[Part]:
    """Return sponges and mussels on the piles below the water."""
    mesh = piles.mesh
    stream = rng.stream(0, "assets/pier/growth-places")
    candidates = np.flatnonzero((mesh.vertices[:, 2] < -1.0) & (mesh.vertices[:, 2] > -7.8))
    places = stream.choice(candidates, 32, replace=False)
    points, normals = (a[places].astype(np.float64) for a in (mesh.vertices, mesh.normals))
    return scatter_growth("pier", points, normals, size=(0.06, 0.2))


@cache_image
def _timber() -> Material:
    """Return grey planks, whose grain runs along the columns."""
    size = 256
    rings = noise("pier/rings", size, 8 * size, cells=40, octaves=4, gain=0.7)
    grain = np.asarray(rings.reshape(size, size, 8).mean(axis=2), dtype=np.float32)
    grain = np.ascontiguousarray(grain.T) / grain.std()
    clouds = noise("pier/timber", size, size, cells=3, octaves=6)
    image = np.array((0.36, 0.32, 0.26), dtype=np.float32) * np.ones((size, size, 1), np.float32)
    image *= (1.0 + 0.16 * grain + 0.10 * clouds)[..., None]
    image = _blend(image, (0.17, 0.18, 0.11), 0.5 * smoothstep(0.5, 1.6, clouds))
    pixel = 0.8 / size
    return make_material("pier/timber", image, 0.0012 * grain, 0.85, pixel=(pixel, pixel))


@cache_image
def _cement() -> Material:
    size = 256
    clouds = noise("pier/concrete", size, size, cells=3, octaves=6, gain=0.6)
    pores = noise("pier/pores", size, size, cells=size // 5, octaves=2)
    image = np.array(CEMENT, dtype=np.float32) * np.ones((size, size, 1), np.float32)
    image *= (1.0 + 0.10 * clouds - 0.25 * smoothstep(1.8, 2.6, pores))[..., None]
    image = _blend(image, STAIN, 0.5 * smoothstep(0.3, 1.5, -clouds))
    height = 0.001 * clouds - 0.004 * smoothstep(1.8, 2.6, pores)
    pixel = 1.5 / size
    return make_material("pier/concrete", image, height, 0.88, pixel=(pixel, pixel))


def _blend(image: Points, end: Colour, amount: Values) -> Points:
    blend: Points = image + (np.array(end, dtype=np.float32) - image) * amount[..., None]
    return blend

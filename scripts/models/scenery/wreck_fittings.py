"""What stands on the wreck: deckhouse, mast, derricks, rails, windlass, anchor, propeller, cargo.

In the frame of the ship (`wreck_hull`).
"""

from __future__ import annotations

import itertools
import math

import numpy as np

from uwsim.base import rng
from uwsim.base.geometry import rotation_from_rpy, rotation_z

from ..shapes import (
    Shape,
    box,
    circle,
    cylinder,
    join,
    lathe,
    loft,
    quad,
    ring,
    rotation_to,
    rounded_box,
    surface,
    torus,
    tube,
)
from .chain import chain_links
from .wreck_hull import LENGTH, TANK_TOP, TILE, deck_height, hull_point

Hole = tuple[float, float, float, float]
"""A hole in a wall: its left, bottom, right and top [m]."""
WALL = 0.07
"""The thickness of the walls of the deckhouse [m]."""


def make_deckhouse() -> list[Shape]:
    """Return two decks of the deckhouse, with doors and windows that are open, and a funnel."""
    x0, x1, y, z0 = -9.2, -3.4, 2.05, DECK
    z1 = z0 + 2.3
    side_holes = [(0.6, 0.25, 1.25, 2.05), (2.2, 1.1, 2.65, 1.55), (3.3, 1.1, 3.75, 1.55),
                  (4.4, 1.1, 4.85, 1.55)]  # fmt: skip
    front_holes = [(0.5, 0.2, 1.2, 2.0), (2.7, 1.0, 3.4, 1.6)]
    shapes = [
        _make_walls((x0, -y, z0), (x1, y, z1), side_holes, front_holes),
        box((x0 - 0.25, -y - 0.35, z1), (x1 + 0.3, y + 0.35, z1 + 0.09)),
    ]
    bridge = [(0.3, 1.0, 0.95, 1.7), (1.1, 1.0, 1.75, 1.7), (1.9, 1.0, 2.55, 1.7)]
    windows = [(0.25, 0.95, 0.9, 1.7), (1.05, 0.95, 1.7, 1.7), (1.85, 0.95, 2.5, 1.7),
               (2.65, 0.95, 3.25, 1.7)]  # fmt: skip
    low, high = (-6.6, -1.75, z1 + 0.09), (-3.7, 1.75, z1 + 2.25)
    shapes += [
        _make_walls(low, high, bridge, windows),
        box((-6.85, -2.0, high[2]), (-3.3, 2.0, high[2] + 0.08)),
    ]
    funnel = loft(
        np.array(
            [
                np.column_stack([circle(r, 18) * np.array([1.25, 1.0]), np.full(18, z)])
                + np.array([shift, 0.0, 0.0])
                for z, r, shift in ((0, 0.62, 0), (1.4, 0.60, -0.12), (2.3, 0.58, -0.2))
            ]
        ),
        has_lids=False,
    ).shift(-7.8, 0.0, z1 + 0.05)
    rim = torus(0.6, 0.05, n=18, m=6).scale(1.25, 1.0, 1.0).shift(-8.0, 0.0, z1 + 2.35)
    return [shape.project_uv(TILE) for shape in (*shapes, funnel, funnel.flip(), rim)]


DECK = 3.62
"""The height of the main deck at the deckhouse [m]."""


def _make_walls(
    low: tuple[float, float, float],
    high: tuple[float, float, float],
    side_holes: list[Hole],
    front_holes: list[Hole],
) -> Shape:
    """Return four walls with holes; those of the sides are equal, and those of front and back."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    long_wall = wall(x1 - x0, z1 - z0, side_holes)
    cross_wall = wall(y1 - y0, z1 - z0, front_holes)
    quarter = rotation_z(math.pi / 2.0)
    return join(
        long_wall.shift(x0, y0, z0),
        long_wall.shift(x0, y1 - WALL, z0),
        cross_wall.rotate(quarter).shift(x1, y0, z0),
        cross_wall.rotate(quarter).shift(x0 + WALL, y0, z0),
    )


def wall(width: float, height: float, holes: list[Hole]) -> Shape:
    """Return a wall in the plane y = 0, `WALL` thick to +y, with rectangular holes."""
    xs = sorted({0.0, width, *(x for hole in holes for x in (hole[0], hole[2]))})
    zs = sorted({0.0, height, *(z for hole in holes for z in (hole[1], hole[3]))})
    shapes = []

    def is_open(x: float, z: float) -> bool:
        return any(h[0] < x < h[2] and h[1] < z < h[3] for h in holes)

    for a, b in itertools.pairwise(xs):
        for c, d in itertools.pairwise(zs):
            if not is_open(0.5 * (a + b), 0.5 * (c + d)):
                face = quad((a, 0, c), (b, 0, c), (b, 0, d), (a, 0, d))
                back = quad((b, WALL, c), (a, WALL, c), (a, WALL, d), (b, WALL, d))
                shapes += [face, back]
    for left, low, right, high in holes:
        lip = [(left, low), (right, low), (right, high), (left, high)]
        for (xa, za), (xb, zb) in zip(lip, [*lip[1:], lip[0]], strict=True):
            shapes.append(quad((xa, 0, za), (xa, WALL, za), (xb, WALL, zb), (xb, 0, zb)).flip())
    shapes.append(
        quad((0, 0, height), (width, 0, height), (width, WALL, height), (0, WALL, height))
    )
    return join(*shapes)


def make_masts() -> list[Shape]:
    """Return the mast before the hold, its derricks, one of them fallen, and slack wires."""
    foot = (4.9, 0.0, 3.8)
    top = (4.7, 0.15, 12.2)
    shapes = [
        cylinder(foot, top, 0.2, n=14, top=0.6),
        cylinder((4.75, -1.5, 9.6), (4.75, 1.7, 9.75), 0.07, n=8),
        rounded_box((4.4, -0.5, 10.3), (5.2, 0.6, 10.42), radius=0.05),
        cylinder((4.7, 0.0, 4.6), (-1.3, -2.6, 5.2), 0.11, n=10, top=0.7),
        cylinder((4.7, 0.2, 4.6), (-0.8, 1.2, 9.2), 0.11, n=10, top=0.7),
    ]
    for start, end, sag in (
        (top, (12.2, 0.0, 5.4), 0.5),
        ((4.75, 1.7, 9.7), (-0.8, 1.2, 9.2), 0.9),
        ((4.75, -1.5, 9.6), (3.2, -3.0, 4.2), 0.3),
        ((4.75, 1.7, 9.7), (3.4, 3.0, 4.2), 0.3),
        ((4.7, 0.1, 11.6), (-5.0, 0.3, 8.5), 1.6),
    ):
        shapes.append(_wire(start, end, sag))
    return [shape.scale_uv(1.0, 3.0) for shape in shapes]


def _wire(start: tuple[float, float, float], end: tuple[float, float, float], sag: float) -> Shape:
    shares = np.linspace(0.0, 1.0, 13)[:, None]
    line = np.array(start) * (1.0 - shares) + np.array(end) * shares
    line[:, 2:] -= 4.0 * sag * shares * (1.0 - shares)
    return tube(line, 0.018, n=5)


def make_rails() -> list[Shape]:
    """Return rails along the deck's edges, with gaps where they are lost."""
    stream = rng.stream(0, "assets/wreck/rails")
    shapes = []
    for side in (-1.0, 1.0):
        stations = np.linspace(0.04, 0.97, 29)
        feet = np.array([hull_point(float(s), 1.0, side) for s in stations])
        feet[:, 1] -= 0.06 * side
        tilts = stream.normal(0.0, 0.09, len(feet))
        tops = feet + np.stack([tilts, tilts * 0.7, np.full(len(feet), 0.95)], axis=1)
        has_post = stream.random(len(feet)) > 0.16
        for k in range(len(feet)):
            if has_post[k]:
                shapes.append(cylinder(_triple(feet[k]), _triple(tops[k]), 0.022, n=5))
            if k and has_post[k] and has_post[k - 1] and float(stream.random()) > 0.2:
                for share in (0.5, 1.0):
                    ends = [feet[i] + share * (tops[i] - feet[i]) for i in (k - 1, k)]
                    middle = 0.5 * (ends[0] + ends[1]) - np.array([0.0, 0.0, 0.04])
                    shapes.append(tube(np.stack([ends[0], middle, ends[1]]), 0.017, n=5))
    return shapes


def _triple(point: np.ndarray) -> tuple[float, float, float]:
    x, y, z = point.tolist()
    return x, y, z


def make_gear() -> list[Shape]:
    """Return windlass, bollards, ventilators, propeller, rudder, anchor and its chain."""
    deck = deck_height(0.9)
    shapes = [
        cylinder((9.6, -0.9, deck + 0.55), (9.6, 0.9, deck + 0.55), 0.28, n=16, bevel=0.03),
        cylinder((9.6, -1.1, deck + 0.55), (9.6, -0.86, deck + 0.55), 0.42, n=18, bevel=0.03),
        cylinder((9.6, 0.86, deck + 0.55), (9.6, 1.1, deck + 0.55), 0.42, n=18, bevel=0.03),
        rounded_box((9.1, -1.0, deck), (10.1, 1.0, deck + 0.2), radius=0.05),
    ]
    for x, y in ((8.2, 1.9), (8.2, -1.9), (-10.6, 1.5), (-10.6, -1.5)):
        z = deck_height(0.5 + x / LENGTH)
        for shift in (-0.22, 0.22):
            bollard = lathe([(0.13, 0), (0.13, 0.38), (0.18, 0.42), (0.18, 0.48), (0, 0.5)], n=12)
            shapes.append(bollard.shift(x + shift, y, z))
    for y, turn in ((1.35, 0.4), (-1.35, -0.9)):
        shapes += [part.rotate(rotation_z(turn)).shift(6.4, y, 3.95) for part in _ventilator()]
    shapes += [*_propeller(), *_anchor()]
    return shapes


def _ventilator() -> list[Shape]:
    pipe = ring(0.22, 0.2, 0.0, 1.25, n=14)
    mouth = lathe([(0.2, 0.0), (0.3, 0.24), (0.42, 0.36), (0.40, 0.38), (0.27, 0.25), (0.18, 0.0)])
    bend = tube([(0, 0, 1.2), (0.02, 0, 1.42), (0.16, 0, 1.6)], 0.22, n=14, has_lids=False)
    forward = rotation_to(np.array([1.0, 0.0, 0.35]))
    return [pipe, bend, mouth.rotate(forward).shift(0.12, 0.0, 1.56)]


def _propeller() -> list[Shape]:
    x, z = -0.5 * LENGTH + 0.7, 1.0
    hub = cylinder((x - 0.3, 0.0, z), (x + 0.9, 0.0, z), 0.14, n=14, bevel=0.04)
    shapes = [hub]
    for k in range(4):
        radii = np.linspace(0.1, 0.85, 7)[:, None]
        chord = np.linspace(-1.0, 1.0, 5)[None, :]
        width = 0.26 * np.sqrt(
            np.clip(1.0 - (2.0 * (radii - 0.1) / 0.75 - 0.9) ** 2 * 0.8, 0.02, 1)
        )
        pitch = 0.25 + 0.18 / (0.3 + radii)
        points = np.stack(
            [width * chord * pitch, width * chord, np.broadcast_to(radii, (7, 5))], axis=2
        )
        blade = surface(points)
        for face in (blade, blade.flip().shift(0.025)):
            rotated_face = face.rotate(rotation_from_rpy(k * math.pi / 2.0 + 0.3, 0.0, 0.0))
            shapes.append(rotated_face.shift(x, 0.0, z))
    rudder = rounded_box((x - 1.15, -0.06, 0.25), (x - 0.45, 0.06, 2.5), radius=0.05)
    return [*shapes, rudder]


def _anchor() -> list[Shape]:
    """Return a stockless anchor on the sea floor off the starboard bow, and its chain."""
    shank = rounded_box((-0.09, -0.07, 0.0), (0.09, 0.07, 1.5), radius=0.03)
    crown = rounded_box((-0.16, -0.5, -0.16), (0.16, 0.5, 0.12), radius=0.06)
    parts = [shank, crown]
    for y in (-0.4, 0.4):
        arm = loft(
            np.array(
                [
                    np.column_stack([circle(r, 8) * np.array([1.4, 0.7]), np.full(8, 0.0)])
                    + np.array([0.0, y + (0.08 if y > 0 else -0.08) * h, 0.05 + h])
                    for r, h in ((0.11, 0.0), (0.13, 0.4), (0.10, 0.75), (0.01, 1.0))
                ]
            )
        )
        parts.append(arm.rotate(rotation_from_rpy(0.0, 0.45, 0.0)))
    attitude = rotation_from_rpy(1.35, 0.2, 0.9)
    place = np.array([10.2, -4.6, 0.75])
    anchor = join(*parts).rotate(attitude).shift(*place.tolist())
    hawse = np.array(hull_point(0.93, 0.86, -1.0)) + np.array([0.0, -0.05, 0.0])
    end = place + 1.5 * attitude[:, 2]
    return [anchor, *chain_links(hawse, end, sag=0.9, bar=0.045)]


def make_cargo() -> list[Shape]:
    """Return barrels and crates in the hold, fallen over each other."""
    stream = rng.stream(0, "assets/wreck/cargo")
    profile = [(0.0, 0.0), (0.28, 0.0), (0.29, 0.03), (0.28, 0.06), (0.28, 0.29), (0.295, 0.30),
               (0.28, 0.31), (0.28, 0.57), (0.295, 0.58), (0.28, 0.59), (0.28, 0.82), (0.29, 0.85),
               (0.28, 0.88), (0.0, 0.86)]  # fmt: skip
    barrel = lathe(profile, n=16).shift(z=-0.44)
    shapes = []
    for _ in range(13):
        x, y = float(stream.uniform(-1.9, 3.2)), float(stream.uniform(-1.9, 1.2))
        rpy = (1.57, float(stream.uniform(0.0, 6.2)), float(stream.uniform(0.0, 3.1)))
        if float(stream.random()) < 0.35:
            rpy, lift = (float(stream.normal(0.0, 0.12)), 0.0, 0.0), 0.44
        else:
            lift = 0.28
        shapes.append(barrel.rotate(rotation_from_rpy(*rpy)).shift(x, y, TANK_TOP + lift))
    for _ in range(5):
        size = float(stream.uniform(0.35, 0.6))
        crate = rounded_box((-size, -0.7 * size, 0.0), (size, 0.7 * size, size), radius=0.02)
        turn = rotation_from_rpy(0.05, float(stream.normal(0.0, 0.1)), float(stream.uniform(0, 3)))
        x, y = float(stream.uniform(-1.5, 3.0)), float(stream.uniform(0.4, 2.2))
        shapes.append(crate.rotate(turn).shift(x, y, TANK_TOP))
    return [shape.project_uv(TILE) for shape in shapes]

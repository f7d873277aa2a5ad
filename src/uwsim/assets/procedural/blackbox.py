"""Flight recorders ("black boxes"): what is searched for, tracked and grasped.

Long axis y. Both large faces (z up and z down) carry the same markings, so that the box may lie
either way up.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from ..mesh import Mesh, Texture
from .shapes import Shape, cylinder, join, mesh, quad, tube
from .textures import Picture, finished, mixed, noise, plain, step, worn, write

ORANGE = (0.98, 0.42, 0.06)
"""International orange, as stored value."""
BAND = (0.93, 0.94, 0.92)
"""Reflective bands."""
INK = (0.05, 0.05, 0.05)
"""Lettering."""
WEAR = 0.30
"""How far scuffs and dirt take the paint away, 0..1. Raise WEAR for more contrast at small scale;
BAND and INK set the contrast of the large marks (DESIGN 6a asks for a deviation of 25 to 35)."""


def _paint(name: str, height: int, width: int) -> Picture:
    """Orange paint, clouded, scratched to the metal in places."""
    clouds = noise(f"{name}/clouds", height, width, cells=4, octaves=5)
    scuffs = noise(f"{name}/scuffs", height, width, cells=10, octaves=4, gain=0.7)
    picture = plain(height, width, ORANGE) * (1.0 + 0.05 * clouds)[..., None]
    picture = mixed(picture, (0.45, 0.24, 0.12), WEAR * step(0.8, 1.8, clouds))
    return mixed(picture, (0.72, 0.70, 0.66), 2.0 * WEAR * step(1.7, 2.3, scuffs))


@lru_cache(maxsize=1)
def face() -> Texture:
    """The large faces, seen with the box's +y end to the right."""
    height, width = 208, 640
    picture = _paint("blackbox/face", height, width)
    for left, right in ((0.045, 0.10), (0.80, 0.86)):
        picture[:, round(left * width) : round(right * width)] = BAND
    for k in range(9):  # hazard bars across one end
        a = np.arange(height)[:, None] + np.arange(width)[None, :] * 1.0
        bar = (a % 44 < 22) & (np.arange(width)[None, :] > 0.905 * width)
        picture[bar] = INK if k == 0 else picture[bar]
    write(picture, "FLIGHT RECORDER", (0.45, 0.27), width=0.62, height=0.24, colour=INK)
    write(picture, "DO NOT OPEN", (0.36, 0.66), width=0.42, height=0.22, colour=INK)
    picture[round(0.52 * height) : round(0.90 * height), 410:500] = BAND
    write(picture, "37.5 kHz", (0.71, 0.62), width=0.12, height=0.09, colour=INK)
    write(picture, "S/N 0427", (0.71, 0.78), width=0.12, height=0.09, colour=INK)
    write(picture, "ENREGISTREUR DE VOL", (0.36, 0.88), width=0.40, height=0.09, colour=INK)
    return finished("blackbox/face", picture, repeats=False)


@lru_cache(maxsize=1)
def side() -> Texture:
    """The narrow faces."""
    height, width = 128, 512
    picture = _paint("blackbox/side", height, width)
    for left, right in ((0.045, 0.10), (0.80, 0.86)):
        picture[:, round(left * width) : round(right * width)] = BAND
    write(picture, "FLIGHT RECORDER DO NOT OPEN", (0.45, 0.45), width=0.64, height=0.3, colour=INK)
    return finished("blackbox/side", picture, repeats=False)


def _body(lower: tuple[float, float, float], upper: tuple[float, float, float]) -> list[Mesh]:
    """A box along y with markings on all four long faces."""
    (x0, y0, z0), (x1, y1, z1) = lower, upper
    large = join(
        quad((x1, y0, z1), (x1, y1, z1), (x0, y1, z1), (x0, y0, z1)),
        quad((x0, y0, z0), (x0, y1, z0), (x1, y1, z0), (x1, y0, z0)),
    )
    narrow = join(
        quad((x1, y0, z0), (x1, y1, z0), (x1, y1, z1), (x1, y0, z1)),
        quad((x0, y1, z0), (x0, y0, z0), (x0, y0, z1), (x0, y1, z1)),
    )
    ends = join(
        quad((x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)),
        quad((x1, y1, z0), (x0, y1, z0), (x0, y1, z1), (x1, y1, z1)),
    )
    return [
        mesh(large, texture=face()),
        mesh(narrow, texture=side()),
        mesh(ends, texture=worn("blackbox/paint", ORANGE)),
    ]


def _bar(x: float, y0: float, y1: float, z: float, foot: float, radius: float) -> Shape:
    """A handle along y: a bar at height ``z`` on two feet that stand on ``foot``."""
    bend = 0.35 * (z - foot)
    path = [
        (x, y0, foot),
        (x, y0, z - bend),
        (x, y0 + 0.3 * bend, z - 0.3 * bend),
        (x, y0 + bend, z),
    ]
    back = [
        (x, y1 - bend, z),
        (x, y1 - 0.3 * bend, z - 0.3 * bend),
        (x, y1, z - bend),
        (x, y1, foot),
    ]
    return tube([*path, *back], radius, n=10)


def blackbox_uib() -> tuple[Mesh, ...]:
    """The recorder of UWSim's tank scenes: 0.13 x 0.433 x 0.15 m, body, pinger and handle."""
    body = _body((-0.065, -0.205, -0.075), (0.065, 0.200, 0.075))
    pinger = cylinder((0.0, -0.233, 0.03), (0.0, -0.2, 0.03), 0.035, n=20, bevel=0.004)
    return (*body, mesh(pinger, texture=worn("blackbox/steel", (0.75, 0.76, 0.77))))


def blackbox() -> tuple[Mesh, ...]:
    """The plain version: a box of 0.20 x 0.35 x 0.15 m with the markings."""
    return tuple(_body((-0.10, -0.175, -0.075), (0.10, 0.175, 0.075)))


def blackbox_standard() -> tuple[Mesh, ...]:
    """The recorder that `grasp` uses: 0.15 x 0.32 x 0.14 m, a 16 mm bar 50 mm above it."""
    body = _body((-0.075, -0.16, -0.07), (0.075, 0.16, 0.07))
    handle = _bar(0.0, -0.06, 0.06, 0.07 + 0.05 + 0.008, 0.069, 0.008)
    return (*body, mesh(handle, texture=worn("blackbox/steel", (0.75, 0.76, 0.77))))

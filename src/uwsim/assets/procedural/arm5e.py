"""The CSIP ARM5E, link by link: ``robot/ARM5E/ARM5E_part*``.

Each link stands in its own mesh frame, as in UWSim's robot file: the joint it hangs on is at the
origin (part0 and part1: the slew axis is z; part2: the shoulder, part3: the elbow, both along y;
part4_base: 28 mm behind the wrist, along x; jaws: their hinges along y). Where the next link
begins, there is a lug, a fork or a flange, so that the arm has no gaps in any posture.
"""

from __future__ import annotations

import math

import numpy as np

from ..mesh import Mesh
from .shapes import (
    Point,
    Shape,
    cylinder,
    join,
    loft,
    mesh,
    ring,
    rounded_box,
)
from .textures import worn

BLACK, SILVER, BRASS = (0.15, 0.155, 0.165), (0.66, 0.68, 0.70), (0.85, 0.45, 0.10)

ELBOW_IN_PART2 = (0.4315, 0.0, -0.0994)
"""The elbow's axis in the upper arm's mesh frame [m]."""
WRIST_HEIGHT = 0.083
"""The wrist's axis runs along x at this height in the forearm's mesh frame [m]."""
HINGE_IN_PART4 = (0.073, 0.0, 0.04)
"""A jaw's hinge in part4_base's mesh frame (the other has z reversed) [m]."""


def fitted(parts: list[Shape], lower: Point, upper: Point) -> list[Shape]:
    """The parts, stretched a little so that their common box is exactly this one."""
    points = join(*parts).corners.reshape(-1, 3)
    low, high = points.min(axis=0), points.max(axis=0)
    scale = (np.array(upper) - np.array(lower)) / (high - low)
    shift = np.array(lower) - low * scale
    return [part.scaled(*scale.tolist()).moved(*shift.tolist()) for part in parts]


def _metal(bright: list[Shape], dark: list[Shape], accent: list[Shape]) -> tuple[Mesh, ...]:
    groups = ((bright, "silver", SILVER), (dark, "black", BLACK), (accent, "bronze", BRASS))
    return tuple(
        mesh(
            *(part.projected(0.25) for part in parts),
            texture=worn(f"arm5e/{name}", colour, size=128),
        )
        for parts, name, colour in groups
        if parts
    )


def _link(
    bright: list[Shape], dark: list[Shape], accent: list[Shape], lower: Point, upper: Point
) -> tuple[Mesh, ...]:
    """Parts in three materials, fitted together into the link's box."""
    whole = fitted([*bright, *dark, *accent], lower, upper)
    b, d = len(bright), len(bright) + len(dark)
    return _metal(whole[:b], whole[b:d], whole[d:])


def _ram(start: Point, end: Point, radius: float, rod: float) -> tuple[list[Shape], list[Shape]]:
    """An electric linear actuator: its body, and the rod that leaves it for ``rod`` metres."""
    a, b = np.array(start), np.array(end)
    way = (b - a) / np.linalg.norm(b - a)
    split = tuple((b - rod * way).tolist())
    ring_at = tuple((b - (rod + 0.03) * way).tolist())
    body = [
        cylinder(start, split, radius, n=16, bevel=radius * 0.2),
        cylinder(ring_at, split, radius * 1.0, n=16, bevel=0.002),
    ]
    return body, [cylinder(split, end, radius * 0.4, n=10)]


def part0() -> tuple[Mesh, ...]:
    """The base: a beam under the hull, the slew bearing, and the slew actuator beside it."""
    beam = rounded_box((-0.336, -0.024, 0.008), (0.0, 0.024, 0.061), radius=0.006)
    foot = rounded_box((-0.33, -0.029, 0.045), (-0.24, 0.06, 0.058), radius=0.004)
    foot2 = rounded_box((-0.10, -0.029, 0.045), (-0.02, 0.06, 0.058), radius=0.004)
    bearing = cylinder((0.0, 0.0, -0.054), (0.0, 0.0, 0.061), 0.0295, n=24, bevel=0.004)
    body, rod = _ram((-0.32, 0.062, 0.028), (-0.005, 0.062, 0.028), 0.028, 0.12)
    lug = cylinder((-0.02, 0.055, 0.028), (0.006, 0.055, 0.028), 0.014, n=12)
    return _link(
        [beam, *rod, lug],
        [bearing, *body, foot, foot2],
        [],
        (-0.336, -0.029, -0.054),
        (0.031, 0.090, 0.061),
    )


def part1() -> tuple[Mesh, ...]:
    """The slew body: a sleeve round the bearing, and the fork that holds the shoulder."""
    sleeve = ring(0.034, 0.0297, -0.05, 0.03, n=24)
    cap = cylinder((0.0, 0.0, -0.095), (0.0, 0.0, -0.048), 0.034, n=24, bevel=0.004)
    ear = rounded_box((-0.016, 0.026, 0.014), (0.02, 0.047, 0.044), radius=0.006)
    neck = rounded_box((-0.02, -0.034, -0.135), (0.075, 0.034, -0.062), radius=0.012)
    forks, pins = [], []
    for side in (-1.0, 1.0):
        y0, y1 = sorted((side * 0.026, side * 0.040))
        forks.append(rounded_box((0.02, y0, -0.150), (0.100, y1, -0.075), radius=0.006))
        forks.append(cylinder((0.0805, y0, -0.13), (0.0805, y1, -0.13), 0.022, n=18))
        pins.append(cylinder((0.0805, y0 - 0.003, -0.13), (0.0805, y1 + 0.003, -0.13), 0.010, n=12))
    horn = rounded_box((0.06, -0.02, -0.09), (0.161, 0.02, -0.055), radius=0.008)
    return _link(
        [*forks, sleeve],
        [cap, neck, ear, horn],
        pins,
        (-0.034, -0.043, -0.152),
        (0.161, 0.047, 0.044),
    )


def part2() -> tuple[Mesh, ...]:
    """The upper arm: two side plates on a beam from shoulder to elbow, an actuator each side."""
    ex, _, ez = ELBOW_IN_PART2
    beam = []
    for y in (-0.019, 0.011):
        beam.append(_plate((0.0, ez * 0.0), (ex, ez), 0.022, y, y + 0.008))
    core = cylinder(
        (0.03, 0.0, ez * 0.03 / ex), (ex - 0.05, 0.0, ez * (ex - 0.05) / ex), 0.011, n=12
    )
    body1, rod1 = _ram((-0.06, -0.060, -0.004), (0.33, -0.060, -0.062), 0.028, 0.14)
    body2, rod2 = _ram((0.552, 0.066, -0.094), (0.06, 0.066, -0.020), 0.027, 0.16)
    motor = cylinder((-0.078, -0.060, -0.002), (-0.02, -0.060, -0.010), 0.0285, n=16, bevel=0.006)
    cross = [
        cylinder((0.27, -0.06, -0.055), (0.27, 0.066, -0.055), 0.010, n=10),
        cylinder((0.10, -0.06, -0.027), (0.10, 0.066, -0.027), 0.010, n=10),
        cylinder((0.0, -0.024, 0.0), (0.0, 0.024, 0.0), 0.0215, n=18),
    ]
    elbow = []
    for side in (-1.0, 1.0):
        y0, y1 = sorted((side * 0.019, side * 0.036))
        elbow.append(cylinder((ex, y0, ez), (ex, y1, ez), 0.022, n=18))
    return _link(
        [*beam, core, *rod1, *rod2, *elbow],
        [*body1, *body2, motor],
        cross,
        (-0.078, -0.088, -0.122),
        (0.559, 0.094, 0.022),
    )


def _plate(a: tuple[float, float], b: tuple[float, float], r: float, y0: float, y1: float) -> Shape:
    """A flat bar with round ends in the x-z plane from ``a`` to ``b``, between two y."""
    start, end = np.array(a), np.array(b)
    along = math.atan2(*(end - start)[::-1])
    first = along + math.pi / 2 + np.linspace(0.0, math.pi, 9)
    second = along - math.pi / 2 + np.linspace(0.0, math.pi, 9)
    outline = np.concatenate(
        [
            start + r * np.stack([np.cos(first), np.sin(first)], axis=1),
            end + r * np.stack([np.cos(second), np.sin(second)], axis=1),
        ]
    )
    x, z = outline[:, 0], outline[:, 1]
    rings = np.array([np.stack([x, np.full_like(x, y), z], axis=1) for y in (y1, y0)])
    return loft(rings)


def part3() -> tuple[Mesh, ...]:
    """The forearm: elbow lug, the wrist's motor housing along x, the jaw's actuator above it."""
    w = WRIST_HEIGHT
    lug = cylinder((0.0, -0.018, 0.0), (0.0, 0.018, 0.0), 0.022, n=18)
    web = [_plate((0.0, 0.0), (0.13, w), 0.022, y, y + 0.010) for y in (-0.017, 0.007)]
    housing = cylinder((0.045, 0.0, w), (0.30, 0.0, w), 0.050, n=24, bevel=0.008)
    collars = [
        cylinder((x, 0.0, w), (x + 0.022, 0.0, w), 0.0645 - 0.004 * (x < 0.2), n=24, bevel=0.003)
        for x in (0.085, 0.298)
    ]
    saddle = rounded_box((0.09, -0.02, w + 0.04), (0.24, 0.02, 0.19), radius=0.008)
    body, rod = _ram((-0.015, 0.0, 0.185), (0.29, 0.0, 0.185), 0.042, 0.06)
    bracket = rounded_box((0.255, -0.015, w + 0.05), (0.30, 0.015, 0.21), radius=0.008)
    return _link(
        [lug, *web, *collars, *rod, bracket], [housing, *body], [saddle],
        (-0.022, -0.065, -0.022), (0.320, 0.064, 0.227),
    )  # fmt: skip


def part4_base() -> tuple[Mesh, ...]:
    """The wrist's flange and the two pairs of prongs that carry the jaws."""
    hx, _, hz = HINGE_IN_PART4
    flange = cylinder((0.0, 0.0, 0.0), (0.018, 0.0, 0.0), 0.050, n=24, bevel=0.003)
    body = rounded_box((0.012, -0.040, -0.034), (0.060, 0.040, 0.034), radius=0.010)
    nose = cylinder((0.055, 0.0, 0.0), (0.085, 0.0, 0.0), 0.018, n=16, bevel=0.004)
    prongs, pins = [], []
    for side in (-1.0, 1.0):
        for y in (-0.050, 0.042):
            z0, z1 = sorted((side * 0.022, side * 0.052))
            prongs.append(rounded_box((0.03, y, z0), (0.105, y + 0.008, z1), radius=0.003, n=1))
        pins.append(cylinder((hx, -0.055, side * hz), (hx, 0.055, side * hz), 0.008, n=12))
    return _link(
        [flange, *prongs], [body, nose], pins, (0.0, -0.055, -0.052), (0.105, 0.055, 0.052)
    )


def jaw1() -> tuple[Mesh, ...]:
    """The jaw on the +z side: a curved scoop, hollow towards its partner."""
    return _jaw(1.0)


def jaw2() -> tuple[Mesh, ...]:
    """The jaw on the -z side, the mirror image of jaw1."""
    return _jaw(-1.0)


def _jaw(side: float) -> tuple[Mesh, ...]:
    x = np.array([0.014, 0.025, 0.04, 0.055, 0.07, 0.085, 0.097, 0.106])
    outer = np.array([0.006, 0.007, 0.007, 0.005, 0.001, -0.008, -0.020, -0.031])
    inner = np.array([-0.006, -0.007, -0.006, -0.006, -0.010, -0.020, -0.029, -0.035])
    wide = np.array([0.034, 0.037, 0.040, 0.043, 0.046, 0.046, 0.044, 0.040])
    rings = [
        [(x[k], -wide[k], inner[k]), (x[k], wide[k], inner[k]),
         (x[k], wide[k], outer[k]), (x[k], -wide[k], outer[k])]
        for k in range(len(x))
    ]  # fmt: skip
    scoop = loft(np.array(rings))
    teeth = [
        rounded_box((0.088, y - 0.006, -0.035), (0.104, y + 0.006, -0.018), radius=0.002, n=1)
        for y in (-0.030, -0.010, 0.010, 0.030)
    ]
    ribs = [rounded_box((0.016, y, -0.020), (0.066, y + 0.006, -0.002), radius=0.002, n=1)
            for y in (-0.030, 0.024)]  # fmt: skip
    parts = [scoop, *teeth, *ribs]
    whole = fitted(parts, (0.014, -0.046, -0.035), (0.106, 0.046, 0.007))
    whole = [part.scaled(1.0, 1.0, side) for part in whole]
    return _metal(whole[:1], whole[1:], [])

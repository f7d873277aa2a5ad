"""The CSIP ARM5E, link by link: ``robot/ARM5E/ARM5E_part*``.

Each link is in its own mesh frame, as in UWSim's robot file, with the joint of its parent at the
origin (part0 and part1: the slew axis is z; part2: the shoulder, part3: the elbow, both along y;
part4_base: 28 mm behind the wrist, along x; jaws: their hinges along y). At the next link there is
a lug, a fork or a flange, so that the arm has no gaps in any posture.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from uwsim.assets.mesh import Mesh
from uwsim.base.geometry import Triple
from uwsim.base.numerics.linear import length

from ..shapes import Shape, box, cylinder, join, loft, mesh, ring, rounded_box
from ..textures import worn_paint

BLACK, SILVER, BRASS = (0.15, 0.155, 0.165), (0.66, 0.68, 0.70), (0.85, 0.45, 0.10)

ELBOW_IN_PART2 = (0.4315, 0.0, -0.0994)
"""The elbow's axis in the upper arm's mesh frame [m]."""
WRIST_HEIGHT = 0.083
"""The wrist's axis runs along x at this height in the forearm's mesh frame [m]."""
HINGE_IN_PART4 = (0.073, 0.0, 0.04)
"""A jaw's hinge in part4_base's mesh frame (the other has z reversed) [m]."""


def fit_parts(parts: list[Shape], lower: Triple, upper: Triple) -> list[Shape]:
    """Stretch the parts so that their common box is exactly this one."""
    points = join(*parts).corners.reshape(-1, 3)
    low, high = points.min(axis=0), points.max(axis=0)
    scale = (np.array(upper) - np.array(lower)) / (high - low)
    shift = np.array(lower) - low * scale
    return [part.scale(*scale.tolist()).shift(*shift.tolist()) for part in parts]


def _metal(silver: list[Shape], black: list[Shape], brass: list[Shape]) -> tuple[Mesh, ...]:
    metal = worn_paint("arm5e/metal", (0.92, 0.92, 0.92), size=128)
    return tuple(
        mesh(*(part.project_uv(0.25) for part in parts), colour=colour, texture=metal)
        for parts, colour in ((silver, SILVER), (black, BLACK), (brass, BRASS))
        if parts
    )


def _link(
    silver: list[Shape], black: list[Shape], brass: list[Shape], lower: Triple, upper: Triple
) -> tuple[Mesh, ...]:
    """Fit parts in three materials together into the link's box."""
    parts = fit_parts([*silver, *black, *brass], lower, upper)
    b, d = len(silver), len(silver) + len(black)
    return _metal(parts[:b], parts[b:d], parts[d:])


def _ram(start: Triple, end: Triple, radius: float, rod: float) -> tuple[Shape, Shape]:
    """Return the body of an electric linear actuator, and its rod of ``rod`` metres."""
    a, b = np.array(start), np.array(end)
    split = b - rod * (b - a) / length(b - a)
    x, y, z = split.tolist()
    body = cylinder(start, (x, y, z), radius, n=10, bevel=radius * 0.25)
    return body, cylinder((x, y, z), end, radius * 0.4, n=6)


def _block(lower: Triple, upper: Triple, radius: float) -> Shape:
    return rounded_box(lower, upper, radius=radius, n=1)


def _pin(x: float, z: float, half: float, radius: float, *, n: int = 8) -> Shape:
    """Return a rod along y through (x, z), from ``-half`` to ``half``."""
    return cylinder((x, -half, z), (x, half, z), radius, n=n)


def _plate(a: tuple[float, float], b: tuple[float, float], r: float, y0: float, y1: float) -> Shape:
    """Return a flat bar with round ends in the x-z plane from ``a`` to ``b``, between two y."""
    start, end = np.array(a), np.array(b)
    angle = math.atan2(end[1] - start[1], end[0] - start[0])
    half = np.linspace(0.0, math.pi, 5)
    end_arc, start_arc = angle + math.pi / 2 + half, angle - math.pi / 2 + half
    outline = np.concatenate(
        [
            start + r * np.stack([np.cos(end_arc), np.sin(end_arc)], axis=1),
            end + r * np.stack([np.cos(start_arc), np.sin(start_arc)], axis=1),
        ]
    )
    x, z = outline[:, 0], outline[:, 1]
    return loft(np.array([np.stack([x, np.full_like(x, y), z], axis=1) for y in (y1, y0)]))


def part0() -> tuple[Mesh, ...]:
    """The base: a beam under the hull, the slew bearing, and the slew actuator beside it."""
    beam = _block((-0.336, -0.024, 0.008), (0.0, 0.024, 0.061), 0.006)
    feet = [
        box((-0.33, -0.029, 0.045), (-0.24, 0.06, 0.058)),
        box((-0.10, -0.029, 0.045), (-0.02, 0.06, 0.058)),
    ]
    bearing = cylinder((0.0, 0.0, -0.054), (0.0, 0.0, 0.061), 0.0295, n=14)
    body, rod = _ram((-0.32, 0.062, 0.028), (-0.005, 0.062, 0.028), 0.028, 0.12)
    lug = cylinder((-0.02, 0.055, 0.028), (0.006, 0.055, 0.028), 0.014, n=8)
    box_of_part0 = (-0.336, -0.029, -0.054), (0.031, 0.090, 0.061)
    return _link([beam, rod, lug], [bearing, body, *feet], [], *box_of_part0)


def part1() -> tuple[Mesh, ...]:
    """The slew body: a sleeve round the bearing, and the fork that holds the shoulder."""
    sleeve = ring(0.034, 0.0297, -0.05, 0.03, n=14)
    cap = cylinder((0.0, 0.0, -0.095), (0.0, 0.0, -0.048), 0.034, n=14)
    ear = box((-0.016, 0.026, 0.014), (0.02, 0.047, 0.044))
    neck = _block((-0.02, -0.034, -0.120), (0.050, 0.034, -0.062), 0.012)
    cheeks = [_plate((0.02, -0.10), (0.0805, -0.13), 0.022, y, y + 0.014) for y in (-0.040, 0.026)]
    horn = _block((0.02, -0.02, -0.085), (0.161, 0.02, -0.058), 0.008)
    return _link(
        [*cheeks, sleeve],
        [cap, neck, ear, horn],
        [_pin(0.0805, -0.13, 0.043, 0.010)],
        (-0.034, -0.043, -0.152),
        (0.161, 0.047, 0.044),
    )


def part2() -> tuple[Mesh, ...]:
    """The upper arm: two plates from shoulder to elbow, an actuator on each side."""
    elbow_x, _, elbow_z = ELBOW_IN_PART2
    elbow = (elbow_x, elbow_z)
    plates = [_plate((0.0, 0.0), elbow, 0.022, y, y + 0.009) for y in (-0.024, 0.015)]
    near, near_rod = _ram((-0.060, -0.060, -0.004), (0.330, -0.060, -0.062), 0.028, 0.14)
    far, far_rod = _ram((0.552, 0.066, -0.094), (0.060, 0.066, -0.020), 0.027, 0.16)
    motor = cylinder((-0.078, -0.060, -0.002), (-0.020, -0.060, -0.010), 0.0285, n=12)
    yokes = [
        cylinder((0.320, -0.066, -0.060), (0.320, 0.02, -0.060), 0.010, n=6),
        cylinder((0.065, -0.02, -0.021), (0.065, 0.072, -0.021), 0.010, n=6),
        cylinder((0.400, -0.02, -0.076), (0.400, 0.06, -0.076), 0.012, n=6),
        _block((0.12, -0.045, -0.045), (0.17, 0.0, -0.018), 0.006),
    ]
    hubs = [_pin(0.0, 0.0, 0.026, 0.014, n=8), _pin(*elbow, 0.036, 0.018, n=10)]
    return _link(
        [*plates, near_rod, far_rod, *hubs],
        [near, far, motor],
        yokes,
        (-0.078, -0.088, -0.122),
        (0.559, 0.094, 0.022),
    )


def part3() -> tuple[Mesh, ...]:
    """The forearm: elbow lug, the wrist's motor housing along x, the jaw's actuator above it."""
    w = WRIST_HEIGHT
    lug = _pin(0.0, 0.0, 0.013, 0.022, n=14)
    webs = [_plate((0.0, 0.0), (0.13, w), 0.022, y, y + 0.010) for y in (-0.014, 0.004)]
    housing = cylinder((0.045, 0.0, w), (0.30, 0.0, w), 0.050, n=16, bevel=0.008)
    collars = [
        cylinder((0.085, 0.0, w), (0.107, 0.0, w), 0.058, n=16),
        cylinder((0.298, 0.0, w), (0.320, 0.0, w), 0.0645, n=16),
    ]
    saddle = box((0.09, -0.02, w + 0.04), (0.24, 0.02, 0.19))
    body, rod = _ram((-0.015, 0.0, 0.185), (0.295, 0.0, 0.185), 0.042, 0.06)
    bracket = box((0.275, -0.015, w + 0.05), (0.305, 0.015, 0.205))
    return _link(
        [lug, *webs, *collars, rod, bracket],
        [housing, body],
        [saddle],
        (-0.022, -0.065, -0.022),
        (0.320, 0.064, 0.227),
    )


def part4_base() -> tuple[Mesh, ...]:
    """The wrist's flange and the two pairs of prongs that carry the jaws."""
    hinge_x, _, hinge_z = HINGE_IN_PART4
    flange = cylinder((0.0, 0.0, 0.0), (0.018, 0.0, 0.0), 0.050, n=16)
    body = _block((0.012, -0.040, -0.034), (0.060, 0.040, 0.034), 0.010)
    nose = cylinder((0.055, 0.0, 0.0), (0.085, 0.0, 0.0), 0.018, n=10)
    prongs, pins = [], []
    for low, high in ((-0.052, -0.022), (0.022, 0.052)):
        prongs += [box((0.03, y, low), (0.105, y + 0.008, high)) for y in (-0.050, 0.042)]
    pins = [_pin(hinge_x, side * hinge_z, 0.055, 0.008) for side in (-1.0, 1.0)]
    box_of_part4 = (0.0, -0.055, -0.052), (0.105, 0.055, 0.052)
    return _link([flange, *prongs], [body, nose], pins, *box_of_part4)


def jaw1() -> tuple[Mesh, ...]:
    """The jaw on the +z side: a curved scoop, hollow towards its partner."""
    return _jaw(1.0)


def jaw2() -> tuple[Mesh, ...]:
    """The jaw on the -z side, the mirror image of jaw1."""
    return _jaw(-1.0)


def _jaw(side: float) -> tuple[Mesh, ...]:
    x = np.array([0.014, 0.025, 0.045, 0.065, 0.080, 0.094, 0.106])
    outer_z = np.array([0.006, 0.007, 0.007, 0.003, -0.005, -0.017, -0.031])
    inner_z = np.array([-0.006, -0.007, -0.005, -0.008, -0.017, -0.027, -0.035])
    half_width = np.array([0.034, 0.037, 0.041, 0.046, 0.046, 0.044, 0.040])
    rings = np.stack(
        [
            np.stack([x, -half_width, inner_z], axis=1),
            np.stack([x, half_width, inner_z], axis=1),
            np.stack([x, half_width, outer_z], axis=1),
            np.stack([x, -half_width, outer_z], axis=1),
        ],
        axis=1,
    )
    teeth = [
        box((0.088, y - 0.006, -0.035), (0.104, y + 0.006, -0.018))
        for y in (-0.030, -0.010, 0.010, 0.030)
    ]
    ribs = [box((0.016, y, -0.020), (0.066, y + 0.006, -0.002)) for y in (-0.030, 0.024)]
    parts = fit_parts([loft(rings), *teeth, *ribs], (0.014, -0.046, -0.035), (0.106, 0.046, 0.007))
    parts = [part.scale(1.0, 1.0, side) for part in parts]
    return _metal(parts[:1], parts[1:], [])


def part4() -> tuple[Mesh, ...]:
    """Return the wrist and the closed jaws in one piece, as in an older robot file."""
    hinge_x, _, hinge_z = HINGE_IN_PART4
    jaws = [
        _shift_mesh(piece, hinge_x, side * hinge_z)
        for side, pieces in ((1.0, jaw1()), (-1.0, jaw2()))
        for piece in pieces
    ]
    return (*part4_base(), *jaws)


def _shift_mesh(piece: Mesh, x: float, z: float) -> Mesh:
    return replace(piece, vertices=piece.vertices + np.array([x, 0.0, z], dtype=np.float32))


def jaw1_long() -> tuple[Mesh, ...]:
    """The long jaw on the +z side."""
    return _lengthen_jaws(jaw1())


def jaw2_long() -> tuple[Mesh, ...]:
    """The long jaw on the -z side."""
    return _lengthen_jaws(jaw2())


def _lengthen_jaws(pieces: tuple[Mesh, ...]) -> tuple[Mesh, ...]:
    """Lengthen jaws by half, with their normals."""
    long_pieces = []
    for piece in pieces:
        normals = piece.normals * np.array([1.0 / 1.5, 1.0, 1.0], dtype=np.float32)
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        vertices = piece.vertices * np.array([1.5, 1.0, 1.0], dtype=np.float32)
        long_pieces.append(replace(piece, vertices=vertices, normals=normals))
    return tuple(long_pieces)

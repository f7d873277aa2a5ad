"""Pipes on the sea floor: ``objects/pipe_flanged``, 3 m along y, and ``objects/pipe_elbow``.

Both have an outer diameter of 0.5 m; the faces of flanges meet at multiples of 1.5 m from the
origin, so that pieces join. The axis is at z = 0.
"""

from __future__ import annotations

import math

import numpy as np

from uwsim.base import rng
from uwsim.base.geometry import Array, rotation_from_rpy

from ..cached import cache_image
from ..fields import noise3
from ..parts import Part
from ..shapes import Shape, cylinder, lathe, ring, rotation_to, surface
from ..surfaces import Material
from .growth import scatter_growth
from .steel import Coat, weathered_steel

RADIUS, BORE, FLANGE = 0.25, 0.225, 0.36
"""The radii of the pipe outside and inside, and of its flanges [m]."""
HALF_LENGTH, THICKNESS = 1.5, 0.055
"""The half length of a piece, and the thickness of a flange [m]."""
BOLTS = 12
TILE = 1.5
"""The side of an image of steel [m]."""


def pipe() -> tuple[Part, ...]:
    """Return a straight piece with growth on its upper side."""
    line = np.stack([np.zeros(25), np.linspace(-HALF_LENGTH, HALF_LENGTH, 25), np.zeros(25)], 1)
    ends = [(-1.0, np.array([0.0, 1.0, 0.0])), (1.0, np.array([0.0, -1.0, 0.0]))]
    faces = [(np.array([0.0, side * HALF_LENGTH, 0.0]), axis) for side, axis in ends]
    return _make_piece("pipe", line, faces)


def elbow() -> tuple[Part, ...]:
    """Return a bend from the face at y = -1.5 m to the one at x = 1.5 m."""
    angles = np.linspace(0.0, math.pi / 2.0, 17)
    straight = 0.45
    radius = HALF_LENGTH - straight
    arc = [(radius * (1 - math.cos(a)), radius * (math.sin(a) - 1), 0.0) for a in angles.tolist()]
    line = np.array([(0.0, -HALF_LENGTH, 0.0), *arc, (HALF_LENGTH, 0.0, 0.0)])
    faces = [
        (line[0], np.array([0.0, 1.0, 0.0])),
        (line[-1], np.array([-1.0, 0.0, 0.0])),
    ]
    return _make_piece("elbow", line, faces)


def _make_piece(name: str, line: Array, faces: list[tuple[Array, Array]]) -> tuple[Part, ...]:
    shell = _sweep(line)
    shapes = [shell]
    for place, axis in faces:
        turn = rotation_to(axis)
        shapes += [part.rotate(turn).shift(*place.tolist()) for part in _flange()]
    steel = _steel()
    body = steel.cover(*shapes, crease=0.9, two_sided=True)
    stream = rng.stream(0, f"assets/pipes/{name}/places")
    shell_points = shell.corners.reshape(-1, 3)
    upper = np.flatnonzero(shell_points[:, 2] > 0.02)
    chosen_points = shell_points[stream.choice(upper, 8, replace=False)]
    indices = np.argmin(((chosen_points[:, None] - line[None]) ** 2).sum(axis=2), axis=1)
    normals = chosen_points - line[indices]
    normals /= np.sqrt((normals * normals).sum(axis=1, keepdims=True))
    return body, *scatter_growth(f"pipes/{name}", chosen_points, normals, size=(0.05, 0.16))


def _sweep(line: Array) -> Shape:
    """Return the outside of a level pipe along a line, thicker by growth on its upper side."""
    n = 24
    angles = np.linspace(0.0, 2.0 * math.pi, n + 1)
    steps = np.gradient(line, axis=0)
    steps /= np.sqrt((steps * steps).sum(axis=1, keepdims=True))
    side = np.stack([steps[:, 1], -steps[:, 0], np.zeros(len(line))], axis=1)
    up = np.array([0.0, 0.0, 1.0])
    normals = side[:, None] * np.cos(angles)[:, None] + up * np.sin(angles)[:, None]
    points = line[:, None] + RADIUS * normals
    lumps = noise3("pipes/lumps", points.astype(np.float32), 0.25, octaves=4).astype(np.float64)
    crust = np.clip(0.35 + 0.65 * normals[..., 2], 0.0, 1.0) * np.clip(lumps + 0.4, 0.0, 2.0)
    points = points + normals * (0.018 * crust)[..., None]
    lengths = np.sqrt((np.diff(line, axis=0) ** 2).sum(axis=1))
    distance = np.concatenate([[0.0], np.cumsum(lengths)]) / TILE
    girth = angles / (2.0 * math.pi) * 2.0 * math.pi * RADIUS / TILE
    u, v = np.meshgrid(distance, girth, indexing="ij")
    return surface(points, np.stack([u, v], axis=2))


def _flange() -> list[Shape]:
    """Return a flange with its face at z = 0, the pipe towards +z, bolts and the bore."""
    profile = [(BORE, 0.0), (FLANGE - 0.008, 0.0), (FLANGE, 0.008), (FLANGE, THICKNESS - 0.008),
               (FLANGE - 0.008, THICKNESS), (RADIUS + 0.05, THICKNESS), (RADIUS + 0.012, 0.14),
               (RADIUS, 0.17)]  # fmt: skip
    shapes = [lathe(profile, n=28).scale_uv(1.5, 0.3)]
    shapes.append(ring(BORE, BORE - 0.001, 0.0, 0.5, n=24).scale_uv(1.0, 0.4))
    for k in range(BOLTS):
        angle = 2.0 * math.pi * (k + 0.5) / BOLTS
        x, y = 0.315 * math.cos(angle), 0.315 * math.sin(angle)
        nut = cylinder((0, 0, THICKNESS), (0, 0, THICKNESS + 0.028), 0.026, n=6)
        stud = cylinder((0, 0, THICKNESS), (0, 0, THICKNESS + 0.05), 0.014, n=6)
        spin = rotation_from_rpy(0.0, 0.0, 0.7 * k)
        shapes += [part.rotate(spin).shift(x, y).project_uv(TILE) for part in (nut, stud)]
    return shapes


@cache_image
def _steel() -> Material:
    coat = Coat(paint=(0.30, 0.29, 0.13), paint_share=0.55, growth=0.5, silt=0.4, streaks=0.3)
    return weathered_steel("pipes", coat, size=384, metres=TILE)

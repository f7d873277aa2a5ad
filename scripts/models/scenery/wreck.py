"""A coaster of 26 m that sank decades ago: ``objects/wreck``; bow at +x, the sea floor at z = 0.

She lists to port and lies 0.7 m in the sand. Vehicles of up to 1.5 m can enter the hold by the
hatch or by the torn opening on the starboard side, and see the frames from inside.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from uwsim.base import rng
from uwsim.base.geometry import Array, rotation_from_rpy

from ..parts import Part
from .growth import scatter_growth
from .steel import Coat, weathered_steel
from .wreck_fittings import make_cargo, make_deckhouse, make_gear, make_masts, make_rails
from .wreck_hull import (
    N_STATIONS,
    hull_point,
    is_torn,
    make_decks,
    make_frames,
    make_hold,
    make_plates,
)

LIST, TRIM, KEEL_DEPTH = -0.16, 0.03, 0.7
"""The list and trim [rad], and the depth of the keel in the sand [m]."""
N_CLUMPS = 48
"""The number of clumps of growth."""

SIDE = Coat(paint=(0.17, 0.18, 0.19), paint_share=0.45, growth=0.52, silt=0.25, streaks=0.8)
BOTTOM = Coat(paint=(0.33, 0.13, 0.10), paint_share=0.5, growth=0.55, silt=0.2, streaks=0.4)
DECK = Coat(paint=(0.30, 0.25, 0.20), paint_share=0.25, growth=0.42, silt=0.75, streaks=0.1)
HOUSE = Coat(paint=(0.44, 0.43, 0.39), paint_share=0.6, growth=0.42, silt=0.2, streaks=1.0)
INTERIOR = Coat(paint=(0.28, 0.27, 0.25), paint_share=0.15, growth=0.2, silt=0.35, streaks=0.6)


def wreck() -> tuple[Part, ...]:
    """Return the wreck."""
    sides, bottom = make_plates()
    interior = weathered_steel("inside", INTERIOR, size=384)
    house = weathered_steel("house", HOUSE)
    gear = [shape for shape in (*make_gear(), *make_rails(), *make_masts())]
    parts = [
        weathered_steel("side", SIDE).cover(*sides, crease=0.6, two_sided=True),
        weathered_steel("bottom", BOTTOM, size=384).cover(*bottom, crease=0.6, two_sided=True),
        weathered_steel("deck", DECK).cover(*make_decks(), two_sided=True),
        house.cover(*make_deckhouse(), crease=0.5, two_sided=True),
        interior.cover(*make_frames(), *make_hold(), two_sided=True),
        interior.cover(*gear, *make_cargo(), two_sided=True),
        *scatter_growth("wreck", *_growth_places(), size=(0.08, 0.34)),
    ]
    rotation = rotation_from_rpy(LIST, TRIM, 0.0)
    return tuple(_place(part, rotation, -KEEL_DEPTH) for part in parts)


def _growth_places() -> tuple[Array, Array]:
    """Return places on the shell and tangent the deck's edge, and the normals there."""
    stream = rng.stream(0, "assets/wreck/places")
    points: list[Array] = []
    normals: list[Array] = []
    while len(points) < N_CLUMPS:
        s = float(stream.uniform(0.04, 0.97))
        side = 1.0 if float(stream.random()) < 0.5 else -1.0
        t = 1.0 if float(stream.random()) < 0.45 else float(stream.uniform(0.45, 0.98))
        if is_torn(s, t, side):
            continue
        place = np.array(hull_point(s, t, side))
        tangent = np.array(hull_point(s + 0.5 / N_STATIONS, t, side)) - place
        upward = np.array(hull_point(s, max(0.0, t - 0.02), side)) - place
        normal = np.cross(tangent, upward) * side
        normal = normal / np.sqrt((normal * normal).sum()) + np.array([0.0, 0.0, 0.6 * (t == 1.0)])
        points.append(place)
        normals.append(normal / np.sqrt((normal * normal).sum()))
    return np.array(points), np.array(normals)


def _place(part: Part, rotation: Array, z: float) -> Part:
    """Return a part rotated about the origin, and placed_mesh tangent z."""
    mesh = part.mesh
    vertices, normals = (
        np.einsum("ij,kj->ik", array.astype(np.float64), rotation)
        for array in (mesh.vertices, mesh.normals)
    )
    vertices[:, 2] += z
    placed_mesh = replace(
        mesh, vertices=vertices.astype(np.float32), normals=normals.astype(np.float32)
    )
    return replace(part, mesh=placed_mesh)

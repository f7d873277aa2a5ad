"""Markers that a program has spawned, as lines that the page draws over its view.

Cubes, spheres, cylinders and arrows are outlines; lists of points and of shapes a cross at each;
what is a mesh or a text is known by the name beside it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from ...geometry import Array, Pose
from ...messages import Marker

MAX_POINTS = 2000
"""Of all markers together; lines beyond are left out."""
CROSS = 0.1
"""Size of a cross [m]."""
CIRCLE = [(math.cos(turn), math.sin(turn)) for turn in np.linspace(0.0, 2.0 * math.pi, 17).tolist()]
SQUARE = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)]
Line = list[tuple[float, float, float]]


def described(markers: Mapping[str, Marker], world_from_localized: Pose) -> list[dict[str, Any]]:
    """Return name, colour and lines in W of each marker, as `uwsim.viewer.head` says."""
    found: list[dict[str, Any]] = []
    left = MAX_POINTS
    for name, marker in markers.items():
        pose = world_from_localized @ _pose(marker)
        lines = [pose.transform(np.array(line)) for line in _lines(marker) if line]
        kept: list[list[list[float]]] = []
        for line in lines:
            left -= len(line)
            if left < 0:
                break
            kept.append(np.round(line, 4).tolist())
        where = np.round(pose.position, 4).tolist()
        found.append({"name": name, "at": where, "colour": _colour(marker), "lines": kept})
    return found


def _pose(marker: Marker) -> Pose:
    place, turn = marker.pose.position, marker.pose.orientation
    quaternion = np.array([turn.w, turn.x, turn.y, turn.z])
    return Pose.from_quaternion(np.array([place.x, place.y, place.z]), quaternion)


def _colour(marker: Marker) -> str:
    """As ``#rrggbb``; white where none is given."""
    rgb = [marker.color.r, marker.color.g, marker.color.b]
    if marker.color.a <= 0.0 or not all(map(math.isfinite, rgb)):
        return "#ffffff"
    return "#" + "".join(f"{round(255 * min(1.0, max(0.0, value))):02x}" for value in rgb)


def _lines(marker: Marker) -> list[Line]:
    """Lines in the frame of a marker [m]."""
    half = 0.5 * np.array([marker.scale.x, marker.scale.y, marker.scale.z])
    if not np.isfinite(half).all():
        return []
    points = [(each.x, each.y, each.z) for each in marker.points[:MAX_POINTS]]
    points = [point for point in points if all(map(math.isfinite, point))]
    kind = marker.type
    if kind in (Marker.CUBE, Marker.CYLINDER):
        return _scaled(_prism(SQUARE if kind == Marker.CUBE else CIRCLE), half)
    if kind == Marker.SPHERE:
        circles = [[(a, b, 0.0) for a, b in CIRCLE], [(a, 0.0, b) for a, b in CIRCLE]]
        return _scaled([*circles, [(0.0, a, b) for a, b in CIRCLE]], half)
    if kind == Marker.ARROW:
        ends = (
            points[:2] if len(points) > 1 else [(0.0, 0.0, 0.0), (2.0 * float(half[0]), 0.0, 0.0)]
        )
        return [ends]
    if kind == Marker.LINE_STRIP:
        return [points]
    if kind == Marker.LINE_LIST:
        return [points[k : k + 2] for k in range(0, len(points) - 1, 2)]
    if kind == Marker.TRIANGLE_LIST:
        return [[*points[k : k + 3], points[k]] for k in range(0, len(points) - 2, 3)]
    return [line for point in points or [(0.0, 0.0, 0.0)] for line in _cross(point)]


def _prism(base: list[tuple[float, float]]) -> list[Line]:
    ends: list[Line] = [[(a, b, z) for a, b in base] for z in (-1.0, 1.0)]
    return ends + [
        [(*corner, -1.0), (*corner, 1.0)] for corner in base[: -1 : max(1, len(base) // 4)]
    ]


def _cross(point: tuple[float, float, float]) -> Iterable[Line]:
    for axis in np.eye(3) * (0.5 * CROSS):
        yield [tuple((np.array(point) + sign * axis).tolist()) for sign in (-1.0, 1.0)]


def _scaled(lines: list[Line], half: Array) -> list[Line]:
    return [[tuple((np.array(point) * half).tolist()) for point in line] for line in lines]

"""Spawned markers as lines that viewers draw over their images.

Cubes, spheres, cylinders and arrows are outlines; lists of points and of shapes a cross at each;
what is a mesh or a text is a dot with its name.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from ...base.external_values import MAX_COORDINATE, read_pose
from ...base.geometry import Array, Pose
from ...messages import Marker
from ...results.motion import DrawnMarker

MAX_POINTS = 2000
"""Of all markers together; lines beyond are left out."""
CROSS = 0.1
"""Size of a cross [m]."""
CIRCLE = [(math.cos(turn), math.sin(turn)) for turn in np.linspace(0.0, 2.0 * math.pi, 17).tolist()]
SQUARE = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)]
NAMED = (Marker.MESH_RESOURCE, Marker.TEXT_VIEW_FACING)
"""Types of which viewers show a dot with the name."""
Line = list[tuple[float, float, float]]


def look_of(marker: Marker, world_from_localized: Pose, room: int = MAX_POINTS) -> DrawnMarker:
    """Return how a marker is drawn.

    Args:
        marker: the one, its pose in L.
        world_from_localized: where L is.
        room: points that its lines may have; lines beyond are left out.
    """
    kept = []
    for line in filter(None, _lines(marker)):
        room -= len(line)
        if room < 0:
            break
        kept.append(tuple(tuple(round(value, 4) for value in point) for point in line))
    pose = world_from_localized @ localized_from_marker(marker)
    row = (*np.round(pose.position, 4).tolist(), *np.round(pose.quaternion, 5).tolist())
    return DrawnMarker(colour=_colour(marker), pose=row, lines=tuple(kept))


def n_points(look: DrawnMarker) -> int:
    """Return how many points the lines of a marker have."""
    return sum(map(len, look.lines))


def looks_of(markers: Mapping[str, Marker], world_from_localized: Pose) -> dict[str, DrawnMarker]:
    """Return how markers are drawn, `MAX_POINTS` of all together."""
    looks, room = {}, MAX_POINTS
    for name, marker in markers.items():
        looks[name] = look_of(marker, world_from_localized, room)
        room -= n_points(looks[name])
    return looks


def described(looks: Mapping[str, DrawnMarker]) -> list[dict[str, Any]]:
    """Return name, colour and lines in W of each marker, as `uwsim.viewer.head` says."""
    found: list[dict[str, Any]] = []
    for name, look in looks.items():
        pose = Pose.from_quaternion(np.array(look.pose[:3]), np.array(look.pose[3:]))
        lines = [np.round(pose.transform(np.array(line)), 4).tolist() for line in look.lines]
        found.append(
            {"name": name, "at": list(look.pose[:3]), "colour": look.colour, "lines": lines}
        )
    return found


def localized_from_marker(marker: Marker) -> Pose:
    """Return the pose of a marker in L, whose message was checked when it was spawned."""
    pose = read_pose(marker.pose)
    assert pose is not None
    return pose


def _colour(marker: Marker) -> str:
    """As ``#rrggbb``; white where none is given."""
    rgb = [marker.color.r, marker.color.g, marker.color.b]
    if marker.color.a <= 0.0 or not all(map(math.isfinite, rgb)):
        return "#ffffff"
    return "#" + "".join(f"{round(255 * min(1.0, max(0.0, value))):02x}" for value in rgb)


def _lines(marker: Marker) -> list[Line]:
    """Lines in the frame of a marker [m]."""
    half = 0.5 * np.array([marker.scale.x, marker.scale.y, marker.scale.z])
    if not (np.abs(half) <= MAX_COORDINATE).all() or marker.type in NAMED:
        return []
    points = [(each.x, each.y, each.z) for each in marker.points[:MAX_POINTS]]
    points = [point for point in points if all(abs(value) <= MAX_COORDINATE for value in point)]
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

"""Drawings of markers as lines, which viewers draw over their images.

Cubes, spheres, cylinders and arrows are drawn as outlines, lists of points or shapes as a cross at
each point, meshes and texts as a dot with the name of the marker.
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
"""The maximum number of points of all markers together; lines beyond it are left out."""
CROSS_SIZE = 0.1
"""The size of a cross [m]."""
CIRCLE = [(math.cos(turn), math.sin(turn)) for turn in np.linspace(0.0, 2.0 * math.pi, 17).tolist()]
SQUARE = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)]
"""The closed outline of a base with the half width 1."""
NAMED_TYPES = (Marker.MESH_RESOURCE, Marker.TEXT_VIEW_FACING)
"""The types of markers that viewers show as a dot with the name."""
Line = list[tuple[float, float, float]]


def draw_marker(
    marker: Marker, world_from_localized: Pose, max_points: int = MAX_POINTS
) -> DrawnMarker:
    """Return the drawing of a marker as lines.

    Args:
        marker: the marker, with its pose in L.
        world_from_localized: the pose of L in W.
        max_points: the maximum number of points; lines beyond it are left out.
    """
    lines = []
    for line in filter(None, _lines(marker)):
        max_points -= len(line)
        if max_points < 0:
            break
        lines.append(tuple(tuple(round(value, 4) for value in point) for point in line))
    pose = world_from_localized @ localized_from_marker(marker)
    row = (*np.round(pose.position, 4).tolist(), *np.round(pose.quaternion, 5).tolist())
    return DrawnMarker(colour=_format_colour(marker), pose=row, lines=tuple(lines))


def count_points(drawing: DrawnMarker) -> int:
    """Return the number of points of the lines of a marker."""
    return sum(map(len, drawing.lines))


def draw_markers(
    markers: Mapping[str, Marker], world_from_localized: Pose
) -> dict[str, DrawnMarker]:
    """Return the drawings of markers by name, with at most `MAX_POINTS` points together."""
    drawings, n_left = {}, MAX_POINTS
    for name, marker in markers.items():
        drawings[name] = draw_marker(marker, world_from_localized, n_left)
        n_left -= count_points(drawings[name])
    return drawings


def describe_markers(drawings: Mapping[str, DrawnMarker]) -> list[dict[str, Any]]:
    """Return the name, the colour and the lines in W of each marker, as in `uwsim.viewer.head`."""
    descriptions: list[dict[str, Any]] = []
    for name, drawing in drawings.items():
        pose = Pose.from_quaternion(np.array(drawing.pose[:3]), np.array(drawing.pose[3:]))
        lines = [np.round(pose.transform(np.array(line)), 4).tolist() for line in drawing.lines]
        descriptions.append(
            {"name": name, "at": list(drawing.pose[:3]), "colour": drawing.colour, "lines": lines}
        )
    return descriptions


def localized_from_marker(marker: Marker) -> Pose:
    """Return the pose of a marker in L; its message was checked when the marker was added."""
    pose = read_pose(marker.pose)
    assert pose is not None
    return pose


def _format_colour(marker: Marker) -> str:
    """Return the colour as ``#rrggbb``; white if it is transparent or invalid."""
    rgb = [marker.color.r, marker.color.g, marker.color.b]
    if marker.color.a <= 0.0 or not all(map(math.isfinite, rgb)):
        return "#ffffff"
    return "#" + "".join(f"{round(255 * min(1.0, max(0.0, value))):02x}" for value in rgb)


def _lines(marker: Marker) -> list[Line]:
    """Return the lines in the frame of a marker [m]."""
    half = 0.5 * np.array([marker.scale.x, marker.scale.y, marker.scale.z])
    if not (np.abs(half) <= MAX_COORDINATE).all() or marker.type in NAMED_TYPES:
        return []
    points = [
        (marker_point.x, marker_point.y, marker_point.z)
        for marker_point in marker.points[:MAX_POINTS]
    ]
    points = [point for point in points if all(abs(value) <= MAX_COORDINATE for value in point)]
    kind = marker.type
    if kind in (Marker.CUBE, Marker.CYLINDER):
        return _scale_lines(_prism(SQUARE if kind == Marker.CUBE else CIRCLE), half)
    if kind == Marker.SPHERE:
        circles = [[(a, b, 0.0) for a, b in CIRCLE], [(a, 0.0, b) for a, b in CIRCLE]]
        return _scale_lines([*circles, [(0.0, a, b) for a, b in CIRCLE]], half)
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
    for axis in np.eye(3) * (0.5 * CROSS_SIZE):
        yield [tuple((np.array(point) + sign * axis).tolist()) for sign in (-1.0, 1.0)]


def _scale_lines(lines: list[Line], half: Array) -> list[Line]:
    return [[tuple((np.array(point) * half).tolist()) for point in line] for line in lines]

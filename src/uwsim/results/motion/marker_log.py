"""The markers that programs added during a trial, as a part of its motion track.

They are in the head of the track, ``"markers":{"shapes":[...],"changes":[...]}``. A shape is a list
of polylines in the marker's frame, ``[[[x,y,z],...],...]`` [m]. A change is ``[frame, name, index
of a shape, "#rrggbb", [x,y,z,w,x,y,z]]``, which ends with the pose in the world frame W, or
``[frame, name]`` if the marker is removed.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

COLOUR = re.compile(r"#[0-9a-f]{6}")
Point = tuple[float, ...]
"""The coordinates x, y, z of a point in the marker's frame [m]."""
Line = tuple[Point, ...]
"""The points of a polyline."""


@dataclass(frozen=True, kw_only=True)
class DrawnMarker:
    """A marker as viewers draw it."""

    colour: str
    """The colour as ``#rrggbb``."""
    pose: tuple[float, ...]
    """The position in the world frame W [m], and the quaternion wxyz, (7,)."""
    lines: tuple[Line, ...]
    """The polylines in the marker's frame; without polylines a viewer shows the marker's name."""


@dataclass(frozen=True, kw_only=True)
class MarkerChange:
    """The appearance, change or removal of a marker."""

    frame: int
    """The index of the first frame with the change."""
    name: str
    """The name of the marker."""
    marker: DrawnMarker | None
    """The marker as it is drawn from this frame on; None if it is removed."""


def markers_at(changes: Sequence[MarkerChange], frame: int) -> dict[str, DrawnMarker]:
    """Return the markers in a frame, by name, in the order in which they were added."""
    markers: dict[str, DrawnMarker] = {}
    for change in changes:
        if change.frame > frame:
            break
        if change.marker is None:
            markers.pop(change.name, None)
        else:
            markers[change.name] = change.marker
    return markers


def as_json(changes: Sequence[MarkerChange]) -> dict[str, Any]:
    """Return the value of ``markers`` in the head of a track."""
    shapes: dict[tuple[Line, ...], int] = {}
    rows: list[list[Any]] = []
    for change in changes:
        row: list[Any] = [change.frame, change.name]
        if (marker := change.marker) is not None:
            row += [shapes.setdefault(marker.lines, len(shapes)), marker.colour, list(marker.pose)]
        rows.append(row)
    return {"shapes": list(shapes), "changes": rows}


def from_json(head: dict[str, Any]) -> tuple[MarkerChange, ...]:
    """Read the value of `as_json`; raise ValueError, KeyError or TypeError if it is invalid."""
    shapes = [tuple(tuple(map(_point, line)) for line in shape) for shape in head["shapes"]]
    return tuple(_change(shapes, *row) for row in head["changes"])


def _change(shapes: Sequence[tuple[Line, ...]], frame: int, name: str, *rest: Any) -> MarkerChange:
    marker = None
    if rest:
        shape, colour, pose = rest
        if not 0 <= shape < len(shapes) or len(pose) != 7 or not COLOUR.fullmatch(colour):
            raise ValueError(f"the marker {name!r} is invalid")
        marker = DrawnMarker(colour=colour, pose=_finite_numbers(pose), lines=shapes[shape])
    return MarkerChange(frame=int(frame), name=str(name), marker=marker)


def _point(point: Sequence[float]) -> Point:
    if len(point) != 3:
        raise ValueError(f"a point of a marker has {len(point)} coordinates")
    return _finite_numbers(point)


def _finite_numbers(values: Sequence[float]) -> tuple[float, ...]:
    numbers = tuple(map(float, values))
    if not all(map(math.isfinite, numbers)):
        raise ValueError("a number of a marker is not finite")
    return numbers

"""The markers that programs spawned during a trial, as a part of its motion track.

In the head of the track ``"markers":{"shapes":[...],"changes":[...]}``: a shape is a list of lines
in the marker's frame, ``[[[x,y,z],...],...]`` [m]; a change is ``[frame, name, number of a shape,
"#rrggbb", [x,y,z,w,x,y,z]]``, the pose in W, or ``[frame, name]`` where a marker is gone.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

COLOUR = re.compile(r"#[0-9a-f]{6}")
Point = tuple[float, ...]
Line = tuple[Point, ...]


@dataclass(frozen=True, kw_only=True)
class MarkerLook:
    """A marker as viewers draw it."""

    colour: str
    """As ``#rrggbb``."""
    pose: tuple[float, ...]
    """Position in W [m] and quaternion wxyz, (7,)."""
    lines: tuple[Line, ...]
    """In its own frame [m]; none: its name is shown."""


@dataclass(frozen=True, kw_only=True)
class MarkerChange:
    """A marker came, became another, or is gone."""

    frame: int
    """From which on."""
    name: str
    """Of the marker."""
    look: MarkerLook | None
    """None: it is gone."""


def markers_at(changes: Sequence[MarkerChange], frame: int) -> dict[str, MarkerLook]:
    """Return name -> look of the markers that are there in a frame, as they came."""
    shown: dict[str, MarkerLook] = {}
    for change in changes:
        if change.frame > frame:
            break
        if change.look is None:
            shown.pop(change.name, None)
        else:
            shown[change.name] = change.look
    return shown


def as_json(changes: Sequence[MarkerChange]) -> dict[str, Any]:
    """Return what stands in the head of a track."""
    shapes: dict[tuple[Line, ...], int] = {}
    rows: list[list[Any]] = []
    for change in changes:
        row: list[Any] = [change.frame, change.name]
        if (look := change.look) is not None:
            row += [shapes.setdefault(look.lines, len(shapes)), look.colour, list(look.pose)]
        rows.append(row)
    return {"shapes": list(shapes), "changes": rows}


def from_json(head: dict[str, Any]) -> tuple[MarkerChange, ...]:
    """Read what `as_json` gave; raises ValueError, KeyError or TypeError where it is none."""
    shapes = [tuple(tuple(map(_point, line)) for line in shape) for shape in head["shapes"]]
    return tuple(_change(shapes, *row) for row in head["changes"])


def _change(shapes: Sequence[tuple[Line, ...]], frame: int, name: str, *rest: Any) -> MarkerChange:
    look = None
    if rest:
        shape, colour, pose = rest
        if not 0 <= shape < len(shapes) or len(pose) != 7 or not COLOUR.fullmatch(colour):
            raise ValueError(f"the look of the marker {name!r} is none")
        look = MarkerLook(colour=colour, pose=_finite(pose), lines=shapes[shape])
    return MarkerChange(frame=int(frame), name=str(name), look=look)


def _point(point: Sequence[float]) -> Point:
    if len(point) != 3:
        raise ValueError(f"a point of a marker has {len(point)} coordinates")
    return _finite(point)


def _finite(values: Sequence[float]) -> tuple[float, ...]:
    numbers = tuple(map(float, values))
    if not all(map(math.isfinite, numbers)):
        raise ValueError("a number of a marker is not finite")
    return numbers

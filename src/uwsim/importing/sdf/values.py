"""Reading of names, numbers and poses in SDF elements."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from lxml import etree

from ...base.geometry import Pose, Triple, rotation_from_quaternion, rotation_from_rpy
from ...schema import MAX_DISTANCE, Diagnostics, parse_number, quote
from ..report import ImportReport, Place
from .spec import FramedPose

MAX_VALUE = 1e17
"""The greatest number; SDF has 1e16 for an infinite limit."""
MAX_WORDS = 100
"""The greatest number of numbers in one element."""


@dataclass(frozen=True, eq=False)
class Source:
    """A file that is read: its name, its errors, and the report of its elements."""

    file: str
    """The name of the file in messages."""
    diagnostics: Diagnostics
    """The errors of the file."""
    report: ImportReport
    """The report."""
    version: tuple[int, int] = (1, 12)
    """The version of SDF."""

    def place(self, node: etree._Element) -> Place:
        """Return the place of an element."""
        return Place(file=self.file, line=line_number(node))

    def leave_out(self, node: etree._Element, label: str, reason: str) -> None:
        """Report an element that is not imported."""
        self.report.add("left out", label, self.place(node), reason)


def line_number(node: etree._Element) -> int:
    """Return the line of an element from 1; 0 if it is unknown."""
    line = node.sourceline
    return line if isinstance(line, int) else 0


def tag_of(node: etree._Element) -> str:
    """Return the name of an element without its prefix; "" for a comment."""
    if not isinstance(node.tag, str):
        return ""
    return node.tag.rpartition("}")[2].rpartition(":")[2]


def attribute_of(node: etree._Element, name: str) -> str:
    """Return an attribute without regard to its prefix, trimmed; "" if there is none."""
    for key, value in node.attrib.items():
        if str(key).rpartition("}")[2].rpartition(":")[2] == name:
            return str(value).strip()
    return ""


def child_of(node: etree._Element | None, *path: str) -> etree._Element | None:
    """Return the first element at a path of names; None if there is none."""
    for name in path:
        if node is None:
            return None
        node = next((child for child in node if tag_of(child) == name), None)
    return node


def children_of(node: etree._Element, name: str) -> list[etree._Element]:
    """Return all child elements of a name."""
    return [child for child in node if tag_of(child) == name]


def text_of(node: etree._Element | None, *path: str) -> str:
    """Return the trimmed text of the element at a path; "" if there is none."""
    child = child_of(node, *path)
    return "" if child is None else (child.text or "").strip()


def numbers_in(node: etree._Element, count: int, source: Source) -> tuple[float, ...] | None:
    """Return the numbers of an element; report an error and return None if not ``count``."""
    text = (node.text or "").strip()
    words = text.split() if len(text) < 4000 else []
    values = [_number(word) for word in words[:MAX_WORDS]]
    if len(words) == len(values) == count and None not in values:
        return tuple(value for value in values if value is not None)
    expected = "a number" if count == 1 else f"{count} numbers"
    source.diagnostics.error(node, f"<{tag_of(node)}> is {quote(text)}; expected {expected}")
    return None


def _number(word: str) -> float | None:
    if word.lower().lstrip("+-") in ("inf", "infinity"):
        return math.copysign(1e16, -1.0 if word.startswith("-") else 1.0)
    value = None if word.startswith(("M_", "-M_")) else parse_number(word)
    return None if value is None or not abs(value) <= MAX_VALUE else value


def number_of(node: etree._Element | None, default: float, source: Source, *path: str) -> float:
    """Return the number at a path; the default if there is none."""
    child = child_of(node, *path)
    values = None if child is None else numbers_in(child, 1, source)
    return default if values is None else values[0]


def positive_of(node: etree._Element | None, default: float, source: Source, *path: str) -> float:
    """Return a number above 0 at a path; report another one."""
    value = number_of(node, default, source, *path)
    if value > 0.0 and value <= MAX_DISTANCE:
        return value
    child = child_of(node, *path)
    source.diagnostics.error(
        child, f"<{path[-1]}> is {value:g}; expected a number above 0 and up to {MAX_DISTANCE:g}"
    )
    return default


def triple_of(node: etree._Element | None, default: Triple, source: Source, *path: str) -> Triple:
    """Return three numbers at a path; the default if there are none."""
    child = child_of(node, *path)
    values = None if child is None else numbers_in(child, 3, source)
    return default if values is None else (values[0], values[1], values[2])


def flag_of(node: etree._Element | None, default: bool, *path: str) -> bool:
    """Return a flag (true, 1) at a path; the default if there is none."""
    text = text_of(node, *path).lower()
    return default if not text else text in ("true", "1")


def pose_of(node: etree._Element, source: Source) -> FramedPose:
    """Return the ``<pose>`` of an element; the identity without one.

    Six numbers are x y z [m] and fixed-axis roll, pitch, yaw [rad]; with ``degrees`` angles are in
    degrees, with ``rotation_format="quat_xyzw"`` the last four numbers are a quaternion.
    """
    child = child_of(node, "pose")
    if child is None:
        return FramedPose()
    relative_to = attribute_of(child, "relative_to") or attribute_of(child, "frame")
    line = line_number(child)
    if not (child.text or "").strip():
        return FramedPose(relative_to=relative_to, line=line)
    is_quaternion = attribute_of(child, "rotation_format") == "quat_xyzw"
    values = numbers_in(child, 7 if is_quaternion else 6, source)
    if values is None:
        return FramedPose(relative_to=relative_to, line=line)
    if not max(map(abs, values[:3])) <= MAX_DISTANCE:
        source.diagnostics.error(
            child, f"<pose> is {quote(child.text or '')}; expected up to {MAX_DISTANCE:g} m"
        )
    if is_quaternion:
        x, y, z, w = values[3:]
        if not any((x, y, z, w)):
            source.diagnostics.error(child, "the quaternion of <pose> is 0 0 0 0")
            w = 1.0
        rotation = rotation_from_quaternion(np.array([w, x, y, z]))
    else:
        roll, pitch, yaw = values[3:]
        if attribute_of(child, "degrees").lower() in ("true", "1"):
            roll, pitch, yaw = math.radians(roll), math.radians(pitch), math.radians(yaw)
        rotation = rotation_from_rpy(roll, pitch, yaw)
    pose = Pose(np.array(values[:3]), rotation)
    return FramedPose(pose=pose, relative_to=relative_to, line=line)

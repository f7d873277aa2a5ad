"""Warnings about elements that are read but not simulated yet."""

from __future__ import annotations

from collections.abc import Iterator

from lxml import etree

from ...errors import Diagnostic
from ...scene.unsupported import (
    DEPTH_ELEMENT,
    DISABLED_TEXTS,
    LIMIT_ELEMENTS,
    OCEAN_ELEMENTS,
    ORIGINAL_PHYSICS_ELEMENTS,
    READ_ONLY,
    READ_WITHOUT_WAVES,
    UNSIMULATED_ELEMENTS,
)
from ...schema import NAMESPACE
from ..subjects import CheckedScene


def not_simulated(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of every kind of element that is read but not simulated yet, with its lines."""
    if scene.document is not None:
        for line, message in unsimulated_elements(scene.document.root):
            yield scene.warning(line, message)


def unsimulated_elements(root: etree._Element) -> Iterator[tuple[int, str]]:
    """Yield a line and a message for each kind of element that is read but not simulated yet."""
    lines: dict[str, list[int]] = {}
    is_dynamic = root.find(f"vehicle/{{{NAMESPACE}}}dynamics") is not None
    physics_text = (root.findtext("simParams/enablePhysics") or "").strip()
    has_original_physics = physics_text == "1" and not is_dynamic
    has_physics = is_dynamic or has_original_physics
    waves = f"oceanState/{{{NAMESPACE}}}waves"
    has_waves = root.find(waves) is not None
    has_ocean = root.find(f"{waves}/{{{NAMESPACE}}}uwsimOcean") is not None
    for node in root.iter("*"):
        parent = node.getparent()
        if parent is None:
            continue
        tags = (str(parent.tag), str(node.tag))
        kind = UNSIMULATED_ELEMENTS.get(tags)
        if (
            (tags in ORIGINAL_PHYSICS_ELEMENTS and has_original_physics)
            or (has_waves and tags == DEPTH_ELEMENT)
            or (has_ocean and tags in OCEAN_ELEMENTS)
        ):
            kind = None
        elif tags == DEPTH_ELEMENT:
            kind = "depth"
        elif has_physics and parent.tag == "physics" and node.tag in LIMIT_ELEMENTS:
            kind = "limits of objects"
        if kind is not None and DISABLED_TEXTS.get(str(node.tag)) != (node.text or "").strip():
            lines.setdefault(kind, []).append(_line(node))
    for kind, kind_lines in sorted(lines.items(), key=lambda entry: entry[1][0]):
        sorted_lines = sorted(set(kind_lines))
        is_long = len(sorted_lines) > 8
        line_list = ", ".join(map(str, sorted_lines[:8])) + (", ..." if is_long else "")
        noun = "line" if len(sorted_lines) == 1 else "lines"
        limitation = READ_WITHOUT_WAVES if kind == DEPTH_ELEMENT[1] else READ_ONLY
        yield sorted_lines[0], f"{limitation}: {kind} ({noun} {line_list})"


def _line(node: etree._Element) -> int:
    return int(str(node.sourceline or 0))

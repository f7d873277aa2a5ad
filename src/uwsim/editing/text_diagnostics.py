"""Diagnostics about a written text, with the path of an element instead of a line."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from lxml import etree

from ..errors import Diagnostic

CONTAINERS = frozenset({"measures", "rosInterfaces", "sceneUpdater"})
"""The elements that paths of elements do not contain."""


def locate_diagnostics(
    diagnostics: Iterable[Diagnostic], text: str, written_file: str, name: str
) -> tuple[Diagnostic, ...]:
    """Return diagnostics with the path of an element instead of a line.

    Args:
        diagnostics: the diagnostics about the text.
        text: the text of the written file.
        written_file: the path of the written file, which messages may contain.
        name: the name of the scene or benchmark for messages.
    """
    labels = _labels_by_line(text)
    entries = []
    for diagnostic in diagnostics:
        message = diagnostic.message.replace(written_file, name)
        for folder in Path(written_file).parents:  # in lists of the folders searched
            message = message.replace(f" {folder}, ", " ")
        if diagnostic.file != written_file:
            entries.append(replace(diagnostic, message=message))
            continue
        line = diagnostic.line
        label = "" if line is None else labels.get(line, "")
        message = f"{label}: {message}" if label else message
        entries.append(replace(diagnostic, file=name, line=None, message=message))
    return tuple(entries)


def _labels_by_line(text: str) -> dict[int, str]:
    """Return the path of the outermost element that begins in each line."""
    labels: dict[int, str] = {}
    _add_labels(etree.fromstring(text.encode()), "", labels)
    return labels


def _add_labels(node: etree._Element, label: str, labels: dict[int, str]) -> None:
    labels.setdefault(int(str(node.sourceline)), label)
    for child in node.iterchildren("*"):
        tag = str(child.tag).rpartition("}")[2]
        name = (child.findtext("name") or "").strip() if node.tag != "rosInterfaces" else ""
        if len(child) == 0 or tag in CONTAINERS:
            child_label = label
        else:
            child_label = f"{label}/{name or tag}" if label else name or tag
        _add_labels(child, child_label, labels)

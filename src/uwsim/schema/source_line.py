"""The line from which a spec was read, for errors that are detected later."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from lxml import etree


@dataclass(frozen=True)
class SourceLine:
    """The line of a file in which an element begins."""

    file: str
    """The name of the file."""
    line: int
    """The number of the line, from 1."""
    elements: Mapping[str, int] = field(default_factory=dict)
    """The line of the first child element of each name, by qualified name."""


@dataclass(frozen=True, kw_only=True)
class Spec:
    """The base class of specs; comparisons ignore its line, ``dataclasses.replace`` keeps it."""

    source_line: SourceLine | None = field(
        default=None, compare=False, repr=False, metadata={"not_in_file": True}
    )
    """The line from which the spec was read; None if a program made it."""


def line_of(spec: object, element: str = "") -> int | None:
    """Return the line of the first ``element`` in a spec, else of the spec; None if unknown."""
    source = spec.source_line if isinstance(spec, Spec) else None
    return None if source is None else source.elements.get(element, source.line)


def source_line(node: etree._Element, file: str) -> SourceLine | None:
    """Return the lines of an element and of its children; None if a program made the element."""
    if node.sourceline is None:
        return None
    elements: dict[str, int] = {}
    for child in node.iterchildren("*"):
        elements.setdefault(str(child.tag), int(str(child.sourceline)))
    return SourceLine(file, int(str(node.sourceline)), elements)

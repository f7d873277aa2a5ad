"""Where a spec was read: what errors that are found later say."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from lxml import etree


@dataclass(frozen=True)
class SourceLine:
    """The line of a file that an element begins in."""

    file: str
    """The file."""
    line: int
    """Line of the element, from 1."""
    elements: Mapping[str, int] = field(default_factory=dict)
    """Lines of the first element of each qualified name in it."""


@dataclass(frozen=True, kw_only=True)
class Spec:
    """Base of what is read from an element; `replace` keeps its line, comparisons ignore it."""

    source_line: SourceLine | None = field(
        default=None, compare=False, repr=False, metadata={"not_in_file": True}
    )
    """Where it was read; None for one that a program made."""


def line_of(spec: object, element: str = "") -> int | None:
    """Line of the first ``element`` in a spec, else of the spec; None if it has none."""
    source = spec.source_line if isinstance(spec, Spec) else None
    return None if source is None else source.elements.get(element, source.line)


def source_line(node: etree._Element, file: str) -> SourceLine | None:
    """Return the line of an element of a file, with those in it; None of one made by a program."""
    if node.sourceline is None:
        return None
    elements: dict[str, int] = {}
    for child in node.iterchildren("*"):
        elements.setdefault(str(child.tag), int(str(child.sourceline)))
    return SourceLine(file, int(str(node.sourceline)), elements)

"""Reading specs from XML elements."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from dataclasses import MISSING
from typing import Any, TypeVar

from lxml import etree

from .diagnostics import Diagnostics
from .grammar import Field, fields_of
from .names import advice, cut, local, shown, shown_attribute
from .source_line import Spec, source_line
from .values import BAD, BLANKS, Bad, scalar

T = TypeVar("T")
OF_WINDOW = "it concerns the original's window alone; the default counts"
"""Why an error in an element of the window is a warning."""


def read(
    cls: type[T],
    node: etree._Element,
    diagnostics: Diagnostics,
    *,
    given: Mapping[str, object] | None = None,
) -> T | None:
    """Fill a spec from an element; every error goes into ``diagnostics``.

    Args:
        cls: a dataclass.
        node: the element.
        diagnostics: receives the errors.
        given: fields that the caller has read already; their elements are skipped.

    Returns:
        The spec, with defaults where optional values were invalid; None when it cannot be made.
    """
    table = fields_of(cls)
    values: dict[str, Any] = dict(given or {})
    found = _children(cls, node, diagnostics)
    _read_attributes(table, node, values, diagnostics)
    for field in table:
        if field.name in (given or {}) or field.xml.attribute:
            continue
        value = _read_field(field, node, found.get(field.tag, []), diagnostics)
        if field.is_member:
            read_one = () if value is BAD else value if field.repeated else (value,)
            values[field.name] = (*values.get(field.name, ()), *read_one)
        elif value is not BAD:
            values[field.name] = value
    for field in table:
        if field.name not in values:
            if field.default is MISSING:
                return None
            values[field.name] = field.default
    if issubclass(cls, Spec) and "source_line" not in values:
        values["source_line"] = source_line(node, diagnostics.file)
    return cls(**values)


def read_choice(
    table: Mapping[str, type[T]],
    node: etree._Element,
    diagnostics: Diagnostics,
    *,
    read_one: Callable[[type[T], etree._Element, Diagnostics], T | None] = read,
) -> tuple[T, ...]:
    """Read the children of an element, each by the spec that the table has under its name."""
    read_specs = []
    order = {tag: index for index, tag in enumerate(table)}
    last: tuple[int, str] = (-1, "")
    _refuse_text(node, diagnostics)
    for attribute in node.attrib:
        _unknown_attribute(node, str(attribute), (), diagnostics)
    for child in _elements(node, diagnostics):
        tag = str(child.tag)
        if tag not in table:
            _unknown_element(child, node, table, diagnostics)
            continue
        if not tag.startswith("{"):  # the original has no extensions
            if diagnostics.strict and order[tag] < last[0]:
                _misplaced(child, last[1], diagnostics)
            last = max(last, (order[tag], tag))
        if (spec := read_one(table[tag], child, diagnostics)) is not None:
            read_specs.append(spec)
    return tuple(read_specs)


def text_of(node: etree._Element, diagnostics: Diagnostics) -> str:
    """The text of a leaf, trimmed; where comments split it, the last piece that is not empty."""
    pieces = [(piece or "").strip(BLANKS) for piece in (node.text, *(each.tail for each in node))]
    read = [piece for piece in pieces if piece] or [""]
    if len(read) > 1:
        diagnostics.warning(
            node,
            f"a comment splits the text of {shown(node)}; its last piece is read, "
            f"{read[-1]!r:.60}, as the original does",
        )
    for child in _elements(node, diagnostics):
        diagnostics.error(child, f"{shown(child)} inside {shown(node)}, where only text is allowed")
    return read[-1]


@functools.cache
def _by_tag(
    cls: Hashable,
) -> tuple[dict[str, tuple[int, Field]], dict[str, tuple[int, Field]]]:
    """Position and field of every element of a spec by its name, and by its old names."""
    assert isinstance(cls, type)
    table = fields_of(cls)
    new = {
        field.tag: (index, field) for index, field in enumerate(table) if not field.xml.attribute
    }
    old = {alias: entry for entry in new.values() for alias in entry[1].xml.original.aliases}
    return new, old


def _children(
    cls: type, node: etree._Element, diagnostics: Diagnostics
) -> dict[str, list[etree._Element]]:
    """The child elements by field; unknown, repeated and misplaced ones are errors."""
    if any(field.xml.text for field in fields_of(cls)):
        return {}
    by_tag, old = _by_tag(cls)
    found: dict[str, list[etree._Element]] = {}
    last: tuple[int, str] = (-1, "")
    _refuse_text(node, diagnostics)
    for child in _elements(node, diagnostics):
        tag = str(child.tag)
        entry = by_tag.get(tag) or old.get(tag)
        if entry is None:
            _unknown_element(child, node, by_tag, diagnostics)
            continue
        index, field = entry
        if tag not in by_tag and not tag.startswith("{"):  # one of ours stays valid
            diagnostics.warning(child, f"{shown(child)} is an old name of <{field.shown}>")
        if diagnostics.strict and index < last[0] and not field.xml.namespaced:
            _misplaced(child, last[1], diagnostics)
        if not field.xml.namespaced:
            last = max(last, (index, field.shown))
        here = found.setdefault(field.tag, [])
        if here and not (field.repeated and field.kind != "choice" and _repeats(field)):
            diagnostics.error(
                child,
                f"{shown(child)} is given twice in {shown(node)} (first in line "
                f"{here[0].sourceline}); only one may",
            )
            continue
        here.append(child)
    return found


def _repeats(field: Field) -> bool:
    """Whether the element itself is repeated, not only the items in it."""
    return field.kind == "list" or field.xml.item is None


def _read_attributes(
    table: tuple[Field, ...], node: etree._Element, values: dict[str, Any], diagnostics: Diagnostics
) -> None:
    known = {field.tag: field for field in table if field.xml.attribute}
    for name in node.attrib:
        if name not in known:
            _unknown_attribute(node, str(name), known, diagnostics)
    for field in known.values():
        text = node.get(field.tag)
        if field.name in values:
            continue
        if text is None:
            if field.default is MISSING:
                diagnostics.error(node, f"{shown(node)} lacks the attribute {field.shown}")
            continue
        value = scalar(
            field, text.strip(BLANKS), node, diagnostics, f"{field.shown}= of {shown(node)}"
        )
        if value is not BAD:
            values[field.name] = value


def _read_field(
    field: Field, parent: etree._Element, nodes: list[etree._Element], diagnostics: Diagnostics
) -> Any:
    """Read a field that is not an attribute; BAD when it is absent or invalid."""
    if field.xml.original.of_window and nodes:
        with diagnostics.excused(OF_WINDOW):
            return _read_present_field(field, parent, nodes, diagnostics)
    return _read_present_field(field, parent, nodes, diagnostics)


def _read_present_field(
    field: Field, parent: etree._Element, nodes: list[etree._Element], diagnostics: Diagnostics
) -> Any:
    if field.xml.text:
        return _leaf(field, parent, diagnostics)
    if not nodes:
        if (
            field.default is MISSING
            and field.repeated
            and field.kind != "manual"
            and _repeats(field)
        ):
            diagnostics.error(
                parent, f"{shown(parent)} lacks <{field.shown}>: at least one is required"
            )
        elif field.default is MISSING or (diagnostics.strict and field.xml.original.required):
            diagnostics.error(parent, f"{shown(parent)} lacks <{field.shown}>: {_purpose(field)}")
        return BAD
    if field.kind == "choice":
        return read_choice(field.type, nodes[0], diagnostics)
    if field.repeated and field.kind == "list":
        return tuple(_read_list(field, node, diagnostics) for node in nodes)
    if field.repeated and field.xml.item:
        return _read_list(field, nodes[0], diagnostics)
    if field.repeated:
        many = [_read_one(field, node, diagnostics) for node in nodes]
        return tuple(value for value in many if value is not BAD)
    return _read_one(field, nodes[0], diagnostics)


def _read_one(field: Field, node: etree._Element, diagnostics: Diagnostics) -> Any:
    if field.kind == "spec":
        spec = read(field.type, node, diagnostics)
        return BAD if spec is None else spec
    for name in node.attrib:
        _unknown_attribute(node, str(name), (), diagnostics)
    if field.kind == "triple":
        return _read_triple(field, node, diagnostics)
    return _leaf(field, node, diagnostics)


def _leaf(field: Field, node: etree._Element, diagnostics: Diagnostics) -> Any:
    text = text_of(node, diagnostics)
    if not text:
        # An empty element keeps its default in the original, which has no extensions.
        if field.default is MISSING or field.xml.namespaced:
            diagnostics.error(node, f"{shown(node)} is empty; expected {field.expected}")
        return BAD
    return scalar(field, text, node, diagnostics, shown(node))


def _read_triple(field: Field, node: etree._Element, diagnostics: Diagnostics) -> Any:
    values: dict[str, float] = {}
    seen: set[str] = set()
    if field.words and not any(True for _ in _elements(node, diagnostics)):
        return _leaf(dataclasses.replace(field, kind="word", type=field.words), node, diagnostics)
    _refuse_text(node, diagnostics)
    for child in _elements(node, diagnostics):
        tag = str(child.tag)
        if tag not in tuple(field.xml.parts):
            _unknown_element(child, node, tuple(field.xml.parts), diagnostics)
        elif tag in seen:
            diagnostics.error(child, f"<{tag}> is given twice in {shown(node)}; only one may")
        else:
            seen.add(tag)
            text = text_of(child, diagnostics)
            named = f"<{tag}> of {shown(node)}"
            value = scalar(field, text, child, diagnostics, named) if text else 0.0
            if not isinstance(value, Bad):
                values[tag] = value
    if lacking := [f"<{part}>" for part in field.xml.parts if part not in seen]:
        diagnostics.error(node, f"{shown(node)} lacks {', '.join(lacking)}")
    if len(values) < len(field.xml.parts):
        return BAD
    return tuple(values[part] for part in field.xml.parts)


def _read_list(field: Field, node: etree._Element, diagnostics: Diagnostics) -> tuple[Any, ...]:
    values = []
    assert field.xml.item is not None
    _refuse_text(node, diagnostics)
    kind, type_ = ("float", float) if field.kind == "list" else (field.kind, field.type)
    entry = dataclasses.replace(field, kind=kind, type=type_, default=MISSING)
    for child in _elements(node, diagnostics):
        if child.tag != field.xml.item:
            _unknown_element(child, node, (field.xml.item,), diagnostics)
        elif (value := _read_one(entry, child, diagnostics)) is not BAD:
            values.append(value)
    return tuple(values)


def _elements(node: etree._Element, diagnostics: Diagnostics) -> Iterator[etree._Element]:
    """The child elements; comments and instructions are skipped, entities are errors."""
    for child in node:
        if isinstance(child.tag, str):
            yield child
        elif isinstance(child, etree._Entity):
            diagnostics.error(
                node, f"{cut(child.text or '')} in {shown(node)}: entities are not read"
            )


def _refuse_text(node: etree._Element, diagnostics: Diagnostics) -> None:
    for piece in (node.text, *(child.tail for child in node)):
        if stray := (piece or "").strip(BLANKS):
            diagnostics.error(node, f"stray text {cut(stray)} in {shown(node)}")
            return


def _unknown_element(
    child: etree._Element, parent: etree._Element, known: Iterable[str], diagnostics: Diagnostics
) -> None:
    names = [local(name) for name in known]
    diagnostics.unknown(
        child,
        f"{shown(child)} is not an element of {shown(parent)}{advice(str(child.tag))}",
        local(str(child.tag)),
        names,
    )  # fmt: skip


def _unknown_attribute(
    node: etree._Element, name: str, known: Iterable[str], diagnostics: Diagnostics
) -> None:
    names = [local(each) for each in known]
    message = shown_attribute(name)
    diagnostics.unknown(node, f"{message} is not an attribute of {shown(node)}", local(name), names)


def _misplaced(child: etree._Element, after: str, diagnostics: Diagnostics) -> None:
    diagnostics.error(
        child, f"{shown(child)} comes after <{after}>; the original expects it before"
    )


def _purpose(field: Field) -> str:
    """The purpose of a missing element: the first sentence of its documentation."""
    message = field.doc.split(". ")[0].replace("\n", " ").replace("``", "`").rstrip(".")
    return message[:1].lower() + message[1:] or field.expected

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
from .names import advice, describe, format_attribute, prefixed_name, quote
from .source_line import Spec, source_line
from .values import BLANKS, NO_VALUE, NoValue, parse_scalar

T = TypeVar("T")
WINDOW_REASON = "it affects the original's window only; the default applies"
"""The reason why an error in an element about the window is only a warning."""


def read(
    cls: type[T],
    node: etree._Element,
    diagnostics: Diagnostics,
    *,
    known_fields: Mapping[str, object] | None = None,
) -> T | None:
    """Read a spec from an element; add every error to ``diagnostics``.

    Args:
        cls: the class of the spec.
        node: the element.
        diagnostics: the object that collects the errors.
        known_fields: the values of fields that the caller has read already, by field name; the
            elements of these fields are skipped.

    Returns:
        The spec, with defaults where optional values were invalid; None when it cannot be made.
    """
    table = fields_of(cls)
    values: dict[str, Any] = dict(known_fields or {})
    children = _children(cls, node, diagnostics)
    _read_attributes(table, node, values, diagnostics)
    for field in table:
        if field.name in (known_fields or {}) or field.xml.attribute:
            continue
        value = _read_field(field, node, children.get(field.tag, []), diagnostics)
        if field.is_member:
            members = () if value is NO_VALUE else value if field.is_repeated else (value,)
            values[field.name] = (*values.get(field.name, ()), *members)
        elif value is not NO_VALUE:
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
    """Read the children of an element with ``read_one``, each as the spec that its name has."""
    read_specs = []
    order = {tag: index for index, tag in enumerate(table)}
    last_entry: tuple[int, str] = (-1, "")
    _refuse_text(node, diagnostics)
    for attribute in node.attrib:
        _report_unknown_attribute(node, str(attribute), (), diagnostics)
    for child in _elements(node, diagnostics):
        tag = str(child.tag)
        if tag not in table:
            _report_unknown_element(child, node, table, diagnostics)
            continue
        if not tag.startswith("{"):  # the original has no extensions
            if diagnostics.is_strict and order[tag] < last_entry[0]:
                _report_misplaced(child, last_entry[1], diagnostics)
            last_entry = max(last_entry, (order[tag], tag))
        if (spec := read_one(table[tag], child, diagnostics)) is not None:
            read_specs.append(spec)
    return tuple(read_specs)


def read_text(node: etree._Element, diagnostics: Diagnostics) -> str:
    """Return the text of an element, trimmed; if comments split it, the last part with text."""
    pieces = [(piece or "").strip(BLANKS) for piece in (node.text, *(part.tail for part in node))]
    nonempty_pieces = [piece for piece in pieces if piece] or [""]
    if len(nonempty_pieces) > 1:
        diagnostics.warning(
            node,
            f"a comment splits the text of {describe(node)}; its last piece is read, "
            f"{nonempty_pieces[-1]!r:.60}, as the original does",
        )
    for child in _elements(node, diagnostics):
        message = f"{describe(child)} inside {describe(node)}, where only text is allowed"
        diagnostics.error(child, message)
    return nonempty_pieces[-1]


@functools.cache
def _tag_entries(
    cls: Hashable,
) -> tuple[dict[str, tuple[int, Field]], dict[str, tuple[int, Field]]]:
    """Return the index and field of each child element, by its name and by its old names."""
    assert isinstance(cls, type)
    table = fields_of(cls)
    entries = {
        field.tag: (index, field) for index, field in enumerate(table) if not field.xml.attribute
    }
    aliases = {name: entry for entry in entries.values() for name in entry[1].xml.original.aliases}
    return entries, aliases


def _children(
    cls: type, node: etree._Element, diagnostics: Diagnostics
) -> dict[str, list[etree._Element]]:
    """Return the child elements by tag; report unknown, repeated and misplaced elements."""
    if any(field.xml.text for field in fields_of(cls)):
        return {}
    entries, old_entries = _tag_entries(cls)
    children: dict[str, list[etree._Element]] = {}
    last_entry: tuple[int, str] = (-1, "")
    _refuse_text(node, diagnostics)
    for child in _elements(node, diagnostics):
        tag = str(child.tag)
        entry = entries.get(tag) or old_entries.get(tag)
        if entry is None:
            _report_unknown_element(child, node, entries, diagnostics)
            continue
        index, field = entry
        if tag not in entries and not tag.startswith("{"):  # old names of extensions stay valid
            diagnostics.warning(child, f"{describe(child)} is an old name of <{field.label}>")
        if diagnostics.is_strict and index < last_entry[0] and not field.xml.namespaced:
            _report_misplaced(child, last_entry[1], diagnostics)
        if not field.xml.namespaced:
            last_entry = max(last_entry, (index, field.label))
        same_children = children.setdefault(field.tag, [])
        if same_children and not (field.is_repeated and field.kind != "choice" and _repeats(field)):
            diagnostics.error(
                child,
                f"{describe(child)} is given twice in {describe(node)} (first in line "
                f"{same_children[0].sourceline}); only one is allowed",
            )
            continue
        same_children.append(child)
    return children


def _repeats(field: Field) -> bool:
    """Return whether the element itself is repeated, not only the items in it."""
    return field.kind == "list" or field.xml.item is None


def _read_attributes(
    table: tuple[Field, ...], node: etree._Element, values: dict[str, Any], diagnostics: Diagnostics
) -> None:
    attributes = {field.tag: field for field in table if field.xml.attribute}
    for name in node.attrib:
        if name not in attributes:
            _report_unknown_attribute(node, str(name), attributes, diagnostics)
    for field in attributes.values():
        text = node.get(field.tag)
        if field.name in values:
            continue
        if text is None:
            if field.default is MISSING:
                diagnostics.error(node, f"{describe(node)} lacks the attribute {field.label}")
            continue
        value = parse_scalar(
            field, text.strip(BLANKS), node, diagnostics, f"{field.label}= of {describe(node)}"
        )
        if value is not NO_VALUE:
            values[field.name] = value


def _read_field(
    field: Field, parent: etree._Element, nodes: list[etree._Element], diagnostics: Diagnostics
) -> Any:
    """Read a field that is not an attribute; NO_VALUE if it is absent or invalid."""
    original = field.xml.original
    is_used = bool(original.used_by) and parent.find(original.used_by) is not None
    if original.is_window_setting and nodes and not is_used:
        with diagnostics.errors_as_warnings(WINDOW_REASON):
            return _read_present_field(field, parent, nodes, diagnostics)
    return _read_present_field(field, parent, nodes, diagnostics)


def _read_present_field(
    field: Field, parent: etree._Element, nodes: list[etree._Element], diagnostics: Diagnostics
) -> Any:
    if field.xml.text:
        return _read_leaf(field, parent, diagnostics)
    if not nodes:
        is_element_repeated = field.is_repeated and field.kind != "manual" and _repeats(field)
        message = f"{describe(parent)} lacks <{field.label}>"
        if field.default is MISSING and is_element_repeated:
            diagnostics.error(parent, f"{message}: at least one is required")
        elif field.default is MISSING or (diagnostics.is_strict and field.xml.original.is_required):
            diagnostics.error(parent, f"{message}: {_purpose(field)}")
        return NO_VALUE
    if field.kind == "choice":
        return read_choice(field.type, nodes[0], diagnostics)
    if field.is_repeated and field.kind == "list":
        return tuple(_read_list(field, node, diagnostics) for node in nodes)
    if field.is_repeated and field.xml.item:
        return _read_list(field, nodes[0], diagnostics)
    if field.is_repeated:
        items = [_read_one(field, node, diagnostics) for node in nodes]
        return tuple(value for value in items if value is not NO_VALUE)
    return _read_one(field, nodes[0], diagnostics)


def _read_one(field: Field, node: etree._Element, diagnostics: Diagnostics) -> Any:
    if field.kind == "spec":
        spec = read(field.type, node, diagnostics)
        return NO_VALUE if spec is None else spec
    for name in node.attrib:
        _report_unknown_attribute(node, str(name), (), diagnostics)
    if field.kind == "triple":
        return _read_triple(field, node, diagnostics)
    return _read_leaf(field, node, diagnostics)


def _read_leaf(field: Field, node: etree._Element, diagnostics: Diagnostics) -> Any:
    text = read_text(node, diagnostics)
    if not text:
        # An empty element keeps its default in the original, which has no extensions.
        if field.default is MISSING or field.xml.namespaced:
            diagnostics.error(node, f"{describe(node)} is empty; expected {field.expected}")
        return NO_VALUE
    return parse_scalar(field, text, node, diagnostics, describe(node))


def _read_triple(field: Field, node: etree._Element, diagnostics: Diagnostics) -> Any:
    values: dict[str, float] = {}
    read_tags: set[str] = set()
    if field.words and not any(True for _ in _elements(node, diagnostics)):
        word_field = dataclasses.replace(field, kind="word", type=field.words)
        return _read_leaf(word_field, node, diagnostics)
    _refuse_text(node, diagnostics)
    for child in _elements(node, diagnostics):
        tag = str(child.tag)
        if tag not in tuple(field.xml.parts):
            _report_unknown_element(child, node, tuple(field.xml.parts), diagnostics)
        elif tag in read_tags:
            diagnostics.error(
                child, f"<{tag}> is given twice in {describe(node)}; only one is allowed"
            )
        else:
            read_tags.add(tag)
            text = read_text(child, diagnostics)
            part_name = f"<{tag}> of {describe(node)}"
            value = parse_scalar(field, text, child, diagnostics, part_name) if text else 0.0
            if not isinstance(value, NoValue):
                values[tag] = value
    if missing_parts := [f"<{part}>" for part in field.xml.parts if part not in read_tags]:
        diagnostics.error(node, f"{describe(node)} lacks {', '.join(missing_parts)}")
    if len(values) < len(field.xml.parts):
        return NO_VALUE
    return tuple(values[part] for part in field.xml.parts)


def _read_list(field: Field, node: etree._Element, diagnostics: Diagnostics) -> tuple[Any, ...]:
    values = []
    assert field.xml.item is not None
    _refuse_text(node, diagnostics)
    kind, type_ = ("float", float) if field.kind == "list" else (field.kind, field.type)
    entry = dataclasses.replace(field, kind=kind, type=type_, default=MISSING)
    for child in _elements(node, diagnostics):
        if child.tag != field.xml.item:
            _report_unknown_element(child, node, (field.xml.item,), diagnostics)
        elif (value := _read_one(entry, child, diagnostics)) is not NO_VALUE:
            values.append(value)
    return tuple(values)


def _elements(node: etree._Element, diagnostics: Diagnostics) -> Iterator[etree._Element]:
    """Yield the child elements; skip comments and instructions, add errors for entities."""
    for child in node:
        if isinstance(child.tag, str):
            yield child
        elif isinstance(child, etree._Entity):
            message = f"{quote(child.text or '')} in {describe(node)}: entities are not read"
            diagnostics.error(node, message)


def _refuse_text(node: etree._Element, diagnostics: Diagnostics) -> None:
    for piece in (node.text, *(child.tail for child in node)):
        if stray := (piece or "").strip(BLANKS):
            diagnostics.error(node, f"stray text {quote(stray)} in {describe(node)}")
            return


def _report_unknown_element(
    child: etree._Element, parent: etree._Element, tags: Iterable[str], diagnostics: Diagnostics
) -> None:
    tag, names = str(child.tag), [prefixed_name(tag) for tag in tags]
    message = f"{describe(child)} is not an element of {describe(parent)}{advice(tag)}"
    diagnostics.report_unknown(child, message, prefixed_name(tag), names)


def _report_unknown_attribute(
    node: etree._Element, name: str, valid_attributes: Iterable[str], diagnostics: Diagnostics
) -> None:
    names = [prefixed_name(attribute) for attribute in valid_attributes]
    message = f"{format_attribute(name)} is not an attribute of {describe(node)}"
    diagnostics.report_unknown(node, message, prefixed_name(name), names)


def _report_misplaced(child: etree._Element, previous_name: str, diagnostics: Diagnostics) -> None:
    diagnostics.error(
        child, f"{describe(child)} comes after <{previous_name}>; the original expects it before"
    )


def _purpose(field: Field) -> str:
    """Return the purpose of a missing element: the first sentence of its documentation."""
    message = field.doc.split(". ")[0].replace("\n", " ").replace("``", "`").rstrip(".")
    return message[:1].lower() + message[1:] or field.expected

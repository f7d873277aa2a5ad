"""Writing of specs as XML elements."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable
from typing import Any

from lxml import etree

from .grammar import Field, fields_of
from .names import NAMESPACE


def write(spec: object, tag: str) -> etree._Element:
    """Write a spec as an element without the fields that equal their default."""
    node = etree.Element(tag, nsmap={"u": NAMESPACE} if uses_extensions(spec) else None)
    fill_element(node, spec)
    return node


def uses_extensions(spec: object) -> bool:
    """Return whether a spec, at any depth, has an extension that differs from its default."""
    if isinstance(spec, tuple):
        return any(uses_extensions(item) for item in spec)
    if not dataclasses.is_dataclass(spec) or isinstance(spec, type):
        return False
    return any(
        (field.xml.namespaced and field.value_in(spec) != field.default)
        or uses_extensions(field.value_in(spec))
        for field in fields_of(type(spec))
    )  # fmt: skip


def fill_element(
    node: etree._Element,
    spec: object,
    write_manual: Callable[[etree._Element, Field, Any], None] | None = None,
) -> None:
    """Write the fields of a spec that differ from their defaults into an element.

    Args:
        node: the element.
        spec: the spec.
        write_manual: the function that writes fields of the kind ``manual``, which the schema
            cannot read or write by itself.
    """
    for field in fields_of(type(spec)):
        value = field.value_in(spec)
        if value is None or (value == field.default and not field.xml.original.is_required):
            continue
        if field.kind == "manual" and write_manual is not None:
            write_manual(node, field, value)
            continue
        write_value(node, field, value)


def write_value(node: etree._Element, field: Field, value: Any) -> None:
    """Write the value of a field, other than None, into the element of its spec."""
    if field.xml.attribute:
        node.set(field.tag, _text(value, attribute=True))
    elif field.xml.text:
        node.text = _text(value)
    elif field.kind == "choice":
        parent = etree.SubElement(node, field.tag)
        names = {cls: name for name, cls in field.type.items()}
        for item in value:
            fill_element(etree.SubElement(parent, names[type(item)]), item)
    elif field.kind == "list":
        for items in value:
            _write_items(etree.SubElement(node, field.tag), field, items)
    elif field.is_repeated and field.xml.item:
        _write_items(etree.SubElement(node, field.tag), field, value)
    else:
        for item in value if field.is_repeated else (value,):
            _write_one(etree.SubElement(node, field.tag), field, item)


def _write_items(node: etree._Element, field: Field, items: Iterable[Any]) -> None:
    assert field.xml.item is not None
    for item in items:
        etree.SubElement(node, field.xml.item).text = _text(item)


def _write_one(node: etree._Element, field: Field, value: Any) -> None:
    if field.kind == "spec":
        fill_element(node, value)
    elif field.kind == "triple" and not isinstance(value, str):
        for part, part_value in zip(field.xml.parts, value, strict=True):
            etree.SubElement(node, part).text = _text(part_value)
    else:
        node.text = _text(value)


def _text(value: Any, *, attribute: bool = False) -> str:
    if isinstance(value, tuple):  # of numbers, or of words
        return " ".join(map(_text, value))
    if isinstance(value, bool):
        return str(value).lower() if attribute else str(int(value))
    return number_text(value) if isinstance(value, float) else str(value)


def number_text(value: float) -> str:
    """Return a number as the shortest text that reads back to it."""
    return repr(float(value)).removesuffix(".0")

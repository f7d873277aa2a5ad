"""Specs to elements."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from typing import Any

from lxml import etree

from .grammar import Slot, slots
from .names import NAMESPACE


def write(spec: object, tag: str) -> etree._Element:
    """Write a spec as an element; what equals its default is left out (``read`` brings it back)."""
    node = etree.Element(tag, nsmap={"u": NAMESPACE} if uses_extensions(spec) else None)
    _fill(node, spec)
    return node


def uses_extensions(spec: object) -> bool:
    """Whether any field of the namespace ``u`` of a spec, at any depth, is not its default."""
    if isinstance(spec, tuple):
        return any(uses_extensions(item) for item in spec)
    if not dataclasses.is_dataclass(spec) or isinstance(spec, type):
        return False
    return any(
        (slot.xml.namespaced and getattr(spec, slot.field) != slot.default)
        or uses_extensions(getattr(spec, slot.field))
        for slot in slots(type(spec))
    )  # fmt: skip


def _fill(node: etree._Element, spec: object) -> None:
    for slot in slots(type(spec)):
        value = getattr(spec, slot.field)
        if value is None or (value == slot.default and not slot.xml.original.required):
            continue
        if slot.xml.attribute:
            node.set(slot.tag, _text(value, attribute=True))
        elif slot.xml.text:
            node.text = _text(value)
        elif slot.kind == "choice":
            box = etree.SubElement(node, slot.tag)
            names = {cls: name for name, cls in slot.type.items()}
            for item in value:
                _fill(etree.SubElement(box, names[type(item)]), item)
        elif slot.kind == "list":
            for items in value:
                _write_items(etree.SubElement(node, slot.tag), slot, items)
        elif slot.repeated and slot.xml.item:
            _write_items(etree.SubElement(node, slot.tag), slot, value)
        else:
            for item in value if slot.repeated else (value,):
                _write_one(etree.SubElement(node, slot.tag), slot, item)


def _write_items(node: etree._Element, slot: Slot, items: Iterable[Any]) -> None:
    assert slot.xml.item is not None
    for item in items:
        etree.SubElement(node, slot.xml.item).text = _text(item)


def _write_one(node: etree._Element, slot: Slot, value: Any) -> None:
    if slot.kind == "spec":
        _fill(node, value)
    elif slot.kind == "triple" and not isinstance(value, str):
        for part, number_ in zip(slot.xml.parts, value, strict=True):
            etree.SubElement(node, part).text = _text(number_)
    else:
        node.text = _text(value)


def _text(value: Any, *, attribute: bool = False) -> str:
    if isinstance(value, bool):
        return str(value).lower() if attribute else str(int(value))
    return repr(value) if isinstance(value, float) else str(value)

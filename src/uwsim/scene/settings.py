"""Settings from the command line: ``--set oceanState.fog.density=0.4`` changes one value of a spec.

A path is element names joined by dots; ``[name]`` chooses among equals, and may be left out where
there is only one: ``vehicle[girona500].virtualCamera[bowtech1].std``. The value is read by the same
rules as in a file. Three numbers are set together (``position=1 2 3``) or one by one
(``position.x=1``), a list as a whole (``jointValues=0 0 2.2 0 0.8``).
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Sequence
from typing import Any, TypeVar, cast

from lxml import etree

from .. import dialect
from ..errors import BadSetting, UnknownName, did_you_mean

T = TypeVar("T")
_PART = re.compile(r"([^\[\].=]+)(?:\[([^\]]*)\])?(?:\.|$)")


def apply_setting(spec: T, path: str, value: str) -> T:
    """Return a copy of ``spec`` in which the value that ``path`` leads to is ``value``.

    Raises:
        BadSetting: a path that leads nowhere or a value that cannot stand there; names what can.
    """
    try:
        return cast(T, _changed(spec, _parts(path), value))
    except BadSetting as error:
        raise BadSetting(f"--set {path}={value}: {error}") from None


def _parts(path: str) -> list[tuple[str, str | None]]:
    """``a.b[c].d`` as [("a", None), ("b", "c"), ("d", None)]."""
    parts: list[tuple[str, str | None]] = []
    at = 0
    while at < len(path) or not parts:
        match = _PART.match(path, at)
        if match is None or (match.end() == len(path) and path.endswith(".")):
            raise BadSetting("not a path; expected names joined by dots, as in a.b[name].c.")
        parts.append((match[1], match[2]))
        at = match.end()
    return parts


def _changed(spec: Any, parts: Sequence[tuple[str, str | None]], value: str) -> Any:
    """Return a copy of a spec in which the value at the end of the path is another."""
    (name, chosen), rest = parts[0], parts[1:]
    slot = _slot(type(spec), name)
    current = getattr(spec, slot.field)
    if slot.kind == "choice" and rest:
        (name, chosen), rest = rest[0], rest[1:]
        if name not in slot.type:
            raise BadSetting(str(UnknownName(f"element of <{slot.shown}>", name, slot.type)))
        kind = slot.type[name]
        index = _index(current, [isinstance(entry, kind) for entry in current], name, chosen)
    elif slot.kind == "spec" and slot.repeated:
        index = _index(current, [True] * len(current), name, chosen)
    elif chosen is not None:
        raise BadSetting(f"<{name}> stands once; leave [{chosen}] out.")
    elif slot.kind == "spec":
        if current is None:
            raise BadSetting(f"the file has no <{name}> here.")
        if not rest:
            raise BadSetting(_inside(name, slot.type))
        return dataclasses.replace(spec, **{slot.field: _changed(current, rest, value)})
    else:
        return _with_value(spec, slot, [name for name, _ in rest], value)
    if not rest:
        raise BadSetting(_inside(name, type(current[index])))
    entry = _changed(current[index], rest, value)
    return dataclasses.replace(
        spec, **{slot.field: (*current[:index], entry, *current[index + 1 :])}
    )


def _slot(cls: type, name: str) -> dialect.Slot:
    slots = {slot.shown.removeprefix("u:"): slot for slot in dialect.slots(cls)}
    slot = slots.get(name.removeprefix("u:"))
    if slot is None:
        raise BadSetting(
            f"there is no <{name}>.{did_you_mean(name, slots)} There are: {', '.join(slots)}."
        )
    return slot


def _inside(name: str, cls: type) -> str:
    names = ", ".join(slot.shown for slot in dialect.slots(cls))
    return f"<{name}> is not a value; what stands in it: {names}."


def _index(entries: Sequence[Any], fits: Sequence[bool], name: str, chosen: str | None) -> int:
    """Find the one entry that ``name[chosen]`` means."""
    found = [index for index, fit in enumerate(fits) if fit]
    names = [str(getattr(entries[index], "name", "")) for index in found]
    if chosen is not None:
        if chosen not in names:
            raise BadSetting(str(UnknownName(f"<{name}>", chosen, names)))
        return found[names.index(chosen)]
    if len(found) != 1:
        said = f"choose one: {', '.join(f'{name}[{each}]' for each in names)}" if found else "none"
        raise BadSetting(f"the file has {len(found)} <{name}>; {said}.")
    return found[0]


def _with_value(spec: Any, slot: dialect.Slot, rest: list[str], text: str) -> Any:
    """Let the dialect read the value as if it stood in a file."""
    node = etree.Element(dialect.camel(type(spec).__name__.removesuffix("Spec")))
    if slot.kind == "triple":
        _write_triple(etree.SubElement(node, slot.tag), getattr(spec, slot.field), slot, rest, text)
    elif rest:
        raise BadSetting(f"<{slot.shown}> is a value; nothing stands in it.")
    elif slot.kind not in ("str", "float", "int", "bool", "word"):
        raise BadSetting(f"<{slot.shown}> cannot be set from here; change the file.")
    elif not text and slot.kind != "str":
        raise BadSetting(f"nothing behind the '='; expected {slot.expected} for <{slot.shown}>.")
    elif slot.xml.attribute:
        node.set(slot.tag, text)
    elif slot.xml.text:
        node.text = text
    elif slot.xml.item is not None:
        listed = etree.SubElement(node, slot.tag)
        for word in text.replace(",", " ").split():
            etree.SubElement(listed, slot.xml.item).text = word
    else:
        etree.SubElement(node, slot.tag).text = text
    faults = dialect.Faults("")
    given = {
        field.name: getattr(spec, field.name)
        for field in dataclasses.fields(spec)
        if field.init and field.name != slot.field
    }
    changed = dialect.read(type(spec), node, faults, given=given)
    if changed is None or faults.all():
        raise BadSetting("; ".join(fault.message for fault in faults.all()) or "no value.")
    return changed


def _write_triple(
    node: etree._Element,
    current: tuple[float, float, float] | None,
    slot: dialect.Slot,
    rest: list[str],
    text: str,
) -> None:
    """Write three numbers, given together or one of them by its letter."""
    letters = list(slot.xml.parts)
    if not rest:
        words = text.replace(",", " ").split()
        if len(words) != len(letters):
            raise BadSetting(f"<{slot.shown}> wants {len(letters)} numbers, as in '1 2 3'.")
    elif len(rest) > 1 or rest[0] not in letters or current is None:
        raise BadSetting(f"<{slot.shown}> has {', '.join(f'<{letter}>' for letter in letters)}.")
    else:
        words = [
            text if letter == rest[0] else repr(number)
            for letter, number in zip(letters, current, strict=True)
        ]
    for letter, word in zip(letters, words, strict=True):
        etree.SubElement(node, letter).text = word

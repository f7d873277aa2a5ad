"""Settings from the command line: ``--set oceanState.fog.density=0.4`` changes one value of a spec.

A path is element names joined by dots; ``[name]`` chooses among equals, and may be left out where
there is only one: ``vehicle[girona500].virtualCamera[bowtech1].std``. What has no name is chosen by
its axis (``sway[x]``), or by its number from 1 (``oceanState.current.gaussMarkov[2]``). The value
is read by the same rules as in a file. Three numbers are set together (``position=1 2 3``) or one
by one (``position.x=1``), a list as a whole (``jointValues=0 0 2.2 0 0.8``) or by its numbers from
1 (``jointValues.3=2.2``).

What is behind ``vehicle[NAME].hydrodynamics`` leads into the hydrodynamics file of a vehicle:
``vehicle[girona500].hydrodynamics.body[base_link].mass``. It is looked up when that file is read.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar, cast

from lxml import etree

from .. import schema
from ..errors import BadSetting, UnknownName, did_you_mean

T = TypeVar("T")
OF_XACRO = "xacro."
"""Beginning of the settings that are xacro arguments, which hold when the file is read."""
HYDRODYNAMICS = "hydrodynamics"
"""What leads from a vehicle into its hydrodynamics file."""
_PART = re.compile(r"([^\[\].=]+)(?:\[([^\]]*)\])?(?:\.|$)")


@dataclass(frozen=True)
class Place:
    """The value that a path refers to."""

    steps: tuple[Step, ...]
    """From the whole down to the spec that has the value."""
    leaf: Any
    """That spec."""
    field: schema.Field
    """The value's field in it."""
    rest: tuple[str, ...]
    """What the path says behind it: a letter of a triple."""

    @property
    def path(self) -> str:
        """The path in full: with every name, without ``u:``."""
        names = [step.name for step in self.steps if step.name]
        return ".".join([*names, self.field.label.removeprefix("u:"), *self.rest])

    @property
    def is_number(self) -> bool:
        """Whether it is one number."""
        is_scalar = self.field.kind in ("float", "int") and not self.field.is_repeated
        return (is_scalar and not self.rest) or (self.has_parts and len(self.rest) == 1)

    @property
    def has_parts(self) -> bool:
        """Whether it is several numbers, of which one can be chosen."""
        return self.field.kind == "triple" or _is_list(self.field)

    @property
    def is_whole(self) -> bool:
        """Whether it is a whole number."""
        return self.field.kind == "int"

    @property
    def kind(self) -> str:
        """What it is, in words."""
        if self.field.kind == "triple":
            return f"three numbers; choose one, .{self.field.xml.parts[0]}"
        words = {"str": "text", "bool": "a flag", "word": "a word"}
        return (
            "a list"
            if _is_list(self.field) or self.field.is_repeated
            else words.get(self.field.kind, "a number")
        )

    @property
    def unit(self) -> str:
        """Its unit, as far as its documentation names one."""
        return self.field.unit

    def with_value(self, text: str) -> Any:
        """Return a copy of the whole with another value here; BadSetting if it is invalid."""
        changed = _with_value(self.leaf, self.field, list(self.rest), text)
        for step in reversed(self.steps):
            changed = step.put(changed)
        return changed


@dataclass(frozen=True)
class HydrodynamicsPlace(Place):
    """A number of the hydrodynamics file of a vehicle, which is not read yet."""

    number: str = ""
    """The path in the file: ``body[base_link].mass``."""

    @property
    def path(self) -> str:
        """The path in full."""
        return ".".join([*(s.name for s in self.steps if s.name), HYDRODYNAMICS, self.number])

    @property
    def is_number(self) -> bool:
        """Whether it is one number; what it is in truth shows when the file is read."""
        return True

    @property
    def is_whole(self) -> bool:
        """Whether it is a whole number."""
        return False

    @property
    def unit(self) -> str:
        """Its unit, which is not known here."""
        return ""

    def with_value(self, text: str) -> Any:
        """Return a copy of the whole in which the number is set."""
        others = tuple(each for each in self.leaf.hydrodynamics if each[0] != self.number)
        changed = dataclasses.replace(
            self.leaf, hydrodynamics=(*others, (self.number, " ".join(text.split())))
        )
        for step in reversed(self.steps):
            changed = step.put(changed)
        return changed


@dataclass(frozen=True)
class Step:
    """A step from a spec to a nested one."""

    spec: Any
    """The outer one."""
    field: str
    """Its field that holds the inner one."""
    index: int | None
    """Where in a tuple; None: the field is the inner one itself."""
    name: str
    """What a path says for it; empty: nothing."""

    def put(self, inner: Any) -> Any:
        """Return the outer spec with another inner one."""
        if self.index is not None:
            entries = getattr(self.spec, self.field)
            inner = (*entries[: self.index], inner, *entries[self.index + 1 :])
        return dataclasses.replace(self.spec, **{self.field: inner})


def xacro_arguments(settings: Iterable[tuple[str, object]]) -> dict[str, str]:
    """Return the xacro arguments among settings: ``xacro.depth`` is the argument ``depth``."""
    return {
        name.removeprefix(OF_XACRO): str(value)
        for name, value in settings
        if name.startswith(OF_XACRO)
    }


def apply_setting(spec: T, path: str, value: str) -> T:
    """Return a copy of ``spec`` in which the value that ``path`` leads to is ``value``.

    Variations (``u:vary``) of that value, of a part of it or of something around it are dropped.
    A xacro argument (`xacro_arguments`) changes nothing here.

    Raises:
        BadSetting: a path that leads nowhere or a value that cannot stand there; names what can.
    """
    if path.startswith(OF_XACRO):
        return spec
    try:
        place = locate(spec, path)
        changed = place.with_value(value)
    except BadSetting as error:
        raise BadSetting(f"--set {path}={value}: {error}") from None
    if varied := getattr(changed, "vary", ()):
        kept = tuple(v for v in varied if not overlaps(locate(spec, v.path), place))
        changed = dataclasses.replace(changed, vary=kept)
    return cast(T, changed)


def locate(spec: Any, path: str) -> Place:
    """Find where a path leads in ``spec``; raises BadSetting for an unknown path."""
    parts = _parts(path)
    steps: list[Step] = []
    while True:
        (name, chosen), parts = parts[0], parts[1:]
        if name == HYDRODYNAMICS and hasattr(spec, HYDRODYNAMICS):
            return _hydrodynamics_place(tuple(steps), spec, parts)
        field = _field(type(spec), name)
        current = getattr(spec, field.name)
        index: int | None = None
        if field.kind == "choice" and parts:
            (name, chosen), parts = parts[0], parts[1:]
            kinds = {tag.rpartition("}")[2]: kind for tag, kind in field.type.items()}
            name = name.removeprefix("u:")
            if name not in kinds:
                raise BadSetting(str(UnknownName(f"element of <{field.label}>", name, kinds)))
            kind = kinds[name]
            index = _index(current, [isinstance(entry, kind) for entry in current], name, chosen)
            name = f"{field.label.removeprefix('u:')}.{name}"
        elif field.kind == "spec" and (field.is_repeated or field.is_member):
            name = field.label.removeprefix("u:")
            fits = [not field.is_member or isinstance(entry, field.type) for entry in current]
            index = _index(current, fits, name, chosen)
        elif chosen is not None:
            raise BadSetting(f"<{name}> stands once; leave [{chosen}] out.")
        elif field.kind == "spec":
            name = field.label.removeprefix("u:")
            if current is None:
                raise BadSetting(f"the file has no <{name}> here.")
        else:
            return Place(tuple(steps), spec, field, tuple(name for name, _ in parts))
        inner = current if index is None else current[index]
        if not parts:
            raise BadSetting(_inside(name, type(inner)))
        key = "" if index is None else f"[{_key(current, index)}]"
        steps.append(Step(spec, field.name, index, name + key))
        spec = inner


def _hydrodynamics_place(
    steps: tuple[Step, ...], vehicle: Any, parts: Sequence[tuple[str, str | None]]
) -> HydrodynamicsPlace:
    """Return the place of a number in the hydrodynamics file of a vehicle."""
    if vehicle.dynamics is None:
        raise BadSetting(f"the vehicle {vehicle.name!r} has no <u:dynamics>.")
    if not parts:
        raise BadSetting("<hydrodynamics> is not a value; continue with body[LINK].mass, ...")
    number = ".".join(name if key is None else f"{name}[{key}]" for name, key in parts)
    field = _field(type(vehicle), "dynamics")
    return HydrodynamicsPlace(steps, vehicle, field, (), number)


def overlaps(one: Place, other: Place) -> bool:
    """Whether two places share a value."""
    first, second = (place.path.split(".") for place in (one, other))
    return all(a == b for a, b in zip(first, second, strict=False))


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


def _field(cls: type, name: str) -> schema.Field:
    fields = {field.label.removeprefix("u:"): field for field in schema.fields_of(cls)}
    field = fields.get(name.removeprefix("u:"))
    if field is None:
        raise BadSetting(
            f"there is no <{name}>.{did_you_mean(name, fields)} There are: {', '.join(fields)}."
        )
    return field


def _inside(name: str, cls: type) -> str:
    names = ", ".join(field.label for field in schema.fields_of(cls))
    return f"<{name}> is not a value; its parts are {names}."


def _index(entries: Sequence[Any], fits: Sequence[bool], name: str, chosen: str | None) -> int:
    """Find the one entry that ``name[chosen]`` means: by its name, else by its number from 1."""
    found = [index for index, fit in enumerate(fits) if fit]
    names = [_name_of(entries[index]) for index in found]
    if chosen is not None:
        if chosen in names:
            return found[names.index(chosen)]
        if chosen.isdecimal() and 1 <= int(chosen) <= len(found) and not all(names):
            return found[int(chosen) - 1]
        raise BadSetting(str(UnknownName(f"<{name}>", chosen, names)))
    if len(found) != 1:
        shown = [each or str(number) for number, each in enumerate(names, start=1)]
        message = (
            f"choose one: {', '.join(f'{name}[{each}]' for each in shown)}" if found else "none"
        )
        raise BadSetting(f"the file has {len(found)} <{name}>; {message}.")
    return found[0]


def _name_of(entry: Any) -> str:
    """What chooses an entry among equals: its name, or the axis or link that it is about."""
    names = (getattr(entry, name, None) for name in ("name", "axis", "link"))
    return str(next((name for name in names if name is not None), ""))


def _key(entries: Sequence[Any], index: int) -> str:
    """What a path in full says for an entry: its name, or its number among those of its kind."""
    entry = entries[index]
    same = [other for other in entries if type(other) is type(entry)]
    name = _name_of(entry)
    is_first = next(other for other in same if _name_of(other) == name) is entry
    return name if name and is_first else str(1 + [id(o) for o in same].index(id(entry)))


def _with_value(spec: Any, field: schema.Field, rest: list[str], text: str) -> Any:
    """Read the value by the schema, as if it were in a file."""
    node = etree.Element(schema.camel_case(type(spec).__name__.removesuffix("Spec")))
    if field.kind == "triple" and not rest and text in field.words:
        etree.SubElement(node, field.tag).text = text
    elif field.kind == "triple":
        _write_triple(
            etree.SubElement(node, field.tag), getattr(spec, field.name), field, rest, text
        )
    elif rest and _is_list(field):
        text, rest = _with_number(getattr(spec, field.name), field, rest, text), []
        _write_list(node, field, text)
    elif rest:
        raise BadSetting(f"<{field.label}> is a value; it has no elements.")
    elif field.kind == "numbers":
        _write_list(node, field, text)
    elif field.kind not in ("str", "float", "int", "bool", "word"):
        raise BadSetting(f"<{field.label}> cannot be set from here; change the file.")
    elif not text and field.kind != "str":
        raise BadSetting(f"nothing behind the '='; expected {field.expected} for <{field.label}>.")
    elif field.xml.attribute:
        node.set(field.tag, text)
    elif field.xml.text:
        node.text = text
    elif field.xml.item is not None:
        _write_list(node, field, text)
    else:
        etree.SubElement(node, field.tag).text = text
    diagnostics = schema.Diagnostics("")
    given = {
        each.name: getattr(spec, each.name)
        for each in dataclasses.fields(spec)
        if each.init and each.name != field.name
    }
    changed = schema.read(type(spec), node, diagnostics, known_fields=given)
    if changed is None or diagnostics.to_list():
        raise BadSetting(
            "; ".join(diagnostic.message for diagnostic in diagnostics.to_list()) or "no value."
        )
    return changed


def _is_list(field: schema.Field) -> bool:
    """Whether a field is a list of numbers in one element."""
    return field.kind == "numbers" or (field.xml.item is not None and field.kind == "float")


def _with_number(current: Any, field: schema.Field, rest: list[str], text: str) -> str:
    """Return the text of a list in which one number, counted from 1, is another."""
    numbers = [repr(float(number)) for number in current or ()]
    if len(rest) > 1 or not rest[0].isdecimal() or not 1 <= int(rest[0]) <= len(numbers):
        raise BadSetting(
            f"<{field.label}> has {len(numbers)} numbers; expected one of them, from 1, as in "
            f"{field.label}.1."
        )
    numbers[int(rest[0]) - 1] = text
    return " ".join(numbers)


def _write_list(node: etree._Element, field: schema.Field, text: str) -> None:
    """Write a list of numbers: in one text, or an element each."""
    listed, words = etree.SubElement(node, field.tag), text.replace(",", " ").split()
    if field.xml.item is None:
        listed.text = " ".join(words)
        return
    for word in words:
        etree.SubElement(listed, field.xml.item).text = word


def _write_triple(
    node: etree._Element,
    current: tuple[float, float, float] | str | None,
    field: schema.Field,
    rest: list[str],
    text: str,
) -> None:
    """Write three numbers, given together or one of them by its letter."""
    letters = list(field.xml.parts)
    if not rest:
        words = text.replace(",", " ").split()
        if len(words) != len(letters):
            words_too = f", or one of {', '.join(field.words)}" if field.words else ""
            raise BadSetting(
                f"<{field.label}> wants {len(letters)} numbers, as in '1 2 3'{words_too}."
            )
    elif len(rest) > 1 or rest[0] not in letters or current is None or isinstance(current, str):
        raise BadSetting(f"<{field.label}> has {', '.join(f'<{letter}>' for letter in letters)}.")
    else:
        words = [
            text if letter == rest[0] else repr(float(number))
            for letter, number in zip(letters, current, strict=True)
        ]
    for letter, word in zip(letters, words, strict=True):
        etree.SubElement(node, letter).text = word

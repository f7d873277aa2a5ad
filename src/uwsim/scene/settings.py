"""Settings from the command line: ``--set oceanState.fog.density=0.4`` changes one value of a spec.

A path is element names joined by dots; ``[name]`` chooses among elements of one name, and is
optional if there is only one: ``vehicle[girona500].virtualCamera[bowtech1].std``. An element
without a name is chosen by its axis (``sway[x]``), or by its number from 1
(``oceanState.current.gaussMarkov[2]``). The value is read by the same rules as in a file. Three
numbers are set together (``position=1 2 3``) or one by one (``position.x=1``), a list as a whole
(``jointValues=0 0 2.2 0 0.8``) or by its numbers from 1 (``jointValues.3=2.2``).

A path below ``vehicle[NAME].hydrodynamics`` refers to the hydrodynamics file of a vehicle:
``vehicle[girona500].hydrodynamics.body[base_link].mass``. It is resolved when that file is read.
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
XACRO_PREFIX = "xacro."
"""The prefix of settings that are xacro arguments, which apply when the file is read."""
HYDRODYNAMICS = "hydrodynamics"
"""The name in a path that leads from a vehicle into its hydrodynamics file."""
_PART = re.compile(r"([^\[\].=]+)(?:\[([^\]]*)\])?(?:\.|$)")


@dataclass(frozen=True)
class Place:
    """The value that a path refers to."""

    steps: tuple[Step, ...]
    """The steps from the root spec to the spec that has the value."""
    leaf: Any
    """The spec that has the value."""
    field: schema.Field
    """The field of the value in that spec."""
    rest: tuple[str, ...]
    """The names of the path after the field: a letter of a triple."""

    @property
    def path(self) -> str:
        """The path in full: with every name, without ``u:``."""
        names = [step.name for step in self.steps if step.name]
        return ".".join([*names, self.field.label.removeprefix("u:"), *self.rest])

    @property
    def is_number(self) -> bool:
        """True if the value is one number."""
        is_scalar = self.field.kind in ("float", "int") and not self.field.is_repeated
        return (is_scalar and not self.rest) or (self.has_parts and len(self.rest) == 1)

    @property
    def has_parts(self) -> bool:
        """True if the value has several numbers, of which one can be chosen."""
        return self.field.kind == "triple" or _is_list(self.field)

    @property
    def is_integer(self) -> bool:
        """True if the value is an integer."""
        return self.field.kind == "int"

    @property
    def kind(self) -> str:
        """The kind of value, in words."""
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
        """The unit, if the documentation of the field has one."""
        return self.field.unit

    def with_value(self, text: str) -> Any:
        """Return a copy of the root spec with another value; BadSetting if it is invalid."""
        new_spec = _with_value(self.leaf, self.field, list(self.rest), text)
        for step in reversed(self.steps):
            new_spec = step.with_inner(new_spec)
        return new_spec


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
        """True if the value is one number; its kind is checked when the file is read."""
        return True

    @property
    def is_integer(self) -> bool:
        """True if the value is an integer."""
        return False

    @property
    def unit(self) -> str:
        """The unit, which is unknown before the file is read."""
        return ""

    def with_value(self, text: str) -> Any:
        """Return a copy of the root spec in which the number is set."""
        other_entries = tuple(entry for entry in self.leaf.hydrodynamics if entry[0] != self.number)
        new_spec = dataclasses.replace(
            self.leaf, hydrodynamics=(*other_entries, (self.number, " ".join(text.split())))
        )
        for step in reversed(self.steps):
            new_spec = step.with_inner(new_spec)
        return new_spec


@dataclass(frozen=True)
class Step:
    """A step from a spec to a nested one."""

    spec: Any
    """The outer spec."""
    field: str
    """The field of the outer spec that has the inner one."""
    index: int | None
    """The index in a tuple; None: the field is the inner spec itself."""
    name: str
    """The name of the step in a path; empty for none."""

    def with_inner(self, new_value: Any) -> Any:
        """Return the outer spec with another inner spec."""
        if self.index is not None:
            entries = getattr(self.spec, self.field)
            new_value = (*entries[: self.index], new_value, *entries[self.index + 1 :])
        return dataclasses.replace(self.spec, **{self.field: new_value})


def xacro_arguments(settings: Iterable[tuple[str, object]]) -> dict[str, str]:
    """Return the xacro arguments among settings: ``xacro.depth`` is the argument ``depth``."""
    return {
        name.removeprefix(XACRO_PREFIX): str(value)
        for name, value in settings
        if name.startswith(XACRO_PREFIX)
    }


def apply_setting(spec: T, path: str, value: str) -> T:
    """Return a copy of ``spec`` with another value at ``path``.

    Variations (``u:vary``) of that value, of a part of it or of an element around it are removed.
    A xacro argument (`xacro_arguments`) changes nothing here.

    Raises:
        BadSetting: an unknown path or an invalid value; names the valid ones.
    """
    if path.startswith(XACRO_PREFIX):
        return spec
    try:
        place = locate(spec, path)
        new_spec = place.with_value(value)
    except BadSetting as error:
        raise BadSetting(f"--set {path}={value}: {error}") from None
    if variations := getattr(new_spec, "vary", ()):
        other_variations = tuple(v for v in variations if not overlaps(locate(spec, v.path), place))
        new_spec = dataclasses.replace(new_spec, vary=other_variations)
    return cast(T, new_spec)


def locate(spec: Any, path: str) -> Place:
    """Resolve a path in ``spec``; raise BadSetting for an unknown path."""
    parts = _parts(path)
    steps: list[Step] = []
    while True:
        (name, key), parts = parts[0], parts[1:]
        if name == HYDRODYNAMICS and hasattr(spec, HYDRODYNAMICS):
            return _hydrodynamics_place(tuple(steps), spec, parts)
        field = _field(type(spec), name)
        current = getattr(spec, field.name)
        index: int | None = None
        if field.kind == "choice" and parts:
            (name, key), parts = parts[0], parts[1:]
            kinds = {tag.rpartition("}")[2]: kind for tag, kind in field.type.items()}
            name = name.removeprefix("u:")
            if name not in kinds:
                raise BadSetting(str(UnknownName(f"element of <{field.label}>", name, kinds)))
            kind = kinds[name]
            index = _index(current, [isinstance(entry, kind) for entry in current], name, key)
            name = f"{field.label.removeprefix('u:')}.{name}"
        elif field.kind == "spec" and (field.is_repeated or field.is_member):
            name = field.label.removeprefix("u:")
            fits = [not field.is_member or isinstance(entry, field.type) for entry in current]
            index = _index(current, fits, name, key)
        elif key is not None:
            raise BadSetting(f"<{name}> occurs once; remove [{key}].")
        elif field.kind == "spec":
            name = field.label.removeprefix("u:")
            if current is None:
                raise BadSetting(f"the file has no <{name}> here.")
        else:
            return Place(tuple(steps), spec, field, tuple(name for name, _ in parts))
        inner_spec = current if index is None else current[index]
        if not parts:
            raise BadSetting(_parts_message(name, type(inner_spec)))
        key_text = "" if index is None else f"[{_key(current, index)}]"
        steps.append(Step(spec, field.name, index, name + key_text))
        spec = inner_spec


def _hydrodynamics_place(
    steps: tuple[Step, ...], vehicle: Any, parts: Sequence[tuple[str, str | None]]
) -> HydrodynamicsPlace:
    if vehicle.dynamics is None:
        raise BadSetting(f"the vehicle {vehicle.name!r} has no <u:dynamics>.")
    if not parts:
        raise BadSetting("<hydrodynamics> is not a value; continue with body[LINK].mass, ...")
    number = ".".join(name if key is None else f"{name}[{key}]" for name, key in parts)
    field = _field(type(vehicle), "dynamics")
    return HydrodynamicsPlace(steps, vehicle, field, (), number)


def overlaps(left: Place, right: Place) -> bool:
    """Return whether two places share a value."""
    left_names, right_names = (place.path.split(".") for place in (left, right))
    return all(a == b for a, b in zip(left_names, right_names, strict=False))


def _parts(path: str) -> list[tuple[str, str | None]]:
    """Split ``a.b[c].d`` into [("a", None), ("b", "c"), ("d", None)]."""
    parts: list[tuple[str, str | None]] = []
    position = 0
    while position < len(path) or not parts:
        match = _PART.match(path, position)
        if match is None or (match.end() == len(path) and path.endswith(".")):
            raise BadSetting("not a path; expected names joined by dots, as in a.b[name].c.")
        parts.append((match[1], match[2]))
        position = match.end()
    return parts


def _field(cls: type, name: str) -> schema.Field:
    fields = {field.label.removeprefix("u:"): field for field in schema.fields_of(cls)}
    field = fields.get(name.removeprefix("u:"))
    if field is None:
        raise BadSetting(
            f"there is no <{name}>.{did_you_mean(name, fields)} There are: {', '.join(fields)}."
        )
    return field


def _parts_message(name: str, cls: type) -> str:
    names = ", ".join(field.label for field in schema.fields_of(cls))
    return f"<{name}> is not a value; its parts are {names}."


def _index(entries: Sequence[Any], fits: Sequence[bool], name: str, key: str | None) -> int:
    """Return the index of the entry ``name[key]``: by its name, else by its number from 1."""
    indices = [index for index, fit in enumerate(fits) if fit]
    names = [_name_of(entries[index]) for index in indices]
    if key is not None:
        if key in names:
            return indices[names.index(key)]
        if key.isdecimal() and 1 <= int(key) <= len(indices) and not all(names):
            return indices[int(key) - 1]
        raise BadSetting(str(UnknownName(f"<{name}>", key, names)))
    if len(indices) != 1:
        keys = [key_text or str(number) for number, key_text in enumerate(names, start=1)]
        message = (
            f"choose one: {', '.join(f'{name}[{key_text}]' for key_text in keys)}"
            if indices
            else "none"
        )
        raise BadSetting(f"the file has {len(indices)} <{name}>; {message}.")
    return indices[0]


def _name_of(entry: Any) -> str:
    """Return the key of an entry: its name, or its axis or link."""
    names = (getattr(entry, name, None) for name in ("name", "axis", "link"))
    return str(next((name for name in names if name is not None), ""))


def _key(entries: Sequence[Any], index: int) -> str:
    """Return the key of an entry in a full path: its name, or its number among its kind."""
    entry = entries[index]
    siblings = [other for other in entries if type(other) is type(entry)]
    name = _name_of(entry)
    is_first = next(other for other in siblings if _name_of(other) == name) is entry
    return name if name and is_first else str(1 + [id(o) for o in siblings].index(id(entry)))


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
        raise BadSetting(f"nothing after the '='; expected {field.expected} for <{field.label}>.")
    elif field.xml.attribute:
        node.set(field.tag, text)
    elif field.xml.text:
        node.text = text
    elif field.xml.item is not None:
        _write_list(node, field, text)
    else:
        etree.SubElement(node, field.tag).text = text
    diagnostics = schema.Diagnostics("")
    known_fields = {
        spec_field.name: getattr(spec, spec_field.name)
        for spec_field in dataclasses.fields(spec)
        if spec_field.init and spec_field.name != field.name
    }
    new_spec = schema.read(type(spec), node, diagnostics, known_fields=known_fields)
    if new_spec is None or diagnostics.to_list():
        raise BadSetting(
            "; ".join(diagnostic.message for diagnostic in diagnostics.to_list()) or "no value."
        )
    return new_spec


def _is_list(field: schema.Field) -> bool:
    """Return whether a field is a list of numbers in one element."""
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
    list_node, words = etree.SubElement(node, field.tag), text.replace(",", " ").split()
    if field.xml.item is None:
        list_node.text = " ".join(words)
        return
    for word in words:
        etree.SubElement(list_node, field.xml.item).text = word


def _write_triple(
    node: etree._Element,
    current: tuple[float, float, float] | str | None,
    field: schema.Field,
    rest: list[str],
    text: str,
) -> None:
    letters = list(field.xml.parts)
    if not rest:
        words = text.replace(",", " ").split()
        if len(words) != len(letters):
            alternatives = f", or one of {', '.join(field.words)}" if field.words else ""
            count = len(letters)
            raise BadSetting(f"<{field.label}> needs {count} numbers, as in '1 2 3'{alternatives}.")
    elif len(rest) > 1 or rest[0] not in letters or current is None or isinstance(current, str):
        raise BadSetting(f"<{field.label}> has {', '.join(f'<{letter}>' for letter in letters)}.")
    else:
        words = [
            text if letter == rest[0] else repr(float(number))
            for letter, number in zip(letters, current, strict=True)
        ]
    for letter, word in zip(letters, words, strict=True):
        etree.SubElement(node, letter).text = word

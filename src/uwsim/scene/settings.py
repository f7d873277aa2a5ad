"""Settings from the command line: ``--set oceanState.fog.density=0.4`` changes one value of a spec.

A path consists of element names joined by dots. ``[name]`` selects one of several elements with the
same tag, and is optional if there is only one: ``vehicle[girona500].virtualCamera[bowtech1].std``.
An element without a name is selected by its axis (``sway[x]``), or by its number from 1
(``oceanState.current.gaussMarkov[2]``). The value is read by the same rules as in a file. Three
numbers are set together (``position=1 2 3``) or singly (``position.x=1``); a list is set as a whole
(``jointValues=0 0 2.2 0 0.8``) or by the number of an entry, from 1 (``jointValues.3=2.2``).

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
"""The prefix of settings that are xacro arguments; these apply when the file is read."""
HYDRODYNAMICS = "hydrodynamics"
"""The name in a path after which it continues in the vehicle's hydrodynamics file."""
_PART = re.compile(r"([^\[\].=]+)(?:\[([^\]]*)\])?(?:\.|$)")


@dataclass(frozen=True)
class ValueLocation:
    """The location, in a tree of specs, of the value to which a path refers."""

    steps: tuple[Step, ...]
    """The steps from the root spec to the spec that has the value."""
    owner: Any
    """The spec that contains the value."""
    field: schema.Field
    """The field of `owner` that contains the value."""
    components: tuple[str, ...]
    """The rest of the path: ``x`` of a triple, or the number of an entry of a list; often empty."""

    @property
    def path(self) -> str:
        """The full path: with the name of every element, without ``u:``."""
        names = [step.name for step in self.steps if step.name]
        return ".".join([*names, self.field.label.removeprefix("u:"), *self.components])

    @property
    def is_number(self) -> bool:
        """True if the value is one number."""
        is_scalar = self.field.kind in ("float", "int") and not self.field.is_repeated
        return (is_scalar and not self.components) or (self.has_parts and len(self.components) == 1)

    @property
    def has_parts(self) -> bool:
        """True if the value is a triple or a list, of which one number can be selected."""
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
        """Return a copy of the root spec with another value; raise BadSetting if it is invalid."""
        new_spec = _with_value(self.owner, self.field, list(self.components), text)
        for step in reversed(self.steps):
            new_spec = step.with_inner(new_spec)
        return new_spec


@dataclass(frozen=True)
class HydrodynamicsLocation(ValueLocation):
    """The location of a number in a vehicle's hydrodynamics file, which is read later."""

    number: str = ""
    """The path within the file, for example ``body[base_link].mass``."""

    @property
    def path(self) -> str:
        """The full path."""
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
        other_entries = tuple(
            entry for entry in self.owner.hydrodynamics if entry[0] != self.number
        )
        new_spec = dataclasses.replace(
            self.owner, hydrodynamics=(*other_entries, (self.number, " ".join(text.split())))
        )
        for step in reversed(self.steps):
            new_spec = step.with_inner(new_spec)
        return new_spec


@dataclass(frozen=True)
class Step:
    """A step of a path from a spec to a nested spec."""

    spec: Any
    """The outer spec."""
    field: str
    """The name of the field of the outer spec that contains the inner spec."""
    index: int | None
    """The index in the field's tuple; None if the field is the inner spec itself."""
    name: str
    """The text of the step in a path; empty for a step that a path does not show."""

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

    Variations (``u:vary``) that overlap with the value are removed. A xacro argument
    (`xacro_arguments`) changes nothing here.

    Raises:
        BadSetting: the path is unknown, or the value is invalid; the error message lists valid
            ones. Or the value has no effect in ``spec``.
    """
    if path.startswith(XACRO_PREFIX):
        return spec
    try:
        location = locate(spec, path)
        check_effect(location)
        new_spec = location.with_value(value)
    except BadSetting as error:
        raise BadSetting(f"--set {path}={value}: {error}") from None
    if variations := getattr(new_spec, "vary", ()):
        other_variations = tuple(
            v for v in variations if not overlaps(locate(spec, v.path), location)
        )
        new_spec = dataclasses.replace(new_spec, vary=other_variations)
    return cast(T, new_spec)


def locate(spec: Any, path: str) -> ValueLocation:
    """Return the location to which a path in ``spec`` refers; raise BadSetting if unknown."""
    parts = _parts(path)
    steps: list[Step] = []
    while True:
        (name, key), parts = parts[0], parts[1:]
        if name == HYDRODYNAMICS and hasattr(spec, HYDRODYNAMICS):
            return _hydrodynamics_location(tuple(steps), spec, parts)
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
            return ValueLocation(tuple(steps), spec, field, tuple(name for name, _ in parts))
        inner_spec = current if index is None else current[index]
        if not parts:
            raise BadSetting(_parts_message(name, type(inner_spec)))
        key_text = "" if index is None else f"[{_key(current, index)}]"
        steps.append(Step(spec, field.name, index, name + key_text))
        spec = inner_spec


def _hydrodynamics_location(
    steps: tuple[Step, ...], vehicle: Any, parts: Sequence[tuple[str, str | None]]
) -> HydrodynamicsLocation:
    if vehicle.dynamics is None:
        raise BadSetting(f"the vehicle {vehicle.name!r} has no <u:dynamics>.")
    if not parts:
        raise BadSetting("<hydrodynamics> is not a value; continue with body[LINK].mass, ...")
    number = ".".join(name if key is None else f"{name}[{key}]" for name, key in parts)
    field = _field(type(vehicle), "dynamics")
    return HydrodynamicsLocation(steps, vehicle, field, (), number)


def check_effect(location: ValueLocation) -> None:
    """Raise BadSetting for fog, colour and attenuation that physical water replaces."""
    from .ocean_state import OceanStateSpec
    from .physical_water import REPLACED_ELEMENTS

    owners = [(step.spec, step.field) for step in location.steps]
    for owner, name in [*owners, (location.owner, location.field.name)]:
        is_physical = isinstance(owner, OceanStateSpec) and owner.water is not None
        if is_physical and name in REPLACED_ELEMENTS:
            raise BadSetting(
                f"<{name}> has no effect: the scene has physical water; set a value of "
                "oceanState.water instead, such as oceanState.water.type."
            )


def overlaps(left: ValueLocation, right: ValueLocation) -> bool:
    """Return whether two locations share a value: one contains the other, or they are equal."""
    left_names, right_names = (location.path.split(".") for location in (left, right))
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
    """Return the name of an entry, else its axis or link; empty without any."""
    names = (getattr(entry, name, None) for name in ("name", "axis", "link"))
    return str(next((name for name in names if name is not None), ""))


def _key(entries: Sequence[Any], index: int) -> str:
    """Return the key of an entry in a full path: its name, or its number among equal types."""
    entry = entries[index]
    siblings = [other for other in entries if type(other) is type(entry)]
    name = _name_of(entry)
    is_first = next(other for other in siblings if _name_of(other) == name) is entry
    return name if name and is_first else str(1 + [id(o) for o in siblings].index(id(entry)))


def _with_value(spec: Any, field: schema.Field, components: list[str], text: str) -> Any:
    """Return a copy of ``spec`` whose field is read from a text by the schema, as in a file."""
    node = etree.Element(schema.camel_case(type(spec).__name__.removesuffix("Spec")))
    if field.kind == "triple" and not components and text in field.words:
        etree.SubElement(node, field.tag).text = text
    elif field.kind == "triple":
        _write_triple(
            etree.SubElement(node, field.tag), getattr(spec, field.name), field, components, text
        )
    elif components and _is_list(field):
        text, components = _with_number(getattr(spec, field.name), field, components, text), []
        _write_list(node, field, text)
    elif components:
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


def _with_number(current: Any, field: schema.Field, components: list[str], text: str) -> str:
    """Return the text of a list in which one number, selected by its number from 1, is replaced."""
    numbers = [repr(float(number)) for number in current or ()]
    if (
        len(components) > 1
        or not components[0].isdecimal()
        or not 1 <= int(components[0]) <= len(numbers)
    ):
        raise BadSetting(
            f"<{field.label}> has {len(numbers)} numbers; expected one of them, from 1, as in "
            f"{field.label}.1."
        )
    numbers[int(components[0]) - 1] = text
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
    components: list[str],
    text: str,
) -> None:
    letters = list(field.xml.parts)
    if not components:
        words = text.replace(",", " ").split()
        if len(words) != len(letters):
            alternatives = f", or one of {', '.join(field.words)}" if field.words else ""
            count = len(letters)
            raise BadSetting(f"<{field.label}> needs {count} numbers, as in '1 2 3'{alternatives}.")
    elif (
        len(components) > 1
        or components[0] not in letters
        or current is None
        or isinstance(current, str)
    ):
        raise BadSetting(f"<{field.label}> has {', '.join(f'<{letter}>' for letter in letters)}.")
    else:
        words = [
            text if letter == components[0] else repr(float(number))
            for letter, number in zip(letters, current, strict=True)
        ]
    for letter, word in zip(letters, words, strict=True):
        etree.SubElement(node, letter).text = word

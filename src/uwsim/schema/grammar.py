"""The grammar of a spec: what `element` says about a field, and the table made of it."""

from __future__ import annotations

import ast
import dataclasses
import functools
import inspect
import itertools
import re
import textwrap
import types
import typing
from collections.abc import Hashable, Mapping
from dataclasses import MISSING, dataclass
from typing import Any, Literal, cast

from .names import NAMESPACE, local

FARTHEST = 1e6
"""Greatest length that a scene needs [m]."""
LARGEST = 1e9
"""Greatest number that any quantity needs, in whatever unit; larger ones are mistakes of units."""


@dataclass(frozen=True)
class Xml:
    """What `element` keeps about a field."""

    name: str | None = None
    unit: str = ""
    attribute: bool = False
    text: bool = False
    namespaced: bool = False
    aliases: tuple[str, ...] = ()
    parts: str = "xyz"
    words: tuple[str, ...] = ()
    item: str | None = None
    choice: Mapping[str, type] | None = None
    minimum: float | None = None
    maximum: float | None = None
    above: float | None = None
    below: float | None = None
    invalid: bool | None = None
    lenient: bool = False
    required_by_dtd: bool = False
    pattern: str | None = None


def element(
    name: str | None = None,
    *,
    default: Any = MISSING,
    default_factory: Any = MISSING,
    unit: str = "",
    attribute: bool = False,
    text: bool = False,
    namespaced: bool = False,
    aliases: tuple[str, ...] = (),
    parts: str = "xyz",
    words: tuple[str, ...] = (),
    item: str | None = None,
    choice: Mapping[str, type] | None = None,
    minimum: float | None = None,
    maximum: float | None = None,
    above: float | None = None,
    below: float | None = None,
    invalid: bool | None = None,
    lenient: bool = False,
    required_by_dtd: bool = False,
) -> Any:
    """Make a dataclass field that stands in the file otherwise than its name alone would say.

    Args:
        name: of the element or attribute; the field's in camelCase when absent.
        default: when the element is absent or, of the original's, empty.
        default_factory: as in `dataclasses.field`.
        unit: for messages, when the documentation string does not name it in brackets.
        attribute: it is an attribute of the element that the spec is read from.
        text: it is the text of the element that the spec is read from.
        namespaced: it is an extension, ``u:name``.
        aliases: old names, read with a notice.
        parts: names of a triple's elements, one letter each.
        words: of a triple, what may stand in the place of its elements.
        item: the element is a list; this is the name of its items.
        choice: name -> spec of the children that may stand in the element, in any number.
        minimum: smallest value allowed.
        maximum: largest value allowed.
        above: values must be greater.
        below: values must be less.
        invalid: what a flag that is neither 0 nor 1 is read as; the default when absent.
        lenient: junk behind a number is a notice, not a fault (the original used atof).
        required_by_dtd: the original's grammar wants it although it has a default.
    """
    xml = Xml(
        name, unit, attribute, text, namespaced, aliases, parts, words, item, choice,
        minimum, maximum, above, below, invalid, lenient, required_by_dtd,
    )  # fmt: skip
    metadata = {"xml": xml}
    if default_factory is not MISSING:
        return dataclasses.field(default_factory=default_factory, metadata=metadata)
    return dataclasses.field(default=default, metadata=metadata)


@dataclass(frozen=True)
class Slot:
    """One field of a spec, ready to be read, written and documented."""

    field: str
    """Name of the dataclass field."""
    tag: str
    """Qualified name in the file."""
    kind: str
    """str, float, int, bool, word, triple, spec, choice, or hand (only its caller can read it)."""
    type: Any
    """The scalar's type, the spec, or the words of a Literal."""
    repeated: bool
    """Whether it is a tuple of these."""
    optional: bool
    """Whether None is allowed."""
    xml: Xml
    """What `element` said."""
    default: Any
    """Its default; MISSING when it must be there."""
    owner: type
    """The spec it belongs to."""

    @property
    def shown(self) -> str:
        """The name as a user writes it."""
        return local(self.tag)

    @property
    def doc(self) -> str:
        """Its documentation string."""
        return field_docs(self.owner).get(self.field, "")

    @property
    def unit(self) -> str:
        """Its unit, from `element` or the brackets of its documentation; may be empty."""
        if self.xml.unit:
            return self.xml.unit
        brackets = re.search(r"\[([^\]]+)\]", self.doc)
        return brackets[1] if brackets and self.kind in ("float", "int", "triple") else ""

    @property
    def expected(self) -> str:
        """What should have stood there, in words."""
        if self.kind == "word":
            said = "one of " + ", ".join(repr(word) for word in self.type)
            parts = " ".join(f"<{part}>" for part in self.xml.parts)
            return f"{said}, or {parts}" if self.xml.words else said
        if self.kind == "bool":
            return "true or false" if self.xml.attribute else "0 or 1"
        words = {"float": "a number", "triple": "a number", "int": "a whole number"}
        limits = [
            f"{sign} {limit:g}"
            for sign, limit in (
                (">=", self.xml.minimum),
                ("<=", self.xml.maximum),
                (">", self.xml.above),
                ("<", self.xml.below),
            )
            if limit is not None
        ]
        said = " ".join([words.get(self.kind, "text"), *([" and ".join(limits)] if limits else [])])
        return f"{said} [{self.unit}]" if self.unit else said


def camel(name: str) -> str:
    """``relative_to`` -> ``relativeTo``."""
    first, *others = name.split("_")
    return first + "".join(word.capitalize() for word in others)


def slots(cls: type) -> tuple[Slot, ...]:
    """The fields of a spec in their order, which is the order of the original grammar."""
    return _slots(cls)


@functools.cache
def _slots(cls: Hashable) -> tuple[Slot, ...]:
    assert isinstance(cls, type)
    hints = typing.get_type_hints(cls)
    return tuple(
        _slot(cls, field, hints[field.name])
        for field in dataclasses.fields(cls)
        if field.init and "path" not in field.metadata
    )


def _slot(cls: type, field: dataclasses.Field[Any], hint: Any) -> Slot:
    xml: Xml = field.metadata.get("xml") or Xml()
    tag = xml.name or camel(field.name)
    if xml.namespaced:
        tag = f"{{{NAMESPACE}}}{tag}"
    default: Any = field.default
    if field.default_factory is not MISSING:
        default = field.default_factory()
    optional, repeated = False, False
    if typing.get_origin(hint) in (typing.Union, types.UnionType):
        inner = [arg for arg in typing.get_args(hint) if arg is not type(None)]
        optional, hint = len(inner) < len(typing.get_args(hint)), inner[0]
    if _is_variadic(hint):
        repeated, hint = True, typing.get_args(hint)[0]
        if default is MISSING and xml.choice is None:
            default = MISSING
    kind, type_ = _kind(hint, xml)
    return Slot(field.name, tag, kind, type_, repeated, optional, xml, default, cls)


def _is_variadic(hint: Any) -> bool:
    return typing.get_origin(hint) is tuple and typing.get_args(hint)[-1] is Ellipsis


def _kind(hint: Any, xml: Xml) -> tuple[str, Any]:
    if xml.choice is not None:
        return "choice", xml.choice
    if typing.get_origin(hint) is Literal:
        return "word", typing.get_args(hint)
    if typing.get_origin(hint) is tuple and typing.get_args(hint) == (float, float, float):
        return "triple", float
    if _is_variadic(hint) and xml.item:  # a repeated list: tuple[tuple[float, ...], ...]
        return "list", typing.get_args(hint)[0]
    if hint in (str, float, int, bool):
        return hint.__name__, hint
    if dataclasses.is_dataclass(hint) and not inspect.isabstract(hint):
        return "spec", hint
    return "hand", hint


@functools.cache
def field_docs(cls: type) -> dict[str, str]:
    """The documentation string under each field of a spec, inherited ones included."""
    docs: dict[str, str] = {}
    for base in reversed(cls.__mro__):
        if not dataclasses.is_dataclass(base):
            continue
        try:
            source = textwrap.dedent(inspect.getsource(base))
        except (OSError, TypeError):
            continue
        body = cast(ast.ClassDef, ast.parse(source).body[0]).body
        for here, after in itertools.pairwise(body):
            if (
                isinstance(here, ast.AnnAssign)
                and isinstance(here.target, ast.Name)
                and isinstance(after, ast.Expr)
                and isinstance(after.value, ast.Constant)
            ):
                docs[here.target.id] = inspect.cleandoc(str(after.value.value))
    return docs

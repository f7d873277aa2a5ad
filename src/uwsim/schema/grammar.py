"""The grammar of a spec: the table of its fields, made from their declarations."""

from __future__ import annotations

import ast
import dataclasses
import functools
import inspect
import itertools
import operator
import re
import sys
import textwrap
import types
import typing
from collections.abc import Callable, Hashable, Iterator, Mapping
from dataclasses import MISSING, dataclass
from typing import Annotated, Any, Literal, cast

from .declaration import Xml
from .names import NAMESPACE, local

MAX_DISTANCE = 1e6
"""Greatest length that a scene needs [m]."""
MAX_NUMBER = 1e9
"""Greatest number that any quantity needs, in whatever unit; larger ones are mistakes of units."""

QUANTITIES = ("float", "int", "triple", "numbers")
"""Kinds of a `Field` that limits and a unit belong to."""

Numbers = Annotated[tuple[float, ...], "numbers"]
"""Numbers in the text of one element, separated by blanks."""
TwoNumbers = Annotated[tuple[float, float], "numbers"]
"""Two of them."""


_SIGNS: dict[str, tuple[str, Callable[[float, float], bool]]] = {
    "minimum": (">=", operator.ge),
    "above": (">", operator.gt),
    "maximum": ("<=", operator.le),
    "below": ("<", operator.lt),
}
"""Text and comparison of each of `Limits`."""


@dataclass(frozen=True)
class Field:
    """One field of a spec, ready to be read, written and documented."""

    name: str
    """Name of the dataclass field."""
    tag: str
    """Qualified name in the file."""
    kind: str
    """str, float, int, bool, word, triple, numbers, list, spec, choice, or manual (left to the
    caller)."""
    type: Any
    """The scalar's type, the spec, the words of a Literal, or how many numbers (0: any)."""
    repeated: bool
    """Whether it is a tuple of these."""
    optional: bool
    """Whether None is allowed."""
    xml: Xml
    """The options of `element`."""
    default: Any
    """Its default; MISSING when it required."""
    owner: type
    """The spec it belongs to."""
    words: tuple[str, ...] = ()
    """Words that a triple may hold instead of its elements."""
    is_member: bool = False
    """Whether it is a member of a choice without a name: those values that have its type."""

    @property
    def shown(self) -> str:
        """The name as a user writes it."""
        return local(self.tag)

    def of(self, spec: object) -> Any:
        """Its value in a spec."""
        value = getattr(spec, self.name)
        if not self.is_member:
            return value
        members = tuple(each for each in value if isinstance(each, self.type))
        return members if self.repeated else next(iter(members), None)

    @property
    def doc(self) -> str:
        """Its documentation string; of a member, what its spec or its module begins with."""
        if self.is_member:
            _, colon, meaning = (self.type.__doc__ or "").split("\n")[0].partition(": ")
            module = sys.modules[self.type.__module__].__doc__ or ""
            line = meaning if colon else module.split("\n")[0]
            return line[:1].upper() + line[1:]
        return field_docs(self.owner).get(self.name, "")

    @property
    def unit(self) -> str:
        """Its unit, from the brackets of its documentation; may be empty."""
        brackets = re.search(r"\[([^\]]+)\]", self.doc)
        return brackets[1] if brackets and self.kind in QUANTITIES else ""

    @property
    def expected(self) -> str:
        """The expected content, in words."""
        if self.kind == "word":
            text = "one of " + ", ".join(repr(word) for word in self.type)
            parts = " ".join(f"<{part}>" for part in self.xml.parts)
            return f"{text}, or {parts}" if self.words else text
        if self.kind == "bool":
            return "true or false" if self.xml.attribute else "0 or 1"
        words = {"int": "a whole number", "numbers": "numbers"}
        words |= dict.fromkeys(("float", "triple"), "a number")
        limits = [f"{sign} {limit:g}" for sign, limit, _ in self._limits()]
        text = " ".join([words.get(self.kind, "text"), *([" and ".join(limits)] if limits else [])])
        return f"{text} [{self.unit}]" if self.unit else text

    def allows(self, value: float) -> bool:
        """Whether a number is within the limits."""
        return all(holds(value, limit) for _, limit, holds in self._limits())

    def _limits(self) -> Iterator[tuple[str, float, Callable[[float, float], bool]]]:
        limits = cast(Mapping[str, float], self.xml.limits)
        for name, (sign, holds) in _SIGNS.items():
            if name in limits:
                yield sign, limits[name], holds


def camel(name: str) -> str:
    """``relative_to`` -> ``relativeTo``."""
    first, *others = name.split("_")
    return first + "".join(word.capitalize() for word in others)


def fields_of(cls: type) -> tuple[Field, ...]:
    """The fields of a spec in their order, which is the order of the original grammar."""
    return _fields_of(cls)


@functools.cache
def _fields_of(cls: Hashable) -> tuple[Field, ...]:
    assert isinstance(cls, type)
    hints = typing.get_type_hints(cls, include_extras=True)
    fields = [
        _field(cls, field, hints[field.name])
        for field in dataclasses.fields(cls)
        if field.init and not {"path", "not_in_file"} & set(field.metadata)
    ]
    return tuple(part for field in fields for part in _members(field))


def _members(field: Field) -> Iterator[Field]:
    """The members of a choice without a name; any other field itself."""
    if field.kind != "choice" or field.xml.name != "":
        yield field
        return
    for tag, spec in field.type.items():
        stands_once = getattr(spec, "STANDS_ONCE", False)
        yield dataclasses.replace(
            field,
            tag=tag,
            kind="spec",
            type=spec,
            repeated=not stands_once,
            optional=stands_once,
            xml=Xml(namespaced=tag.startswith("{")),
            default=None if stands_once else (),
            is_member=True,
        )


def _field(cls: type, field: dataclasses.Field[Any], hint: Any) -> Field:
    xml: Xml = field.metadata.get("xml") or Xml()
    tag = camel(field.name) if xml.name is None else xml.name
    if xml.namespaced:
        tag = f"{{{NAMESPACE}}}{tag}"
    default: Any = field.default
    if field.default_factory is not MISSING:
        default = field.default_factory()
    optional, repeated = False, False
    words: tuple[str, ...] = ()
    if typing.get_origin(hint) in (typing.Union, types.UnionType):
        inner = [arg for arg in typing.get_args(hint) if arg is not type(None)]
        optional, hint = len(inner) < len(typing.get_args(hint)), inner[0]
        words = tuple(word for other in inner[1:] for word in typing.get_args(other))
    if _is_variadic(hint):
        repeated, hint = True, typing.get_args(hint)[0]
    kind, type_ = _kind(hint, xml)
    return Field(field.name, tag, kind, type_, repeated, optional, xml, default, cls, words)


def _is_variadic(hint: Any) -> bool:
    return typing.get_origin(hint) is tuple and typing.get_args(hint)[-1] is Ellipsis


def _kind(hint: Any, xml: Xml) -> tuple[str, Any]:
    if xml.choice is not None:
        return "choice", xml.choice
    if typing.get_origin(hint) is Literal:
        return "word", typing.get_args(hint)
    if hint in (Numbers, TwoNumbers):
        return "numbers", 0 if hint == Numbers else 2
    if hint == tuple[float, float, float]:
        return "triple", float
    if _is_variadic(hint) and xml.item:  # a repeated list: tuple[tuple[float, ...], ...]
        return "list", typing.get_args(hint)[0]
    if hint in (str, float, int, bool):
        return hint.__name__, hint
    if dataclasses.is_dataclass(hint) and not inspect.isabstract(hint):
        return "spec", hint
    return "manual", hint


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

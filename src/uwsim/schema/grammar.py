"""The grammar of a spec: a table of its fields, made from the declarations in the dataclass."""

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

from .declaration import XmlOptions
from .names import NAMESPACE, prefixed_name

MAX_DISTANCE = 1e6
"""The greatest length that a scene needs [m]."""
MAX_NUMBER = 1e9
"""The greatest magnitude of a number, in any unit; a larger one is in the wrong unit."""

QUANTITIES = ("float", "int", "triple", "numbers")
"""The kinds of a `Field` that can have limits and a unit."""

Numbers = Annotated[tuple[float, ...], "numbers"]
"""Numbers in the text of one element, separated by blanks."""
TwoNumbers = Annotated[tuple[float, float], "numbers"]
"""Two numbers in the text of one element, separated by blanks."""


_SIGNS: dict[str, tuple[str, Callable[[float, float], bool]]] = {
    "minimum": (">=", operator.ge),
    "exclusive_minimum": (">", operator.gt),
    "maximum": ("<=", operator.le),
    "exclusive_maximum": ("<", operator.lt),
}
"""The sign and comparison of each limit in `Limits`."""


@dataclass(frozen=True)
class Field:
    """One field of a spec, ready to be read, written and documented."""

    name: str
    """The name of the dataclass field."""
    tag: str
    """The qualified name in the file."""
    kind: str
    """The kind of content: str, float, int, bool, word, triple, numbers, list, spec, choice, or
    manual (read by the caller)."""
    type: Any
    """The details of the kind: the type of a scalar or spec, the words of a Literal, the count of
    numbers (0: any), or the table of a choice."""
    is_repeated: bool
    """True if the field is a tuple with any number of values of this kind."""
    is_optional: bool
    """True if None is allowed."""
    xml: XmlOptions
    """The options of `element`."""
    default: Any
    """The default; MISSING for a required field."""
    owner: type
    """The spec that the field belongs to."""
    words: tuple[str, ...] = ()
    """The words that may replace the elements of a triple."""
    is_member: bool = False
    """True if the field is one child of an unnamed choice: those values of the choice that are of
    its ``type``."""

    @property
    def label(self) -> str:
        """The name as a user writes it."""
        return prefixed_name(self.tag)

    def value_in(self, spec: object) -> Any:
        """Return the value of the field in a spec."""
        value = getattr(spec, self.name)
        if not self.is_member:
            return value
        members = tuple(member for member in value if isinstance(member, self.type))
        return members if self.is_repeated else next(iter(members), None)

    @property
    def doc(self) -> str:
        """The documentation string; for a member, the first line of its spec or spec's module."""
        if self.is_member:
            _, colon, meaning = (self.type.__doc__ or "").split("\n")[0].partition(": ")
            module = sys.modules[self.type.__module__].__doc__ or ""
            line = meaning if colon else module.split("\n")[0]
            return line[:1].upper() + line[1:]
        return field_docs(self.owner).get(self.name, "")

    @property
    def unit(self) -> str:
        """The unit, from the brackets of the documentation string; may be empty."""
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
        """Return whether a number is within the limits."""
        return all(is_satisfied(value, limit) for _, limit, is_satisfied in self._limits())

    def _limits(self) -> Iterator[tuple[str, float, Callable[[float, float], bool]]]:
        limits = cast(Mapping[str, float], self.xml.limits)
        for name, (sign, is_satisfied) in _SIGNS.items():
            if name in limits:
                yield sign, limits[name], is_satisfied


def camel_case(name: str) -> str:
    """Convert a name from snake case to camel case: ``relative_to`` to ``relativeTo``."""
    first_word, *other_words = name.split("_")
    return first_word + "".join(word.capitalize() for word in other_words)


def fields_of(cls: type) -> tuple[Field, ...]:
    """Return the fields of a spec in the order in which the original expects the elements."""
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
    """Yield the members of an unnamed choice, or any other field itself."""
    if field.kind != "choice" or field.xml.name != "":
        yield field
        return
    for tag, spec in field.type.items():
        occurs_once = getattr(spec, "OCCURS_ONCE", False)
        yield dataclasses.replace(
            field,
            tag=tag,
            kind="spec",
            type=spec,
            is_repeated=not occurs_once,
            is_optional=occurs_once,
            xml=XmlOptions(namespaced=tag.startswith("{")),
            default=None if occurs_once else (),
            is_member=True,
        )


def _field(cls: type, field: dataclasses.Field[Any], hint: Any) -> Field:
    xml: XmlOptions = field.metadata.get("xml") or XmlOptions()
    tag = camel_case(field.name) if xml.name is None else xml.name
    if xml.namespaced:
        tag = f"{{{NAMESPACE}}}{tag}"
    default: Any = field.default
    if field.default_factory is not MISSING:
        default = field.default_factory()
    is_optional, is_repeated = False, False
    words: tuple[str, ...] = ()
    if typing.get_origin(hint) in (typing.Union, types.UnionType):
        alternatives = [arg for arg in typing.get_args(hint) if arg is not type(None)]
        is_optional, hint = len(alternatives) < len(typing.get_args(hint)), alternatives[0]
        words = tuple(
            word for alternative in alternatives[1:] for word in typing.get_args(alternative)
        )
    if _is_variadic(hint):
        is_repeated, hint = True, typing.get_args(hint)[0]
    kind, type_ = _kind(hint, xml)
    return Field(field.name, tag, kind, type_, is_repeated, is_optional, xml, default, cls, words)


def _is_variadic(hint: Any) -> bool:
    return typing.get_origin(hint) is tuple and typing.get_args(hint)[-1] is Ellipsis


def _kind(hint: Any, xml: XmlOptions) -> tuple[str, Any]:
    if xml.choice is not None:
        return "choice", xml.choice
    if typing.get_origin(hint) is Literal:
        return "word", typing.get_args(hint)
    if hint in (Numbers, TwoNumbers):
        return "numbers", 0 if hint == Numbers else 2
    if hint == tuple[float, float, float]:
        return "triple", float
    if _is_variadic(hint) and xml.item:  # a list that is repeated: tuple[tuple[float, ...], ...]
        return "list", typing.get_args(hint)[0]
    if hint in (str, float, int, bool):
        return hint.__name__, hint
    if dataclasses.is_dataclass(hint) and not inspect.isabstract(hint):
        return "spec", hint
    return "manual", hint


@functools.cache
def field_docs(cls: type) -> dict[str, str]:
    """Return the documentation string under each field of a spec, including inherited fields."""
    docs: dict[str, str] = {}
    for base in reversed(cls.__mro__):
        if not dataclasses.is_dataclass(base):
            continue
        try:
            source = textwrap.dedent(inspect.getsource(base))
        except (OSError, TypeError):
            continue
        body = cast(ast.ClassDef, ast.parse(source).body[0]).body
        for statement, next_statement in itertools.pairwise(body):
            if (
                isinstance(statement, ast.AnnAssign)
                and isinstance(statement.target, ast.Name)
                and isinstance(next_statement, ast.Expr)
                and isinstance(next_statement.value, ast.Constant)
            ):
                docs[statement.target.id] = inspect.cleandoc(str(next_statement.value.value))
    return docs

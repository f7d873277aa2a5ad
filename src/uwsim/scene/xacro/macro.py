"""Macros: their parameters, and the values that a call gives them."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from lxml import etree

from ...errors import did_you_mean
from .scope import Scope, literal_of
from .value import ExpressionError, Value

PARAMETER = re.compile(
    r"(?P<stars>\*{0,2})(?P<name>[A-Za-z_][\w.-]*)"
    r"(?:\s*(?P<colon>:?=)\s*(?P<outer>\^\|?)?"
    r"(?P<default>\$\{[^{}]*\}|\$\([^()]*\)|(?:'[^']*'|\"[^\"]*\"|[^\s'\"])*|\S*))?(?=\s|$)"
)
"""A parameter; its default may be texts in quotes and without, one after the other."""
COMMAS = re.compile(r"\s*\w+\s*(,\s*\w+\s*)+")
"""Names with commas between them, which xacro takes for parts of the names."""


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """A parameter of a macro: ``name``, ``name:=default``, ``name:=^|default``, ``*block``.

    The bar may be missing.
    """

    name: str
    default: str | None = None
    """Text that is used without a value; None: there must be one."""
    is_from_outside: bool = False
    """Whether, without a value, a property of that name where the macro is called is used."""
    stars: int = 0
    """1: the next element of the call; 2: what is in it."""


@dataclass(frozen=True, eq=False)
class Macro:
    """A macro, and the file in which it is defined."""

    name: str
    parameters: tuple[Parameter, ...]
    body: etree._Element
    file: str

    def bind(
        self, texts: Mapping[str, str], elements: Sequence[etree._Element], call: Scope
    ) -> Scope:
        """Return the scope of a call: each parameter with its value.

        Args:
            texts: the attributes of the call.
            elements: its elements, expanded.
            call: the scope in which it is called.

        Raises:
            ExpressionError: a parameter lacks its value, or there is none for a value.
        """
        inner, given = call.inner(), dict(texts)
        blocks = [each for each in elements if isinstance(each.tag, str)]
        for parameter in self.parameters:
            if not parameter.stars:
                inner.set_value(parameter.name, self._value(parameter, given, call))
            elif blocks:
                block = blocks.pop(0)
                inner.blocks[parameter.name] = [block] if parameter.stars == 1 else list(block)
            else:
                raise ExpressionError(f"<xacro:{self.name}> lacks its block {parameter.name!r}")
        if given:
            name = next(iter(given))
            near = did_you_mean(name, [each.name for each in self.parameters])
            raise ExpressionError(f"<xacro:{self.name}> has no parameter {name[:60]!r}.{near}")
        if blocks:
            raise ExpressionError(f"<xacro:{self.name}> has a block too many")
        return inner

    def _value(self, parameter: Parameter, given: dict[str, str], call: Scope) -> Value:
        """Take the value of a parameter out of the given ones, or its default."""
        text = given.pop(parameter.name, None)
        if text is None and parameter.is_from_outside and call.has(parameter.name):
            return call.value(parameter.name)
        if text is None:
            text = parameter.default
        if text is None:
            raise ExpressionError(f"<xacro:{self.name}> lacks its parameter {parameter.name!r}")
        return literal_of(call.text(text))


def parameters_of(text: str) -> tuple[Parameter, ...]:
    """Read the attribute ``params`` of a macro.

    Raises:
        ExpressionError: something in it is no parameter, or there are two of one name.
    """
    parameters: dict[str, Parameter] = {}
    last = 0
    text = text.replace(",", " ") if COMMAS.fullmatch(text) else text
    for found in PARAMETER.finditer(text):
        if text[last : found.start()].strip():
            break
        last = found.end()
        name, default = found["name"], found["default"]
        if name in parameters:
            raise ExpressionError(f"two parameters are called {name!r}")
        if default and default[0] == default[-1] and default[0] in "'\"":
            default = default[1:-1]
        is_from_outside = found["outer"] is not None
        has_default = found["colon"] is not None and bool(default or found["outer"] != "^")
        parameters[name] = Parameter(
            name=name,
            default=(default or "") if has_default else None,
            is_from_outside=is_from_outside,
            stars=len(found["stars"]),
        )
    if rest := text[last:].strip():
        raise ExpressionError(f"{rest[:40]!r} in params is no parameter, such as name or name:=1")
    return tuple(parameters.values())

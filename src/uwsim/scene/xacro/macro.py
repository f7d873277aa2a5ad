"""Macros, and the binding of their parameters to the values of a call."""

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
"""The pattern of a parameter, whose default may mix quoted and unquoted texts."""
COMMAS = re.compile(r"\s*\w+\s*(,\s*\w+\s*)+")
"""The pattern of names separated by commas, which the xacro of ROS reads as part of the names."""


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """A parameter of a macro: ``name``, ``name:=default``, ``name:=^|default``, ``*block``.

    The bar after ``^`` is optional.
    """

    name: str
    default: str | None = None
    """The default text; None: a value is required."""
    uses_caller: bool = False
    """True if the caller's property with this name is used when a call gives no value (``^``)."""
    stars: int = 0
    """The number of stars. 1: the parameter is a block, the next element of the call; 2: it is the
    content of that element; 0: it is no block."""


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
        """Return the scope of a call, in which each parameter has its value.

        Args:
            texts: the attributes of the call.
            elements: the expanded child elements of the call.
            call: the scope of the caller.

        Raises:
            ExpressionError: a parameter has no value, or a value has no parameter.
        """
        call_scope, arguments = call.nested_scope(), dict(texts)
        blocks = [element for element in elements if isinstance(element.tag, str)]
        for parameter in self.parameters:
            if not parameter.stars:
                call_scope.set_value(parameter.name, self._value(parameter, arguments, call))
            elif blocks:
                block = blocks.pop(0)
                call_scope.blocks[parameter.name] = [block] if parameter.stars == 1 else list(block)
            else:
                raise ExpressionError(f"<xacro:{self.name}> lacks its block {parameter.name!r}")
        if arguments:
            name = next(iter(arguments))
            suggestion = did_you_mean(name, [element.name for element in self.parameters])
            message = f"<xacro:{self.name}> has no parameter {name[:60]!r}."
            raise ExpressionError(f"{message}{suggestion}")
        if blocks:
            raise ExpressionError(f"<xacro:{self.name}> has too many blocks")
        return call_scope

    def _value(self, parameter: Parameter, arguments: dict[str, str], call: Scope) -> Value:
        """Remove the value of a parameter from the arguments and return it, or its default."""
        text = arguments.pop(parameter.name, None)
        if text is None and parameter.uses_caller and call.has_name(parameter.name):
            return call.value(parameter.name)
        if text is None:
            text = parameter.default
        if text is None:
            raise ExpressionError(f"<xacro:{self.name}> lacks its parameter {parameter.name!r}")
        return literal_of(call.text(text))


def parameters_of(text: str) -> tuple[Parameter, ...]:
    """Read the attribute ``params`` of a macro.

    Raises:
        ExpressionError: a part of the text is not a parameter, or two parameters share a name.
    """
    parameters: dict[str, Parameter] = {}
    position = 0
    text = text.replace(",", " ") if COMMAS.fullmatch(text) else text
    for match in PARAMETER.finditer(text):
        if text[position : match.start()].strip():
            break
        position = match.end()
        name, default = match["name"], match["default"]
        if name in parameters:
            raise ExpressionError(f"two parameters are called {name!r}")
        if default and default[0] == default[-1] and default[0] in "'\"":
            default = default[1:-1]
        uses_caller = match["outer"] is not None
        has_default = match["colon"] is not None and bool(default or match["outer"] != "^")
        parameters[name] = Parameter(
            name=name,
            default=(default or "") if has_default else None,
            uses_caller=uses_caller,
            stars=len(match["stars"]),
        )
    if rest := text[position:].strip():
        raise ExpressionError(f"{rest[:40]!r} in params is no parameter, such as name or name:=1")
    return tuple(parameters.values())

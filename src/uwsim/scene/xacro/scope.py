"""Scopes of names: properties, parameters and blocks of macros, with their values."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from ...errors import did_you_mean
from .expression import CONSTANTS, Functions, evaluate, parse_literal
from .value import MAX_LENGTH, ExpressionError, Value, to_text

if TYPE_CHECKING:
    from lxml import etree

MAX_DEPTH = 60
"""The greatest length of a chain of properties that refer to one another."""
PART = re.compile(r"\$\$(?=[{(])|\$\{[^{}]*\}|\$\((?:[^()$]|\$\{[^{}]*\}|\([^()]*\))*\)|\$")
"""The pattern of an escaped dollar, an expression, a substitution, or a literal dollar."""


class Scope:
    """A scope: values by name; other names are resolved in the enclosing scope.

    A property is evaluated when it is used, so that it may refer to properties defined later.

    Args:
        parent: the enclosing scope; None for the scope of the file.
        substitute: the function that returns the text for the content of a ``$(...)``.
        functions: the functions that expressions may call, by name.
    """

    def __init__(
        self, parent: Scope | None, substitute: Callable[[str], str], functions: Functions
    ) -> None:
        self._parent, self._substitute, self._functions = parent, substitute, functions
        self._texts: dict[str, str] = {}
        self._values: dict[str, Value] = {}
        self._active_names: list[str] = []
        self.blocks: dict[str, Sequence[etree._Element]] = {}
        """The blocks by name."""

    def nested_scope(self) -> Scope:
        """Return a new scope within this one."""
        return Scope(self, self._substitute, self._functions)

    @property
    def parent(self) -> Scope:
        """The enclosing scope; the scope of the file is its own parent."""
        return self._parent or self

    @property
    def file_scope(self) -> Scope:
        """The scope of the file."""
        return self if self._parent is None else self._parent.file_scope

    def set_text(self, name: str, text: str) -> None:
        """Set a property to a text that is evaluated when it is used."""
        self._values.pop(name, None)
        self._texts[name] = text

    def set_value(self, name: str, value: Value) -> None:
        """Set a property or parameter to a value."""
        self._texts.pop(name, None)
        self._values[name] = value

    def remove(self, name: str) -> None:
        """Remove a property here and in all enclosing scopes."""
        self._texts.pop(name, None)
        self._values.pop(name, None)
        if self._parent is not None:
            self._parent.remove(name)

    def has_name(self, name: str) -> bool:
        """Return whether a property or parameter with this name exists."""
        return (
            name in self._values
            or name in self._texts
            or (self._parent is not None and self._parent.has_name(name))
        )

    def value(self, name: str) -> Value:
        """Return the value of a property or parameter; raises ExpressionError."""
        if name in self._values:
            return self._values[name]
        if name in self._texts:
            return self._evaluate(name)
        if self._parent is not None:
            return self._parent.value(name)
        if name in CONSTANTS:
            return CONSTANTS[name]
        names = [*self._values, *self._texts, *CONSTANTS]
        raise ExpressionError(f"no property is called {name!r}.{did_you_mean(name, names)}")

    def _evaluate(self, name: str) -> Value:
        if len(self._active_names) >= MAX_DEPTH:
            raise ExpressionError(f"the property {name!r} ends a chain of over {MAX_DEPTH} others")
        if name in self._active_names:
            chain = " -> ".join([*self._active_names[-4:], name])
            raise ExpressionError(
                f"the property {name!r} refers to itself: {chain}; "
                'lazy_eval="false" evaluates it where it is defined'
            )
        self._active_names.append(name)
        try:
            value = self._values[name] = literal_of(self.text(self._texts[name]))
        finally:
            self._active_names.pop()
        del self._texts[name]
        return value

    def block(self, name: str) -> Sequence[etree._Element] | None:
        """Return the elements of a block; None if there is no such block."""
        if name in self.blocks:
            return self.blocks[name]
        return None if self._parent is None else self._parent.block(name)

    def text(self, text: str) -> Value:
        """Evaluate every ``${...}`` and ``$(...)`` in a text; return the value of a single one."""
        parts: list[Value] = []
        position = 0
        for match in PART.finditer(text):
            if match.start() > position:
                parts.append(text[position : match.start()])
            parts.append(self._part(match[0]))
            position = match.end()
        if position < len(text):
            parts.append(text[position:])
        if len(parts) == 1:
            return parts[0]
        result = "".join(map(to_text, parts))
        if len(result) > max(MAX_LENGTH, len(text)):
            raise ExpressionError(f"the text is longer than {MAX_LENGTH} characters")
        return result

    def _part(self, part: str) -> Value:
        if part.startswith("${"):
            content = part[2:-1]
            if "$(" in content:  # as in ROS, the substituted text is part of the expression
                content = to_text(self.text(content))
            return evaluate(content, self.value, self._functions)
        if part.startswith("$("):
            content = part[2:-1]
            return self._substitute(to_text(self.text(content)) if "${" in content else content)
        return "$"


def literal_of(value: Value) -> Value:
    """Convert a text that is a number, truth value or quoted text; return others unchanged."""
    return parse_literal(value) if isinstance(value, str) else value

"""Names and their values: properties, parameters and blocks of macros, one scope within another."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from ...errors import did_you_mean
from .expression import CONSTANTS, Functions, evaluate, literal
from .value import MAX_LENGTH, ExpressionError, Value, written

if TYPE_CHECKING:
    from lxml import etree

MAX_DEPTH = 60
"""Most properties that may refer to one another in a chain."""
PART = re.compile(r"\$\$(?=[{(])|\$\{[^{}]*\}|\$\((?:[^()$]|\$\{[^{}]*\}|\([^()]*\))*\)|\$")
"""An escaped dollar, an expression, a substitution, or a dollar that is one."""


class Scope:
    """Values by name; what is not here is looked for in the scope around it.

    A property is evaluated when it is used, so that it may refer to later ones.

    Args:
        around: the scope around it.
        substitute: returns the text of ``$(...)``, without its brackets.
        functions: the functions that expressions may call, by their names.
    """

    def __init__(
        self, around: Scope | None, substitute: Callable[[str], str], functions: Functions
    ) -> None:
        self._around, self._substitute, self._functions = around, substitute, functions
        self._texts: dict[str, str] = {}
        self._values: dict[str, Value] = {}
        self._busy: list[str] = []
        self.blocks: dict[str, Sequence[etree._Element]] = {}
        """Blocks by name."""

    def inner(self) -> Scope:
        """Return a scope within this one."""
        return Scope(self, self._substitute, self._functions)

    @property
    def around(self) -> Scope:
        """The scope around it; itself if it is the outermost."""
        return self._around or self

    @property
    def outermost(self) -> Scope:
        """The scope of the file."""
        return self if self._around is None else self._around.outermost

    def set_text(self, name: str, text: str) -> None:
        """Set a property; its text is evaluated when it is used."""
        self._values.pop(name, None)
        self._texts[name] = text

    def set_value(self, name: str, value: Value) -> None:
        """Set a property or parameter."""
        self._texts.pop(name, None)
        self._values[name] = value

    def remove(self, name: str) -> None:
        """Remove a property here and in all scopes around."""
        self._texts.pop(name, None)
        self._values.pop(name, None)
        if self._around is not None:
            self._around.remove(name)

    def has(self, name: str) -> bool:
        """Whether there is a property or parameter of that name."""
        return (
            name in self._values
            or name in self._texts
            or (self._around is not None and self._around.has(name))
        )

    def value(self, name: str) -> Value:
        """Return the value of a property or parameter; raises ExpressionError."""
        if name in self._values:
            return self._values[name]
        if name in self._texts:
            return self._evaluated(name)
        if self._around is not None:
            return self._around.value(name)
        if name in CONSTANTS:
            return CONSTANTS[name]
        known = [*self._values, *self._texts, *CONSTANTS]
        raise ExpressionError(f"no property is called {name!r}.{did_you_mean(name, known)}")

    def _evaluated(self, name: str) -> Value:
        if name in self._busy or len(self._busy) >= MAX_DEPTH:
            chain = " -> ".join([*self._busy[-4:], name])
            raise ExpressionError(
                f"the property {name!r} is defined by itself: {chain}; "
                'lazy_eval="false" evaluates it where it is defined'
            )
        self._busy.append(name)
        try:
            value = self._values[name] = literal_of(self.text(self._texts[name]))
        finally:
            self._busy.pop()
        del self._texts[name]
        return value

    def block(self, name: str) -> Sequence[etree._Element] | None:
        """Return the elements of a block; None if there is none of that name."""
        if name in self.blocks:
            return self.blocks[name]
        return None if self._around is None else self._around.block(name)

    def text(self, text: str) -> Value:
        """Evaluate every ``${...}`` and ``$(...)`` of a text; one alone keeps its type."""
        parts: list[Value] = []
        last = 0
        for found in PART.finditer(text):
            if found.start() > last:
                parts.append(text[last : found.start()])
            parts.append(self._part(found[0]))
            last = found.end()
        if last < len(text):
            parts.append(text[last:])
        if len(parts) == 1:
            return parts[0]
        whole = "".join(map(written, parts))
        if len(whole) > max(MAX_LENGTH, len(text)):
            raise ExpressionError(f"gives a text longer than {MAX_LENGTH} characters")
        return whole

    def _part(self, part: str) -> Value:
        if part.startswith("${"):
            inner = part[2:-1]
            if "$(" in inner:  # as in ROS, what is substituted is part of the expression
                inner = written(self.text(inner))
            return evaluate(inner, self.value, self._functions)
        if part.startswith("$("):
            inner = part[2:-1]
            return self._substitute(written(self.text(inner)) if "${" in inner else inner)
        return "$"


def literal_of(value: Value) -> Value:
    """Return a text as the number that it is; other values as they are."""
    return literal(value) if isinstance(value, str) else value

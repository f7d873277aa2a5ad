"""Substitution of ``$(...)``: arguments, packages, environment variables, folder of the file."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from ...errors import did_you_mean
from .expression import CONSTANTS, evaluate
from .functions import FUNCTIONS
from .scope import literal_of
from .value import ExpressionError, Value, to_text


class Arguments:
    """The values of ``<xacro:arg>`` by name: from the caller, or the defaults in the files.

    Args:
        values: the values from the caller.
    """

    def __init__(self, values: Mapping[str, str]) -> None:
        self._values = dict(values)
        self._names: set[str] = set()

    @property
    def names(self) -> tuple[str, ...]:
        """The names that files declare or use, sorted."""
        return tuple(sorted(self._names))

    def declare(self, name: str, default: str | None) -> None:
        """Add an argument; the default applies if the caller gives no value."""
        self._names.add(name)
        if default is not None:
            self._values.setdefault(name, default)

    def value(self, name: str) -> str:
        """Return the value of an argument; raises ExpressionError."""
        self._names.add(name)
        if name not in self._values:
            suggestion = did_you_mean(name, self._values)
            raise ExpressionError(
                f"$(arg {name[:60]}): there is no such <xacro:arg> with a value.{suggestion} "
                "--xacro NAME:=VALUE sets it"
            )
        return self._values[name]


def substitute(text: str, arguments: Arguments, file: Path) -> str:
    """Return the text that replaces ``$(text)`` in a file.

    Args:
        text: the content of the parentheses.
        arguments: the values of ``<xacro:arg>``.
        file: the path of the file.

    Raises:
        ExpressionError: the substitution is unknown, or not supported.
    """
    words = text.split()
    match words:
        case ["arg", name]:
            return arguments.value(name)
        case ["find", package]:
            return f"package://{package}"
        case ["dirname"]:
            return str(file.parent)
        case ["optenv", name, *default]:
            return os.environ.get(name, " ".join(default))
        case ["eval", _, *_]:
            return _evaluate(text.strip().removeprefix("eval"), arguments)
        case ["env" | "anon" | "cwd", *_]:
            raise ExpressionError(
                f"$({words[0]} ...) is not supported, as a scene consists of its files only; "
                "expected $(optenv NAME DEFAULT) or $(arg NAME)"
            )
    raise ExpressionError(
        f"$({text[:60]}) is unknown; expected $(arg NAME), $(find PACKAGE), $(dirname), "
        "$(optenv NAME DEFAULT) or $(eval EXPRESSION)"
    )


def _evaluate(expression: str, arguments: Arguments) -> str:
    def resolve(name: str) -> Value:
        return CONSTANTS[name] if name in CONSTANTS else literal_of(arguments.value(name))

    def arg(name: str) -> Value:
        return literal_of(arguments.value(name))

    def find(package: str) -> str:
        return f"package://{package}"

    return to_text(evaluate(expression, resolve, {**FUNCTIONS, "arg": arg, "find": find}))

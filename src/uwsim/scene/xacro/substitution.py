"""Substitution of ``$(...)``: arguments, packages, variables, and the folder of the file."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from ...errors import did_you_mean
from .expression import CONSTANTS, evaluate
from .functions import FUNCTIONS
from .scope import literal_of
from .value import ExpressionError, Value, written


class Arguments:
    """The values of ``<xacro:arg>`` by name: from outside, else the defaults of the files.

    Args:
        given: values from outside.
    """

    def __init__(self, given: Mapping[str, str]) -> None:
        self._values = dict(given)
        self._known: set[str] = set()

    @property
    def known(self) -> tuple[str, ...]:
        """Names that files declare or use, sorted."""
        return tuple(sorted(self._known))

    def declare(self, name: str, default: str | None) -> None:
        """Add an argument; a default counts without a value from outside."""
        self._known.add(name)
        if default is not None:
            self._values.setdefault(name, default)

    def value(self, name: str) -> str:
        """Return the value of an argument; raises ExpressionError."""
        self._known.add(name)
        if name not in self._values:
            near = did_you_mean(name, self._values)
            raise ExpressionError(
                f"$(arg {name[:60]}): there is no such <xacro:arg> with a value.{near} "
                "--xacro NAME:=VALUE gives one"
            )
        return self._values[name]


def substituted(text: str, arguments: Arguments, file: Path) -> str:
    """Return what ``$(text)`` stands for in a file.

    Raises:
        ExpressionError: it is unknown, or not supported.
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
            return _evaluated(text.strip().removeprefix("eval"), arguments)
        case ["env" | "anon" | "cwd", *_]:
            raise ExpressionError(
                f"$({words[0]} ...) is not supported: a scene consists of its files alone; "
                "$(optenv NAME DEFAULT) and $(arg NAME) are"
            )
    raise ExpressionError(
        f"$({text[:60]}) is unknown; expected $(arg NAME), $(find PACKAGE), $(dirname), "
        "$(optenv NAME DEFAULT) or $(eval EXPRESSION)"
    )


def _evaluated(expression: str, arguments: Arguments) -> str:
    """Return the value of an expression over the arguments, as text."""

    def look_up(name: str) -> Value:
        return CONSTANTS[name] if name in CONSTANTS else literal_of(arguments.value(name))

    def arg(name: str) -> Value:
        return literal_of(arguments.value(name))

    def find(package: str) -> str:
        return f"package://{package}"

    return written(evaluate(expression, look_up, {**FUNCTIONS, "arg": arg, "find": find}))

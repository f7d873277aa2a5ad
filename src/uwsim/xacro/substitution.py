"""Substitution of ``$(...)``: arguments, packages, variables, and the folder of the file."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from ..errors import did_you_mean
from .expression import CONSTANTS, evaluate
from .functions import FUNCTIONS
from .scope import literal_of
from .value import ExpressionError, Value, written


def substituted(text: str, arguments: Mapping[str, str], file: Path) -> str:
    """Return what ``$(text)`` stands for in a file.

    Raises:
        ExpressionError: it is unknown, or not supported.
    """
    words = text.split()
    match words:
        case ["arg", name]:
            return argument(name, arguments)
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


def argument(name: str, arguments: Mapping[str, str]) -> str:
    """Return the value of an argument; raises ExpressionError."""
    if name not in arguments:
        near = did_you_mean(name, arguments)
        raise ExpressionError(f"$(arg {name[:60]}): there is no such <xacro:arg>.{near}")
    return arguments[name]


def _evaluated(expression: str, arguments: Mapping[str, str]) -> str:
    """Return the value of an expression over the arguments, as text."""

    def look_up(name: str) -> Value:
        return CONSTANTS[name] if name in CONSTANTS else literal_of(argument(name, arguments))

    def arg(name: str) -> Value:
        return literal_of(argument(name, arguments))

    def find(package: str) -> str:
        return f"package://{package}"

    return written(evaluate(expression, look_up, {**FUNCTIONS, "arg": arg, "find": find}))

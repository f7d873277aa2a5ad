"""Substitution of ``$(...)``: arguments, packages, and the folder of the file."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ..errors import did_you_mean
from .expression import ExpressionError


def substituted(text: str, arguments: Mapping[str, str], file: Path) -> str:
    """Return what ``$(text)`` stands for in a file.

    Raises:
        ExpressionError: it is unknown, or not supported.
    """
    words = text.split()
    match words:
        case ["arg", name]:
            if name not in arguments:
                near = did_you_mean(name, arguments)
                raise ExpressionError(f"$(arg {name[:60]}): there is no such <xacro:arg>.{near}")
            return arguments[name]
        case ["find", package]:
            return f"package://{package}"
        case ["dirname"]:
            return str(file.parent)
        case ["env" | "optenv" | "anon" | "eval" | "cwd", *_]:
            raise ExpressionError(
                f"$({words[0]} ...) is not supported: a scene consists of its files alone"
            )
    raise ExpressionError(
        f"$({text[:60]}) is unknown; expected $(arg NAME), $(find PACKAGE) or $(dirname)"
    )

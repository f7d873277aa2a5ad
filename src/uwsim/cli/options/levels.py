"""Functions that read the values of ``--level``, such as ``fog=0.5``."""

from __future__ import annotations

from collections.abc import Sequence

from ...errors import BadSetting, ErrorCollector
from ...runs.planning.option_values import number_or_text, split


def read_levels(texts: Sequence[str] | None, errors: ErrorCollector) -> list[tuple[str, float]]:
    """Return the name and value of every ``--level``; collect errors."""
    levels = []
    for text in texts or ():
        with errors.collect():
            levels.append(read_level(text))
    return levels


def read_level(text: str) -> tuple[str, float]:
    """Return the name and value of a text such as ``fog=0.5``; raise BadSetting."""
    name, value = split(text, "--level")
    number = number_or_text(value)
    if isinstance(number, str):
        raise BadSetting(f"--level {text!r}: expected a number behind {name!r}.")
    return name, number

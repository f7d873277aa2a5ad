"""Descriptions of the measures of a benchmark: the first lines of their docstrings."""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Iterable

from ..benchmark.measures import Measure, MeasureSpec
from ..results.measures_file import MeasureNote

MATH = re.compile(r":math:`([^`]*)`")
CODE = re.compile(r"``?([^`]*)``?")
SIGNS = (
    (r"\lVert ", "‖"), (r" \rVert", "‖"), (r"\lVert", "‖"), (r"\rVert", "‖"),
    ("^2", "²"), ("^3", "³"), (r"\,", " "),
)  # fmt: skip
"""TeX commands, and the characters that replace them in plain text."""
ROOT = re.compile(r"\\sqrt\{([^{}]*)\}")


def notes_of(specs: Iterable[MeasureSpec]) -> dict[str, MeasureNote]:
    """Return the note of each measure, by its name."""
    return {spec.name: MeasureNote(meaning=meaning_of(spec), value=spec.value) for spec in specs}


def meaning_of(spec: MeasureSpec) -> str:
    """Return the first line of the docstring of a measure, as a phrase inside a sentence."""
    doc = inspect.getdoc(live_class(spec) or type(spec)) or ""
    line = plain_text(doc.strip().split("\n\n")[0].replace("\n", " ")).rstrip(".")
    return line[:1].lower() + line[1:] if line[1:2].islower() or line[1:2] == " " else line


def live_class(spec: MeasureSpec) -> type[Measure] | None:
    """Return the class that ``bind`` returns, by its annotation; None without annotation."""
    function = type(spec).bind
    name = str(function.__annotations__.get("return", "")).strip("'\"")
    cls = vars(sys.modules[function.__module__]).get(name) if name.isidentifier() else None
    if cls is None:
        cls = function.__annotations__.get("return")
    is_live = isinstance(cls, type) and issubclass(cls, Measure) and cls is not Measure
    return cls if is_live else None


def plain_text(text: str) -> str:
    """Return a line of a docstring without the markup of code and mathematics."""
    return CODE.sub(r"\1", MATH.sub(lambda match: _strip_tex(match[1]), text))


def _strip_tex(formula: str) -> str:
    for sign, plain_sign in SIGNS:
        formula = formula.replace(sign, plain_sign)
    return re.sub(r"\\(\w+)", r"\1", ROOT.sub(r"√(\1)", formula)).replace("_", "")

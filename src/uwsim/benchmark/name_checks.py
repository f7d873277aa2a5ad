"""Checks of the names of measures, and of the function that is made of them."""

from __future__ import annotations

import textwrap

from lxml import etree

from ..base import expression
from ..schema import Diagnostics, line_of
from .measures import MeasureSpec
from .spec import FunctionSpec
from .updaters import SceneUpdaterSpec, swept_parameters

RESERVED = ("repeat", "seed", "total", "status", "ended_at")
"""Columns of a result that no measure may be called by."""
MAX_NAME_LENGTH = 100
"""So many letters a measure may be called by."""


def check_names(
    measures: list[MeasureSpec], updater: SceneUpdaterSpec | None, diagnostics: Diagnostics
) -> None:
    """Check that the names of measures are identifiers and unique."""
    columns = () if updater is None else swept_parameters(updater)
    seen: dict[str, MeasureSpec] = {}
    for spec in measures:
        name = spec.name[:60]
        if not (spec.name.isascii() and spec.name.isidentifier()):
            diagnostics.error(
                spec,
                f"the name {name!r} cannot be used in the function; "
                "expected letters, digits and _, no digit first",
            )
        elif len(spec.name) > MAX_NAME_LENGTH:
            diagnostics.error(
                spec,
                f"the name {name!r}... has {len(spec.name)} letters; at most "
                f"{MAX_NAME_LENGTH}, for files are called after it",
            )
        elif spec.name in seen:
            first = line_of(seen[spec.name])
            line = "" if first is None else f" (line {first})"
            diagnostics.error(spec, f"another measure{line} is called {name!r}")
        elif spec.name in RESERVED or spec.name in columns:
            diagnostics.error(spec, f"{name!r} is another column of the result; call it otherwise")
        elif spec.name in expression.CONSTANTS or spec.name in expression.FUNCTIONS:
            kind = "constant" if spec.name in expression.CONSTANTS else "function"
            diagnostics.error(
                spec, f"{name!r} is a {kind} of the language of scores; call it otherwise"
            )
        seen.setdefault(spec.name, spec)


def check_function(
    root: etree._Element,
    function: FunctionSpec,
    measures: list[MeasureSpec],
    diagnostics: Diagnostics,
) -> None:
    """Parse the function; measures with errors of their own count as known."""
    names = [spec.name for spec in measures]
    names += [(name.text or "").strip() for name in root.iterfind("measures/*/name")]
    try:
        expression.parse(function.text, list(dict.fromkeys(names)))
    except expression.ScoreError as error:
        message = textwrap.shorten(error.message, 300, placeholder=" ...")
        diagnostics.error(
            root.find("function"),
            f"<function>: {message} (column {error.column + 1})\n{error.marked_text()}",
        )

"""Checks of the names of measures, and of the score function, whose variables these names are."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

from lxml import etree

from ..base import expression
from ..schema import NAMESPACE, Diagnostics, line_of
from .measures import MeasureSpec, find_outcome_spec
from .spec import FunctionSpec
from .updaters import SceneUpdaterSpec, swept_parameters

RESERVED_NAMES = ("repeat", "seed", "total", "status", "ended_at")
"""The names of other columns of a result, which no measure may have."""
MAX_NAME_LENGTH = 100
"""The greatest number of letters of a measure's name."""


def check_names(
    measures: list[MeasureSpec], updater: SceneUpdaterSpec | None, diagnostics: Diagnostics
) -> None:
    """Report names of measures that are no identifiers, too long, reserved or not unique."""
    columns = () if updater is None else swept_parameters(updater)
    named_specs: dict[str, MeasureSpec] = {}
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
                f"the name {name!r}... has {len(spec.name)} letters; expected at most "
                f"{MAX_NAME_LENGTH}, because files have this name",
            )
        elif spec.name in named_specs:
            first_line = line_of(named_specs[spec.name])
            line = "" if first_line is None else f" (line {first_line})"
            diagnostics.error(spec, f"another measure{line} has the name {name!r}")
        elif spec.name in RESERVED_NAMES or spec.name in columns:
            diagnostics.error(
                spec, f"{name!r} is another column of the result; choose another name"
            )
        elif spec.name in expression.CONSTANTS or spec.name in expression.FUNCTIONS:
            kind = "constant" if spec.name in expression.CONSTANTS else "function"
            diagnostics.error(
                spec, f"{name!r} is a {kind} of the language of scores; choose another name"
            )
        named_specs.setdefault(spec.name, spec)


def check_outcomes(
    root: etree._Element, measures: Sequence[MeasureSpec], diagnostics: Diagnostics
) -> None:
    """Report a second outcome, and names in an outcome that are no measures before it.

    Args:
        root: the ``<benchmark>`` element.
        measures: the measures that were read without an error.
        diagnostics: the list of errors.
    """
    nodes = root.findall(f"measures/{{{NAMESPACE}}}outcome")
    for node in nodes[1:]:
        diagnostics.error(node, "<u:outcome> is given twice; expected one")
    outcome = find_outcome_spec(measures)
    if outcome is None:
        return
    siblings = reversed(list(nodes[0].itersiblings("*", preceding=True)))
    names = [(sibling.findtext("name") or "").strip() for sibling in siblings]
    conditions = [*nodes[0].iterfind("success"), *nodes[0].iterfind("failure/condition")]
    for i, message in outcome.name_errors([name for name in names if name]):
        diagnostics.error(conditions[i], message)


def check_function(
    root: etree._Element,
    function: FunctionSpec,
    measures: list[MeasureSpec],
    diagnostics: Diagnostics,
) -> None:
    """Report errors of the score function.

    Args:
        root: the ``<benchmark>`` element, whose ``<function>`` gets the errors.
        function: the score function as read.
        measures: the measures that were read without an error. The names of the others, taken from
            the file, may occur in the function, too.
        diagnostics: the list of errors.
    """
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

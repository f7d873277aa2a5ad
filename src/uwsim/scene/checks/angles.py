"""Warnings about angles of more than a turn: likely degrees instead of radians.

An angle that is meant is the same within one turn, and can be written so.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Hashable, Iterator, Sequence

from lxml import etree

from ...schema import Diagnostics, fields_of
from ...schema.names import local

MORE_THAN_A_TURN = 6.3
"""Nobody writes a turn with more digits than are needed [rad]."""


def degrees_for_radians(values: Sequence[float]) -> str:
    """Describe angles as if they were degrees; None where none is beyond a turn."""
    if all(abs(value) <= MORE_THAN_A_TURN for value in values):
        return ""
    turned = _list([math.radians(value) for value in values])
    within = _list([math.remainder(value, math.tau) for value in values])
    return (
        f"{_list(values)} in radians, more than a turn; as degrees it would be {turned}, "
        f"else write {within}, which is the same"
    )


def check_angles(spec: object, diagnostics: Diagnostics) -> None:
    """Warn of the angles of a spec and of all specs in it.

    Args:
        spec: of a file.
        diagnostics: receives the warnings; has the elements of the specs.
    """
    kind: type = type(spec)
    for field, shown in _angles(kind):
        value = getattr(spec, field)
        message = degrees_for_radians(value if isinstance(value, tuple) else (value,))
        if message:
            node = diagnostics.node_of(spec)
            place = None if node is None else _child(node, shown)
            diagnostics.warning(place, f"<{shown}> is {message}")
    for part in _parts(spec):
        check_angles(part, diagnostics)


def remember_twins(
    spec: object, written: object, lines: Diagnostics, diagnostics: Diagnostics
) -> None:
    """Give a spec and its parts the elements of another one that was read from the same file.

    Args:
        spec: what was read earlier, and may have been changed by settings.
        written: what is read from its file now.
        lines: remembers the elements of ``written``.
        diagnostics: shall remember them for ``spec``.
    """
    node = lines.node_of(written)
    if node is not None:
        diagnostics.remember(spec, node)
    for part, twin in zip(_parts(spec), _parts(written), strict=False):
        remember_twins(part, twin, lines, diagnostics)


@functools.cache
def _angles(cls: Hashable) -> tuple[tuple[str, str], ...]:
    """The angles of a spec, by field and element; a phase may have any number of turns."""
    assert isinstance(cls, type)
    return tuple(
        (field.name, field.shown)
        for field in fields_of(cls)
        if field.unit == "rad" and not field.repeated and "phase" not in field.name
    )


def _parts(spec: object) -> Iterator[object]:
    kind: type = type(spec)
    for field in _nested(kind):
        held = getattr(spec, field)
        yield from held if isinstance(held, tuple) else () if held is None else (held,)


@functools.cache
def _nested(cls: Hashable) -> tuple[str, ...]:
    assert isinstance(cls, type)
    nested = (field.name for field in fields_of(cls) if field.kind in ("spec", "choice"))
    return tuple(dict.fromkeys(nested))


def _child(node: etree._Element, shown: str) -> etree._Element:
    return next((each for each in node if local(str(each.tag)) == shown), node)


def _list(values: Sequence[float]) -> str:
    return " ".join(f"{value:.5g}" for value in values)

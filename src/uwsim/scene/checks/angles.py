"""Warnings about angles of more than a turn: likely degrees instead of radians.

An angle that is meant is the same within one turn, and can be written so.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Hashable, Iterator, Sequence

from ...schema import Diagnostics, Field, fields_of, line_of

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
        diagnostics: receives the warnings.
    """
    kind: type = type(spec)
    for field in _angles(kind):
        value = field.of(spec)
        message = degrees_for_radians(value if isinstance(value, tuple) else (value,))
        if message:
            diagnostics.warning(line_of(spec, field.tag), f"<{field.shown}> is {message}")
    for part in _parts(spec):
        check_angles(part, diagnostics)


@functools.cache
def _angles(cls: Hashable) -> tuple[Field, ...]:
    """The fields of a spec that are angles; a phase may have any number of turns."""
    assert isinstance(cls, type)
    return tuple(
        field
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


def _list(values: Sequence[float]) -> str:
    return " ".join(f"{value:.5g}" for value in values)

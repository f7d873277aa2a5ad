"""Warnings about angles of more than a turn: likely degrees instead of radians."""

from __future__ import annotations

import functools
from collections.abc import Hashable, Iterator

from ...errors import Diagnostic
from ...scene.angles import describe_degrees
from ...schema import Field, fields_of, line_of
from ..subjects import CheckedScene


def angles_in_degrees(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of the angles of a scene that are beyond a turn."""
    for place, message in _angles_beyond_a_turn(scene.spec):
        yield scene.warning(place, message)


def _angles_beyond_a_turn(spec: object) -> Iterator[tuple[int | None, str]]:
    kind: type = type(spec)
    for field in _angles(kind):
        value = field.value_in(spec)
        message = describe_degrees(value if isinstance(value, tuple) else (value,))
        if message:
            yield line_of(spec, field.tag), f"<{field.label}> is {message}"
    for part in _parts(spec):
        yield from _angles_beyond_a_turn(part)


@functools.cache
def _angles(cls: Hashable) -> tuple[Field, ...]:
    """Return the fields of a spec that are angles; a phase may have any number of turns."""
    assert isinstance(cls, type)
    return tuple(
        field
        for field in fields_of(cls)
        if field.unit == "rad" and not field.is_repeated and "phase" not in field.name
    )


def _parts(spec: object) -> Iterator[object]:
    kind: type = type(spec)
    for field in _nested_fields(kind):
        parts = getattr(spec, field)
        yield from parts if isinstance(parts, tuple) else () if parts is None else (parts,)


@functools.cache
def _nested_fields(cls: Hashable) -> tuple[str, ...]:
    assert isinstance(cls, type)
    names = (field.name for field in fields_of(cls) if field.kind in ("spec", "choice"))
    return tuple(dict.fromkeys(names))

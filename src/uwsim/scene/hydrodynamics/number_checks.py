"""Checks that the numbers of a spec are finite and within the limits of their fields."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

from ...schema import fields_of

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

MAX_LENGTH = 500.0
"""The greatest length on a vehicle, about that of the longest ship [m]."""
LENGTH_FIELDS = ("reference", "centre_of_buoyancy", "size", "centre_of_mass", "position", "radius")
"""The fields with lengths in metres."""


def number_errors(owner: str, spec: DataclassInstance) -> list[str]:
    """Return errors for numbers that are not finite, and for lengths above `MAX_LENGTH`.

    Args:
        owner: the name of the body, thruster or fin in messages.
        spec: the spec of the body, thruster or fin.
    """
    errors = []
    for field in dataclasses.fields(spec):
        numbers = _numbers_of(spec, field.name)
        if not all(math.isfinite(number) for number in numbers):
            errors.append(
                f"{owner}: {field_words(field.name)} is {text_of(numbers)}; expected finite numbers"
            )
        elif field.name in LENGTH_FIELDS and any(abs(number) > MAX_LENGTH for number in numbers):
            errors.append(
                f"{owner}: {field_words(field.name)} is {text_of(numbers)}; expected none beyond "
                f"{MAX_LENGTH:g} (metres, not millimetres) [m]"
            )
    return errors


def limit_errors(owner: str, spec: DataclassInstance) -> list[str]:
    """Return errors for numbers outside the limits that their fields declare."""
    return [
        f"{owner}: {field_words(field.name)} is {text_of(numbers)}; expected {field.expected}"
        for field in fields_of(type(spec))
        if not all(map(field.allows, numbers := _numbers_of(spec, field.name)))
    ]


def _numbers_of(spec: DataclassInstance, field: str) -> list[float]:
    entry = getattr(spec, field)
    values = entry if isinstance(entry, tuple) else (entry,)
    return [number for number in values if isinstance(number, int | float)]


def field_words(name: str) -> str:
    """Return the name of a field as words, such as ``added mass``."""
    return name.replace("_", " ")


def text_of(values: Iterable[float]) -> str:
    """Return numbers as text, separated by spaces."""
    return " ".join(f"{value:g}" for value in values)

"""Checks that the numbers of a record are finite and within the limits of its fields."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

from ...schema import fields_of

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

MAX_LENGTH = 500.0
"""No length or place of a vehicle is beyond that of the longest ship [m]."""
LENGTHS = ("reference", "centre_of_buoyancy", "size", "centre_of_mass", "position", "radius")


def number_errors(who: str, spec: DataclassInstance) -> list[str]:
    """Report numbers that are not finite, and lengths beyond those of any vehicle."""
    errors = []
    for each in dataclasses.fields(spec):
        numbers = _numbers_of(spec, each.name)
        if not all(math.isfinite(number) for number in numbers):
            errors.append(
                f"{who}: {words(each.name)} is {listed(numbers)}; expected finite numbers"
            )
        elif each.name in LENGTHS and any(abs(number) > MAX_LENGTH for number in numbers):
            errors.append(
                f"{who}: {words(each.name)} is {listed(numbers)}; expected none beyond "
                f"{MAX_LENGTH:g} (metres, not millimetres) [m]"
            )
    return errors


def beyond_limits(who: str, spec: DataclassInstance) -> list[str]:
    """Report numbers beyond the limits that their fields declare."""
    return [
        f"{who}: {words(field.name)} is {listed(numbers)}; expected {field.expected}"
        for field in fields_of(type(spec))
        if not all(map(field.allows, numbers := _numbers_of(spec, field.name)))
    ]


def _numbers_of(spec: DataclassInstance, field: str) -> list[float]:
    value = getattr(spec, field)
    values = value if isinstance(value, tuple) else (value,)
    return [one for one in values if isinstance(one, int | float)]


def words(name: str) -> str:
    """A field's name as words."""
    return name.replace("_", " ")


def listed(values: Iterable[float]) -> str:
    """Numbers, separated by blanks."""
    return " ".join(f"{value:g}" for value in values)

"""The numeric fields of messages that a fault of a sensor changes."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from typing import Any

import numpy as np

UNMEASURED_WORDS = ("header", "status", "covariance")
"""The words in the paths of fields that remain unchanged if a fault names no field."""


def numeric_fields(message: Any, prefix: str = "") -> Iterator[str]:
    """Yield the paths of all floating-point fields of a message, numbers and arrays."""
    for field in dataclasses.fields(message):
        value = getattr(message, field.name)
        path = f"{prefix}{field.name}"
        if dataclasses.is_dataclass(value):
            yield from numeric_fields(value, f"{path}.")
        elif isinstance(value, float) or (
            isinstance(value, np.ndarray) and value.dtype.kind == "f"
        ):
            yield path


def measured_fields(message: Any, field: str | None) -> Iterator[str]:
    """Yield the paths of the fields that a fault changes: the named one, or all measured ones."""
    for path in numeric_fields(message):
        if path == field or (field is None and not any(word in path for word in UNMEASURED_WORDS)):
            yield path

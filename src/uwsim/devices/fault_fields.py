"""The numeric fields of messages, which a fault of a sensor changes."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from typing import Any

import numpy as np

UNMEASURED_WORDS = ("header", "status", "covariance")
"""The words of fields that stay unchanged where a fault names no field."""


def numeric_fields(message: Any, prefix: str = "") -> Iterator[str]:
    """Yield the paths of the floating-point numbers of a message, and of arrays of them."""
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
    """Yield the paths that a fault changes: the named one, or all that are measured."""
    for path in numeric_fields(message):
        if path == field or (field is None and not any(word in path for word in UNMEASURED_WORDS)):
            yield path

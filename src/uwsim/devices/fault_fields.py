"""The fields of messages that a fault of a sensor changes: their numbers."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from typing import Any

import numpy as np

NOT_MEASURED = ("header", "status", "covariance")
"""Fields with these words are spared where a fault names none."""


def number_fields(message: Any, before: str = "") -> Iterator[str]:
    """Yield the paths of the floating-point numbers of a message, and of arrays of them."""
    for field in dataclasses.fields(message):
        value = getattr(message, field.name)
        path = f"{before}{field.name}"
        if dataclasses.is_dataclass(value):
            yield from number_fields(value, f"{path}.")
        elif isinstance(value, float) or (
            isinstance(value, np.ndarray) and value.dtype.kind == "f"
        ):
            yield path


def measured_fields(message: Any, wanted: str | None) -> Iterator[str]:
    """Yield the paths that a fault changes: the ``wanted`` one, or all that are measured."""
    for path in number_fields(message):
        if path == wanted or (wanted is None and not any(word in path for word in NOT_MEASURED)):
            yield path

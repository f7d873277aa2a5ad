"""The numbers of a message, by the path of their fields, as ``pose.pose.position.x``."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from numbers import Real
from typing import Any

import numpy as np

MAX_ELEMENTS = 64
"""The greatest number of elements of an array that become columns; longer arrays are left out."""


def read_numbers(message: object) -> dict[str, float]:
    """Return the numbers of a message, without its header, texts, and arrays of many elements."""
    return {name.removeprefix("."): value for name, value in _walk("", message)}


def _walk(path: str, value: Any) -> Iterator[tuple[str, float]]:
    if isinstance(value, bool | np.bool_ | Real):
        yield path, float(value)
    elif dataclasses.is_dataclass(value):
        for field in dataclasses.fields(value):
            if field.name != "header" and not field.name.endswith("covariance"):
                yield from _walk(f"{path}.{field.name}", getattr(value, field.name))
    elif isinstance(value, list | tuple | np.ndarray) and len(value) <= MAX_ELEMENTS:
        for index, element in enumerate(value):
            yield from _walk(f"{path}.{index}", element)

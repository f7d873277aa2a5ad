"""The check that a value can be stored as JSON, and its conversion to immutable sequences."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from numbers import Integral, Real
from typing import Any

from ...errors import ResultError


def checked_values(value: object, path: str) -> Any:
    """Return the value as dicts, tuples, str, bool, int, float or None, with finite numbers.

    Args:
        value: the value.
        path: the path of the value in the document, for error messages.

    Raises:
        ResultError: a value is of another type, or a number is not finite.
    """
    if value is None or isinstance(value, str | bool):
        return value
    if isinstance(value, Mapping):
        return {str(k): checked_values(v, f"{path}.{k}") for k, v in value.items()}
    if isinstance(value, Integral):
        return int(value)
    if isinstance(value, Real):
        if not math.isfinite(value):
            raise ResultError(f"{path} is {float(value)}: a missing value is null.")
        return float(value)
    if isinstance(value, Sequence):
        return tuple(checked_values(v, f"{path}[{i}]") for i, v in enumerate(value))
    raise ResultError(f"{path} is {value!r}; expected text, a number, a list or an object.")

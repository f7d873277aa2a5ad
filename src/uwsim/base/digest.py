"""Hashes of specs (the parsed elements of files)."""

from __future__ import annotations

import dataclasses
import hashlib
from typing import Any

import numpy as np


def digest_of(spec: object) -> str:
    """Return a hash of the values of a spec; it does not depend on the location of its file."""
    return hashlib.sha256(repr(_plain_value(spec)).encode()).hexdigest()


def _plain_value(value: Any) -> object:
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        fields = [field.name for field in dataclasses.fields(value) if field.compare]
        return type(value).__name__, [(name, _plain_value(getattr(value, name))) for name in fields]
    if isinstance(value, list | tuple):
        return [_plain_value(entry) for entry in value]
    return value.tolist() if isinstance(value, np.ndarray) else value

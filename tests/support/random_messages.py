"""Random messages of any type: each field has its defined type, and values that peers may send."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Sequence
from typing import Any

import numpy as np

from uwsim.base.message_fields import _class_in, _definition

EXTREMES = [
    *(0.0, -0.0, 1.0, -1.0, 1e-3, 1e3, 1e6, -1e6, 1e9, -1e9, 1e12, -1e12, 1e-162, 1e-200),
    *(5e-324, 1e155, 1e200, 1.79e308, -1.79e308, float("nan"), float("inf"), -float("inf")),
]
INTEGERS = [0, 1, 2, 3, 4, 5, 8, 9, 11, 255, 65535, 2**31 - 1, -1, -(2**31), 2**32 - 1]
LENGTHS = [0, 1, 2, 3, 4, 6, 8, 9, 36, 768]


class RandomMessages:
    """Messages from a seed.

    Args:
        seed: the seed of the random numbers.
        words: texts that messages contain, besides random ones: names of the scene.
    """

    def __init__(self, seed: int, words: Sequence[str]) -> None:
        self.rng = np.random.default_rng(seed)
        self._words = words

    def message(self, cls: type) -> Any:
        """Return a message of a class."""
        kinds = {name: (kind, element_type) for name, kind, element_type in _definition(cls)}
        values = {
            field.name: self._value(cls, str(field.type), *kinds[field.name])
            for field in dataclasses.fields(cls)
            if field.init and field.name in kinds
        }
        return cls(**values)

    def number(self) -> float:
        """Return a number: an extreme one, or a usual one."""
        if self.rng.random() < 0.6:
            return float(self.rng.choice(EXTREMES))
        return float(self.rng.normal())

    def _value(self, cls: type, declared_type: str, kind: str, element_type: str) -> Any:
        if kind == "float":
            return self.number()
        if kind == "int":
            return int(self.rng.choice(INTEGERS))
        if kind == "bool":
            return bool(self.rng.random() < 0.5)
        if kind == "str":
            return self._text()
        if kind == "array":
            return self._array(np.dtype(element_type))
        if kind == "list" and element_type == "str":
            return [self._text() for _ in range(self.rng.integers(5))]
        name = re.sub(r"^list\[(.*)\]$", r"\1", declared_type)
        part = _class_in(cls, name)
        assert part is not None, f"{cls.__name__}: {name} is no message"
        if kind == "list":
            return [self.message(part) for _ in range(self.rng.integers(4))]
        return self.message(part)

    def _text(self) -> str:
        if self.rng.random() < 0.8:
            return str(self.rng.choice(self._words))
        codes = self.rng.integers(1, 1000, self.rng.integers(20))
        return "".join(map(chr, codes.tolist()))

    def _array(self, dtype: np.dtype[Any]) -> np.ndarray[Any, Any]:
        length = int(self.rng.choice(LENGTHS))
        if dtype.kind == "b":
            return self.rng.random(length) < 0.5
        if dtype.kind != "f":
            limits = np.iinfo(dtype)
            return self.rng.integers(limits.min, limits.max, length, dtype, endpoint=True)
        with np.errstate(over="ignore"):
            return np.array([self.number() for _ in range(length)]).astype(dtype)

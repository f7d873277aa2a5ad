"""The nodes of a scene graph, as a file states them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from ....errors import AssetError

Numbers = npt.NDArray[np.float64]

MAX_NODES = 200_000
"""The greatest number of nodes in a file."""
MAX_DEPTH = 100
"""The deepest nesting of nodes."""
MAX_SURFACES = 50_000
"""The greatest number of surfaces, where a node that is used several times counts each time."""
MAX_CORNERS = 12_000_000
"""The greatest number of corners of triangles, counted in the same way."""


@dataclass(eq=False)
class Node:
    """A node."""

    kind: str
    """The type, as ``Transform``."""
    line: int
    """The line in the file, from 1."""
    fields: dict[str, Any] = field(default_factory=dict)
    """The values by name: arrays of numbers, lists of texts or of nodes, words."""
    children: list[Node] = field(default_factory=list)
    """The nodes without a field name."""

    def numbers(self, name: str, default: Any) -> Numbers:
        """Return the numbers of a field, as long as those of the default, which replaces others."""
        value = self.fields.get(name)
        numbers = convert_to_numbers(value)
        expected = np.atleast_1d(np.asarray(default, dtype=np.float64))
        return numbers if numbers is not None and len(numbers) == len(expected) else expected

    def array(self, name: str, width: int) -> Numbers:
        """Return the rows of a field, (n, width); an incomplete last row is left out."""
        numbers = convert_to_numbers(self.fields.get(name))
        if numbers is None:
            return np.zeros((0, width))
        return numbers[: len(numbers) // width * width].reshape(-1, width)

    def flag(self, name: str, *, default: bool) -> bool:
        """Return a flag."""
        value = self.fields.get(name)
        return default if value is None else str(value).upper() in ("TRUE", "1")

    def texts(self, name: str) -> list[str]:
        """Return the texts of a field."""
        value = self.fields.get(name)
        if isinstance(value, list):
            return [entry for entry in value if isinstance(entry, str)]
        return [value] if isinstance(value, str) else []

    def nodes(self, name: str) -> list[Node]:
        """Return the nodes of a field."""
        value = self.fields.get(name)
        values = value if isinstance(value, list) else [value]
        return [entry for entry in values if isinstance(entry, Node)]

    def node(self, name: str) -> Node | None:
        """Return the first node of a field; None if there is none."""
        return next(iter(self.nodes(name)), None)


def convert_to_numbers(value: Any) -> Numbers | None:
    """Return a value as numbers; None if it is none."""
    if isinstance(value, np.ndarray):
        return value
    if isinstance(value, str):
        try:
            return np.array(value.replace(",", " ").split(), dtype=np.float64)
        except ValueError:
            return None
    return None


class GraphError(AssetError):
    """A file that cannot be read, with its line."""

    def __init__(self, line: int, message: str) -> None:
        super().__init__(f"line {line}: {message}")

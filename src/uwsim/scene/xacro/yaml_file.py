"""YAML files of properties, read by ``xacro.load_yaml`` as PyYAML reads them for the xacro of ROS.

Of a key that is there twice the last value counts, and there is a warning. What an alias
(``*name``) stands for is shared and not copied; its size counts each time.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ...base.files.input_files import read_bytes
from ...errors import AssetError
from .expression import CONSTANTS, evaluate
from .value import MAX_ITEMS, ExpressionError, Value, checked
from .yaml_scalar import STANDARD, scalar, tag_of, unknown_tag

Node = Any
"""A node of ruamel.yaml, whose classes have no types."""
MAX_BYTES = 1 << 20
"""Largest file that is read."""
MAX_YAML_NODES = 3 * MAX_ITEMS
"""Most keys, values, lists, dictionaries and aliases of a file."""
UNITS: dict[str, float] = {
    "!radians": 1.0,
    "!degrees": math.pi / 180.0,
    "!meters": 1.0,
    "!millimeters": 0.001,
    "!foot": 0.3048,
    "!inches": 0.0254,
}
"""Tag of a number -> its unit [rad or m]."""
Warn = Callable[[int, str], None]
"""Takes a warning at a line."""


def read_yaml(path: Path, *, name: str, warn: Warn = lambda line, message: None) -> Value:
    """Return the lists, dictionaries, numbers and texts in a YAML file.

    Args:
        path: the file.
        name: what it is called by the file that names it.
        warn: is called with the line of each key that is there twice.

    Raises:
        ExpressionError: it cannot be read, is no YAML, or is too large, its aliases included.
    """
    from ruamel.yaml.error import MarkedYAMLError, YAMLError

    try:
        root = _composed(read_bytes(path, name=name, at_most=MAX_BYTES))
        return None if root is None else checked(_Builder(warn).value(root))
    except (OSError, AssetError) as error:
        raise ExpressionError(f"{path}: cannot be read: {str(error)[:200]}") from None
    except ExpressionError as error:
        raise ExpressionError(f"{path}: {error}") from None
    except MarkedYAMLError as error:
        mark = error.problem_mark
        line = "" if mark is None else f":{mark.line + 1}"
        raise ExpressionError(f"{path}{line}: not YAML: {str(error.problem)[:200]}") from None
    except (YAMLError, ValueError, RecursionError) as error:
        lines = [line.strip() for line in str(error).splitlines() if line.strip()]
        raise ExpressionError(f"{path}: not YAML: {'; '.join(lines[:3])[:200]}") from None


def _composed(data: bytes) -> Node:
    """Return the nodes of a file, where an alias is the node that it stands for; None for none."""
    from ruamel.yaml import YAML
    from ruamel.yaml.composer import Composer
    from ruamel.yaml.nodes import ScalarNode
    from ruamel.yaml.resolver import VersionedResolver
    from ruamel.yaml.tag import Tag

    class BoundedComposer(Composer):
        """Counts the nodes as they are made."""

        def __init__(self, loader: Any = None) -> None:
            super().__init__(loader)
            self.n_nodes, self.warn_double_anchors = 0, False

        def compose_node(self, parent: Any, index: Any) -> Any:
            self.n_nodes += 1
            if self.n_nodes > MAX_YAML_NODES:
                raise ExpressionError(f"a list or dictionary of more than {MAX_ITEMS} values")
            return super().compose_node(parent, index)

    class Resolver(VersionedResolver):
        """Tells numbers from texts as YAML 1.1 does."""

        def resolve(self, kind: Any, value: Any, implicit: Any) -> Any:
            if kind is ScalarNode and implicit[0]:
                return Tag(suffix=tag_of(value))
            return super().resolve(kind, value, (False, True))

    yaml = YAML(typ="safe", pure=True)
    yaml.Composer, yaml.Resolver = BoundedComposer, Resolver
    return yaml.compose(data)


class _Builder:
    """Makes values of the nodes of a file, one for each node, however many aliases it has."""

    def __init__(self, warn: Warn) -> None:
        self._warn = warn
        self._made: dict[Node, Value] = {}
        self._unfinished: set[Node] = set()
        self._n_merged = 0

    def value(self, node: Node) -> Value:
        """Return the value of a node; raises ExpressionError."""
        if node in self._made:
            return self._made[node]
        if node in self._unfinished:
            raise ExpressionError(
                f"the alias *{str(node.anchor)[:40]} is within what it stands for"
            )
        self._unfinished.add(node)
        self._made[node] = self._built(node)
        return self._made[node]

    def _built(self, node: Node) -> Value:
        tag = str(node.tag)
        if node.id == "scalar":
            return _number(node) if tag in UNITS else scalar(tag, node.value)
        if tag == f"{STANDARD}seq" and node.id == "sequence":
            return [self.value(each) for each in node.value]
        if tag == f"{STANDARD}map" and node.id == "mapping":
            return self._dictionary(node)
        raise unknown_tag(tag)

    def _dictionary(self, node: Node) -> dict[Any, Any]:
        """Return a dictionary: the entries that ``<<`` merges, and its own."""
        merged: dict[Any, Any] = {}
        own: dict[Any, Any] = {}
        for key_node, value_node in node.value:
            if str(key_node.tag) == f"{STANDARD}merge":
                for key, value in self._merged(value_node).items():
                    merged.setdefault(key, value)
                continue
            key = self.value(key_node)
            if isinstance(key, list | dict):
                raise ExpressionError("a key is a list or a dictionary")
            if key in own:
                message = f"the key {str(key)[:60]!r} is there twice; the last value counts"
                self._warn(key_node.start_mark.line + 1, message)
            own[key] = self.value(value_node)
        return {**merged, **own}

    def _merged(self, node: Node) -> dict[Any, Any]:
        """Return the entries of a dictionary, or of a list of them, of which the first counts."""
        merged: dict[Any, Any] = {}
        for part in reversed(node.value if node.id == "sequence" else [node]):
            entries = self.value(part)
            if not isinstance(entries, dict):
                raise ExpressionError("<< merges only dictionaries")
            self._n_merged += len(entries)
            if self._n_merged > MAX_ITEMS:
                raise ExpressionError(f"<< merges more than {MAX_ITEMS} values")
            merged.update(entries)
        return merged


def _number(node: Node) -> float:
    value = evaluate(str(node.value), lambda name: CONSTANTS[name])
    if not isinstance(value, int | float):
        raise ExpressionError(f"{node.tag} {str(node.value)[:40]!r} is no number")
    return float(value) * UNITS[str(node.tag)]

"""Reader of YAML files with properties, for ``xacro.load_yaml``.

The values are those that PyYAML reads for the xacro of ROS. If a key occurs twice, the last value
applies, with a warning. The node of an alias (``*name``) is shared, not copied; its size counts
each time.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ...base.files.input_files import read_bytes
from ...errors import AssetError
from .expression import CONSTANTS, evaluate
from .value import MAX_ITEMS, ExpressionError, Value, check_value
from .yaml_scalar import STANDARD_PREFIX, parse_scalar, tag_of, unknown_tag_error

Node = Any
"""A node of ruamel.yaml, whose classes have no types."""
MAX_BYTES = 1 << 20
"""The size of the largest file that is read [bytes]."""
MAX_YAML_NODES = 3 * MAX_ITEMS
"""The greatest number of keys, values, lists, dictionaries and aliases in a file."""
UNITS: dict[str, float] = {
    "!radians": 1.0,
    "!degrees": math.pi / 180.0,
    "!meters": 1.0,
    "!millimeters": 0.001,
    "!foot": 0.3048,
    "!inches": 0.0254,
}
"""The unit of a number by its YAML tag [rad or m]."""
Warn = Callable[[int, str], None]
"""A function that receives a line number and the text of a warning."""


def read_yaml(path: Path, *, name: str, warn: Warn = lambda line, message: None) -> Value:
    """Return the lists, dictionaries, numbers and texts in a YAML file.

    Args:
        path: the file.
        name: the name of the file, as the xacro file writes it.
        warn: the function that is called for each key that occurs twice.

    Raises:
        ExpressionError: the file cannot be read, is not YAML, or is too large with its aliases.
    """
    from ruamel.yaml.error import MarkedYAMLError, YAMLError

    try:
        root = _compose(read_bytes(path, name=name, at_most=MAX_BYTES))
        return None if root is None else check_value(_Builder(warn).value(root))
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


def _compose(data: bytes) -> Node:
    """Return the root node of a file, in which aliases share nodes; None for an empty file."""
    from ruamel.yaml import YAML
    from ruamel.yaml.composer import Composer
    from ruamel.yaml.nodes import ScalarNode
    from ruamel.yaml.resolver import VersionedResolver
    from ruamel.yaml.tag import Tag

    class BoundedComposer(Composer):
        """A composer that limits the number of nodes."""

        def __init__(self, loader: Any = None) -> None:
            super().__init__(loader)
            self.n_nodes, self.warn_double_anchors = 0, False

        def compose_node(self, parent: Any, index: Any) -> Any:
            self.n_nodes += 1
            if self.n_nodes > MAX_YAML_NODES:
                raise ExpressionError(f"a list or dictionary of more than {MAX_ITEMS} values")
            return super().compose_node(parent, index)

    class Resolver(VersionedResolver):
        """A resolver that separates numbers from texts as YAML 1.1 does."""

        def resolve(self, kind: Any, value: Any, implicit: Any) -> Any:
            if kind is ScalarNode and implicit[0]:
                return Tag(suffix=tag_of(value))
            return super().resolve(kind, value, (False, True))

    yaml = YAML(typ="safe", pure=True)
    yaml.Composer, yaml.Resolver = BoundedComposer, Resolver
    return yaml.compose(data)


class _Builder:
    """The converter of a file's nodes to values; a node with several aliases is converted once."""

    def __init__(self, warn: Warn) -> None:
        self._warn = warn
        self._values: dict[Node, Value] = {}
        self._open_nodes: set[Node] = set()
        self._n_merged = 0

    def value(self, node: Node) -> Value:
        """Return the value of a node; raises ExpressionError."""
        if node in self._values:
            return self._values[node]
        if node in self._open_nodes:
            raise ExpressionError(f"the alias *{str(node.anchor)[:40]} is within its own node")
        self._open_nodes.add(node)
        self._values[node] = self._build(node)
        return self._values[node]

    def _build(self, node: Node) -> Value:
        tag = str(node.tag)
        if node.id == "scalar":
            return _number(node) if tag in UNITS else parse_scalar(tag, node.value)
        if tag == f"{STANDARD_PREFIX}seq" and node.id == "sequence":
            return [self.value(child) for child in node.value]
        if tag == f"{STANDARD_PREFIX}map" and node.id == "mapping":
            return self._dictionary(node)
        raise unknown_tag_error(tag)

    def _dictionary(self, node: Node) -> dict[Any, Any]:
        """Return a dictionary with its own entries and those that ``<<`` merges."""
        merged_entries: dict[Any, Any] = {}
        entries: dict[Any, Any] = {}
        for key_node, value_node in node.value:
            if str(key_node.tag) == f"{STANDARD_PREFIX}merge":
                for key, value in self._merge(value_node).items():
                    merged_entries.setdefault(key, value)
                continue
            key = self.value(key_node)
            if isinstance(key, list | dict):
                raise ExpressionError("a key is a list or a dictionary")
            if key in entries:
                message = f"the key {str(key)[:60]!r} occurs twice; the last value applies"
                self._warn(key_node.start_mark.line + 1, message)
            entries[key] = self.value(value_node)
        return {**merged_entries, **entries}

    def _merge(self, node: Node) -> dict[Any, Any]:
        """Return the entries of one or several dictionaries; the first takes precedence."""
        merged_entries: dict[Any, Any] = {}
        for part in reversed(node.value if node.id == "sequence" else [node]):
            entries = self.value(part)
            if not isinstance(entries, dict):
                raise ExpressionError("<< merges only dictionaries")
            self._n_merged += len(entries)
            if self._n_merged > MAX_ITEMS:
                raise ExpressionError(f"<< merges more than {MAX_ITEMS} values")
            merged_entries.update(entries)
        return merged_entries


def _number(node: Node) -> float:
    value = evaluate(str(node.value), lambda name: CONSTANTS[name])
    if not isinstance(value, int | float):
        raise ExpressionError(f"{node.tag} {str(node.value)[:40]!r} is no number")
    return float(value) * UNITS[str(node.tag)]

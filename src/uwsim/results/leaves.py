"""The leaves of a JSON value (numbers, strings, booleans and nulls), each with its path."""

from __future__ import annotations

import json
from typing import Any

Leaves = dict[tuple[str | int, ...], str]


def leaves(value: Any) -> Leaves:
    """Return the JSON text of every leaf of a value, by the path of the leaf."""
    texts: Leaves = {}
    todo: list[tuple[tuple[str | int, ...], Any]] = [((), value)]
    while todo:
        path, node = todo.pop()
        if isinstance(node, dict) and node:
            todo += [((*path, str(key)), child) for key, child in reversed(node.items())]
        elif isinstance(node, list | tuple) and node:
            todo += [((*path, i), node[i]) for i in reversed(range(len(node)))]
        else:
            texts[path] = json.dumps(node, ensure_ascii=False)
    return texts

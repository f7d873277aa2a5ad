"""The numbers, words and nulls of a JSON value, each with its path."""

from __future__ import annotations

import json
from typing import Any

Leaves = dict[tuple[str | int, ...], str]


def leaves(value: Any) -> Leaves:
    """Return path -> text of every number, word and null in a JSON value."""
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

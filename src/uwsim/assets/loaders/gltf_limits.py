"""Limits of glTF files, checked before anything is loaded.

A header of a few bytes can stand for any amount of work: an accessor without data is that many
zeros, and every node is an instance of a mesh.
"""

from __future__ import annotations

import json
from typing import Any

MAX_ENTRIES = 20_000
"""Most nodes, primitives, accessors, images, ... of one kind."""
MAX_DEPTH = 100
"""Longest chain of nodes."""
MAX_ELEMENTS = 24_000_000
"""Most elements of an accessor: twice those of 4 million triangles that share no corner."""
MAX_EMPTY = 12_000_000
"""Most elements of all accessors without data, which are made of nothing."""
MAX_HEADER_BYTES = 32 * 2**20
"""Largest header of a .glb [bytes]."""
HEAD = 20
"""Length of what stands before that [bytes]."""


def too_much(data: bytes, suffix: str) -> str:
    """Report which limit a ``.gltf`` or ``.glb`` file exceeds; empty if none.

    What is no such file at all, trimesh says.
    """
    if suffix == ".glb":
        length = int.from_bytes(data[12:16], "little")
        if length > MAX_HEADER_BYTES:
            return f"its header has {length} bytes; at most {MAX_HEADER_BYTES} are read"
        data = data[HEAD : HEAD + length]
    try:
        tree = json.loads(data)
    except (ValueError, RecursionError):
        return ""
    return _too_many(tree) or _too_large(tree) if isinstance(tree, dict) else ""


def _too_many(tree: dict[str, Any]) -> str:
    kinds = {kind: found for kind, found in tree.items() if isinstance(found, list)}
    kinds["primitives"] = [
        primitive
        for mesh in _entries(tree, "meshes")
        if isinstance(mesh.get("primitives"), list)
        for primitive in mesh["primitives"]
    ]
    for kind, found in kinds.items():
        if len(found) > MAX_ENTRIES:
            return f"has {len(found)} {kind}; at most {MAX_ENTRIES} are read"
    return _too_deep(_entries(tree, "nodes"))


def _too_deep(nodes: list[dict[str, Any]]) -> str:
    """Walk from the nodes without parents downwards, each once; what is left over is a loop."""
    children = [
        [i for i in found if isinstance(i, int) and 0 <= i < len(nodes)]
        if isinstance(found := node.get("children"), list)
        else []
        for node in nodes
    ]
    if sum(map(len, children)) > MAX_ENTRIES:
        return f"its nodes have more than {MAX_ENTRIES} children"
    n_parents, depth = [0] * len(nodes), [0] * len(nodes)
    for child in (child for found in children for child in found):
        n_parents[child] += 1
    ready = [i for i, n in enumerate(n_parents) if n == 0]
    for i in ready:  # grows while it is walked
        for child in children[i]:
            depth[child] = max(depth[child], depth[i] + 1)
            n_parents[child] -= 1
            if n_parents[child] == 0:
                ready.append(child)
    if len(ready) < len(nodes) or max(depth, default=0) >= MAX_DEPTH:
        return f"its nodes form a loop, or a chain of more than {MAX_DEPTH}"
    return ""


def _too_large(tree: dict[str, Any]) -> str:
    empty = 0
    for accessor in _entries(tree, "accessors"):
        count = accessor.get("count")
        n = count if isinstance(count, int) else 0
        empty += 0 if "bufferView" in accessor else n
        for found, limit in ((n, MAX_ELEMENTS), (empty, MAX_EMPTY)):
            if found > limit:
                return f"has accessors of {found} elements; at most {limit} are read"
    return ""


def _entries(tree: dict[str, Any], kind: str) -> list[dict[str, Any]]:
    found = tree.get(kind)
    return [each for each in found if isinstance(each, dict)] if isinstance(found, list) else []

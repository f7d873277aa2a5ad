"""Limits of glTF files, checked before anything is loaded.

A header of a few bytes can cause any amount of work: an accessor without data is an array of
zeros, and every node is an instance of a mesh.
"""

from __future__ import annotations

import json
from typing import Any

MAX_ENTRIES = 20_000
"""The greatest number of nodes, primitives, accessors, images, ... of one kind."""
MAX_DEPTH = 100
"""The greatest length of a chain of nodes."""
MAX_ELEMENTS = 24_000_000
"""The greatest number of elements of an accessor: 4 million separate triangles have half of it."""
MAX_EMPTY_ELEMENTS = 12_000_000
"""The greatest number of elements of all accessors without data, whose elements are zeros."""
MAX_HEADER_BYTES = 32 * 2**20
"""The greatest size of the JSON header of a .glb [bytes]."""
GLB_JSON_START = 20
"""The offset of the JSON header of a .glb in the file [bytes]."""


def limit_error(data: bytes, suffix: str) -> str:
    """Report which limit a ``.gltf`` or ``.glb`` file exceeds; empty if none.

    If it is not such a file, trimesh reports that.
    """
    if suffix == ".glb":
        length = int.from_bytes(data[12:16], "little")
        if length > MAX_HEADER_BYTES:
            return f"its header has {length} bytes; at most {MAX_HEADER_BYTES} are read"
        data = data[GLB_JSON_START : GLB_JSON_START + length]
    try:
        tree = json.loads(data)
    except (ValueError, RecursionError):
        return ""
    return _count_error(tree) or _size_error(tree) if isinstance(tree, dict) else ""


def _count_error(tree: dict[str, Any]) -> str:
    kinds = {kind: entries for kind, entries in tree.items() if isinstance(entries, list)}
    kinds["primitives"] = [
        primitive
        for mesh in _entries(tree, "meshes")
        if isinstance(mesh.get("primitives"), list)
        for primitive in mesh["primitives"]
    ]
    for kind, entries in kinds.items():
        if len(entries) > MAX_ENTRIES:
            return f"has {len(entries)} {kind}; at most {MAX_ENTRIES} are read"
    return _depth_error(_entries(tree, "nodes"))


def _depth_error(nodes: list[dict[str, Any]]) -> str:
    """Visit the nodes from those without parents downwards, each once; the rest form loops."""
    children = [
        [i for i in child_indices if isinstance(i, int) and 0 <= i < len(nodes)]
        if isinstance(child_indices := node.get("children"), list)
        else []
        for node in nodes
    ]
    if sum(map(len, children)) > MAX_ENTRIES:
        return f"its nodes have more than {MAX_ENTRIES} children"
    n_parents, depth = [0] * len(nodes), [0] * len(nodes)
    for child in (child for child_indices in children for child in child_indices):
        n_parents[child] += 1
    visited_nodes = [i for i, n in enumerate(n_parents) if n == 0]
    for i in visited_nodes:  # grows while it is walked
        for child in children[i]:
            depth[child] = max(depth[child], depth[i] + 1)
            n_parents[child] -= 1
            if n_parents[child] == 0:
                visited_nodes.append(child)
    if len(visited_nodes) < len(nodes) or max(depth, default=0) >= MAX_DEPTH:
        return f"its nodes form a loop, or a chain of more than {MAX_DEPTH}"
    return ""


def _size_error(tree: dict[str, Any]) -> str:
    n_empty = 0
    for accessor in _entries(tree, "accessors"):
        count = accessor.get("count")
        n = count if isinstance(count, int) else 0
        n_empty += 0 if "bufferView" in accessor else n
        for n_elements, limit in ((n, MAX_ELEMENTS), (n_empty, MAX_EMPTY_ELEMENTS)):
            if n_elements > limit:
                return f"has accessors of {n_elements} elements; at most {limit} are read"
    return ""


def _entries(tree: dict[str, Any], kind: str) -> list[dict[str, Any]]:
    entries = tree.get(kind)
    return [e for e in entries if isinstance(e, dict)] if isinstance(entries, list) else []

"""Limits of Collada files, checked before anything is loaded.

A node may be an instance of another that contains instances: a chain of ten nodes, each with ten
instances of the next, gives ten thousand million nodes in a file of a few kilobytes.
"""

from __future__ import annotations

from xml.etree.ElementTree import Element, ParseError, fromstring

MAX_NODES = 20_000
"""The greatest number of nodes and geometries; every instance counts."""
MAX_DEPTH = 100
"""The greatest depth of nodes, including nodes of instances."""
MAX_TEXT = 64 * 2**20
"""The greatest number of characters of indices in all geometries; every instance counts."""


class _TooDeep(Exception):
    """The error of nodes that form a loop, or a chain that is too long."""


def limit_error(data: bytes) -> str:
    """Report which limit a ``.dae`` file exceeds; empty if none.

    If it is not XML, trimesh reports that.
    """
    try:
        root = fromstring(data)
    except (ParseError, LookupError, ValueError):
        return ""
    counts = _Counts(root)
    try:
        scenes = [node for node in root.iter() if _tag(node) == "visual_scene"]
        sizes = [counts.node_size(scene) for scene in scenes]
    except _TooDeep:
        return f"its nodes form a loop, or a chain of more than {MAX_DEPTH}"
    if (n := sum(nodes for nodes, _, _ in sizes)) > MAX_NODES:
        return f"its nodes have {n:.3g} instances; at most {MAX_NODES} are read"
    if (letters := sum(text for _, text, _ in sizes)) > MAX_TEXT:
        max_mib = MAX_TEXT >> 20
        return f"its instances have {letters / 2**20:.3g} MiB of triangles; at most {max_mib}"
    return ""


class _Counts:
    """The size of each node including its instances, computed once."""

    def __init__(self, root: Element) -> None:
        self._nodes: dict[str, list[Element]] = {}
        self._texts: dict[str, int] = {}
        self._sources: dict[str, str] = {}
        self._sizes: dict[Element, tuple[int, int, int]] = {}
        for element in root.iter():
            element_id = element.get("id", "")
            if _tag(element) == "node":
                self._nodes.setdefault(element_id, []).append(element)
            elif _tag(element) == "controller":  # its geometry is used as modelled
                for skin in element:
                    self._sources[element_id] = skin.get("source", "").removeprefix("#")
            elif _tag(element) == "geometry":
                texts = (part.text for part in element.iter() if _tag(part) in ("p", "vcount"))
                letters = sum(len(text or "") for text in texts)
                self._texts[element_id] = max(letters, self._texts.get(element_id, 0))

    def node_size(self, node: Element, depth: int = 0) -> tuple[int, int, int]:
        """Return the number of nodes and geometries, of characters of indices, and the depth."""
        if node not in self._sizes:
            if depth > MAX_DEPTH:
                raise _TooDeep
            n, text, length = 1, 0, 0
            for child in node:
                target_id = child.get("url", "").removeprefix("#")
                if _tag(child) in ("instance_geometry", "instance_controller"):
                    n, text = n + 1, text + self._texts.get(self._source_of(target_id), 0)
                    continue
                is_instance = _tag(child) == "instance_node"
                nodes = self._nodes.get(target_id, []) if is_instance else [child]
                for child_node in nodes if is_instance or _tag(child) == "node" else ():
                    size = self.node_size(child_node, depth + 1)
                    n, text, length = n + size[0], text + size[1], max(length, size[2] + 1)
            if length > MAX_DEPTH:
                raise _TooDeep
            self._sizes[node] = n, text, length
        return self._sizes[node]

    def _source_of(self, element_id: str) -> str:
        """Return the id of the geometry of a controller; any other id is returned unchanged."""
        for _ in range(2):
            element_id = self._sources.get(element_id, element_id)
        return element_id


def _tag(element: Element) -> str:
    return str(element.tag).rpartition("}")[2]

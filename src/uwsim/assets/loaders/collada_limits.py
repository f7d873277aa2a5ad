"""Limits of Collada files, checked before anything is loaded.

A node may be an instance of another that holds instances itself: ten nodes of ten instances each
are ten thousand million, in a file of a few kilobytes.
"""

from __future__ import annotations

from xml.etree.ElementTree import Element, ParseError, fromstring

MAX_NODES = 20_000
"""Most nodes and geometries, instances counted each."""
MAX_DEPTH = 100
"""Longest chain of nodes, instances followed."""
MAX_TEXT = 64 * 2**20
"""Most letters of indices in all geometries, instances counted each."""


class _TooDeep(Exception):
    """The nodes form a loop, or a chain that is too long."""


def too_much(data: bytes) -> str:
    """Report which limit a ``.dae`` file exceeds; empty if none.

    What is no XML at all, trimesh says.
    """
    try:
        root = fromstring(data)
    except (ParseError, LookupError, ValueError):
        return ""
    counts = _Counts(root)
    try:
        scenes = [node for node in root.iter() if _kind(node) == "visual_scene"]
        weighed = [counts.of(scene) for scene in scenes]
    except _TooDeep:
        return f"its nodes form a loop, or a chain of more than {MAX_DEPTH}"
    if (n := sum(nodes for nodes, _, _ in weighed)) > MAX_NODES:
        return f"its nodes stand for {n:.3g}; at most {MAX_NODES} are read"
    if (letters := sum(text for _, text, _ in weighed)) > MAX_TEXT:
        most = MAX_TEXT >> 20
        return f"its instances stand for {letters / 2**20:.3g} MiB of triangles; at most {most}"
    return ""


class _Counts:
    """The size of each node with its instances, counted once."""

    def __init__(self, root: Element) -> None:
        self._nodes: dict[str, list[Element]] = {}
        self._texts: dict[str, int] = {}
        self._sources: dict[str, str] = {}
        self._known: dict[Element, tuple[int, int, int]] = {}
        for each in root.iter():
            called = each.get("id", "")
            if _kind(each) == "node":
                self._nodes.setdefault(called, []).append(each)
            elif _kind(each) == "controller":  # its geometry is used as modelled
                for skin in each:
                    self._sources[called] = skin.get("source", "").removeprefix("#")
            elif _kind(each) == "geometry":
                letters = sum(len(p.text or "") for p in each.iter() if _kind(p) in ("p", "vcount"))
                self._texts[called] = max(letters, self._texts.get(called, 0))

    def of(self, node: Element, depth: int = 0) -> tuple[int, int, int]:
        """Number of nodes and geometries, letters of indices, and length of the longest chain."""
        if node not in self._known:
            if depth > MAX_DEPTH:
                raise _TooDeep
            n, text, longest = 1, 0, 0
            for child in node:
                wanted = child.get("url", "").removeprefix("#")
                if _kind(child) in ("instance_geometry", "instance_controller"):
                    n, text = n + 1, text + self._texts.get(self._source_of(wanted), 0)
                    continue
                is_instance = _kind(child) == "instance_node"
                nodes = self._nodes.get(wanted, []) if is_instance else [child]
                for each in nodes if is_instance or _kind(child) == "node" else ():
                    found = self.of(each, depth + 1)
                    n, text, longest = n + found[0], text + found[1], max(longest, found[2] + 1)
            if longest > MAX_DEPTH:
                raise _TooDeep
            self._known[node] = n, text, longest
        return self._known[node]

    def _source_of(self, called: str) -> str:
        """The geometry of a controller, directly or by way of another; any other name as it is."""
        for _ in range(2):
            called = self._sources.get(called, called)
        return called


def _kind(element: Element) -> str:
    """The tag without its namespace."""
    return str(element.tag).rpartition("}")[2]

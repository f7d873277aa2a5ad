"""Parser of X3D in XML encoding (ISO/IEC 19776-1), without entities, DTD and network."""

from __future__ import annotations

from lxml import etree

from .node import MAX_DEPTH, MAX_NODES, GraphError, Node

CONTAINERS = {
    "Appearance": "appearance",
    "Material": "material",
    "ImageTexture": "texture",
    "TextureTransform": "textureTransform",
    "Coordinate": "coord",
    "CoordinateDouble": "coord",
    "TextureCoordinate": "texCoord",
    "Color": "color",
    "ColorRGBA": "color",
    "Normal": "normal",
}
"""The field of a node in its parent, if it names none."""
GEOMETRIES = (
    "Box", "Sphere", "Cylinder", "Cone", "IndexedFaceSet", "IndexedTriangleSet", "TriangleSet",
    "ElevationGrid", "Extrusion", "IndexedLineSet", "PointSet", "Text", "Arc2D",
)  # fmt: skip
"""The nodes whose field is ``geometry``."""


def parse_x3d(data: bytes) -> list[Node]:
    """Return the root nodes of the scene of an X3D file.

    Raises:
        GraphError: it is not well-formed, or is not X3D; with the line.
    """
    if b"<!ENTITY" in data:
        line = data.count(b"\n", 0, data.index(b"<!ENTITY")) + 1
        raise GraphError(line, "entities are not read")
    parser = etree.XMLParser(
        resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False
    )
    try:
        root = etree.fromstring(data, parser)
    except etree.XMLSyntaxError as error:
        raise GraphError(error.lineno or 1, f"not well-formed XML: {error.msg}") from error
    scene = next((child for child in root if _tag(child) == "Scene"), None)
    if _tag(root) != "X3D" or scene is None:
        raise GraphError(1, f"has <{_tag(root)}>; expected <X3D> with a <Scene>")
    return _Reader().read_children(scene, 0)


def _tag(element: etree._Element) -> str:
    return str(element.tag).rpartition("}")[2] if isinstance(element.tag, str) else ""


class _Reader:
    """The reader of the elements of a scene."""

    def __init__(self) -> None:
        self._defined_nodes: dict[str, Node] = {}
        self._n_nodes = 0

    def read_children(self, element: etree._Element, depth: int) -> list[Node]:
        """Return the nodes of the child elements."""
        return [self._read(child, depth) for child in element if _tag(child)]

    def _read(self, element: etree._Element, depth: int) -> Node:
        line = element.sourceline if isinstance(element.sourceline, int) else 0
        self._n_nodes += 1
        if self._n_nodes > MAX_NODES or depth > MAX_DEPTH:
            raise GraphError(line, f"more than {MAX_NODES} nodes, or {MAX_DEPTH} in each other")
        if "USE" in element.attrib:
            return self._defined_nodes.get(str(element.get("USE")), Node(kind="Group", line=line))
        node = Node(kind=_tag(element), line=line)
        for name, value in element.attrib.items():
            text = str(value)
            node.fields[str(name)] = _split_texts(text) if '"' in text else text
        for child_element in element:
            if not (tag := _tag(child_element)):
                continue
            child = self._read(child_element, depth + 1)
            default = "geometry" if tag in GEOMETRIES else CONTAINERS.get(tag, "children")
            container = child_element.get("containerField") or default
            entries = node.fields.setdefault(container, [])
            if isinstance(entries, list):
                entries.append(child)
        if "DEF" in element.attrib:
            self._defined_nodes[str(element.get("DEF"))] = node
        return node


def _split_texts(text: str) -> list[str]:
    """Return the texts of a field such as ``"a.png" "b.png"``."""
    return [part for part in text.split('"')[1::2] if part]

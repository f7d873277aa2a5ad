r"""The surfaces of VRML and X3D nodes.

Transforms are those of ISO/IEC 14772-1, 6.52: :math:`T\,C\,R\,S_R\,S\,S_R^{-1}\,C^{-1}`. The
vertical axis y of the file becomes z, as OpenSceneGraph reads VRML: :math:`(x, y, z) \to (x, -z,
y)`.

Not read, with a remark: extrusions, texts, lines, points, prototypes, inlined files, shaders. Not
read: normals (they are computed), texture transforms, opacity, lights, animations. Colours of
vertices become one mean colour.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

import numpy as np

from ....base.geometry import rotation_about
from ....base.numerics.linear import determinant, product, rotate_rows
from ..polygons import triangulate
from .node import MAX_CORNERS, MAX_DEPTH, MAX_SURFACES, GraphError, Node, Numbers
from .surfaces import Colour, Surface

GROUPS = (
    "Group", "Anchor", "Billboard", "Collision", "StaticGroup", "CADLayer", "CADAssembly",
    "CADPart", "CADFace", "LayerSet", "Layer", "Viewport",
)  # fmt: skip
IGNORED_NODES = (
    "WorldInfo", "NavigationInfo", "Viewpoint", "OrthoViewpoint", "Background", "Fog", "Sound",
    "DirectionalLight", "PointLight", "SpotLight", "TimeSensor", "TouchSensor", "ProximitySensor",
    "PlaneSensor", "CylinderSensor", "SphereSensor", "VisibilitySensor", "Script", "ROUTE", "head",
    "PositionInterpolator", "OrientationInterpolator", "ScalarInterpolator", "ColorInterpolator",
    "CoordinateInterpolator", "NormalInterpolator", "TextureBackground", "AudioClip", "MetadataSet",
    "MetadataString", "MetadataDouble", "MetadataFloat", "MetadataInteger",
)  # fmt: skip
"""The nodes without a surface."""
SEGMENTS = 32
"""The number of segments of a circle."""
MAX_CELLS = 4_000_000
"""The greatest number of cells of a grid of heights."""


def read_surfaces(roots: list[Node]) -> tuple[list[Surface], tuple[str, ...]]:
    """Return the surfaces of the root nodes, and remarks on those that are left out."""
    counts: dict[int, int] = {}
    if sum(_count_shapes(root, counts, 0) for root in roots) > MAX_SURFACES:
        raise GraphError(1, f"has more than {MAX_SURFACES} surfaces")
    collector = _Collector(counts)
    for root in roots:
        collector.visit(root, np.eye(4))
    remarks = tuple(
        f"{count} {kind} {'is' if count == 1 else 'are'} left out"
        for kind, count in sorted(collector.unread_kinds.items())
    )
    return collector.surfaces, remarks


def _count_shapes(node: Node, counts: dict[int, int], depth: int) -> int:
    """Return the number of shapes of a node; ``counts`` has those of the visited nodes by id."""
    if node.kind == "Shape":
        return 1
    if id(node) not in counts:
        if depth > MAX_DEPTH:
            raise GraphError(node.line, f"more than {MAX_DEPTH} nodes in each other")
        children = _chosen_children(node)
        counts[id(node)] = sum(_count_shapes(child, counts, depth + 1) for child in children)
    return counts[id(node)]


class _Collector:
    """The traversal of the nodes.

    Args:
        counts: the number of shapes of each group by its id; groups without any are visited once.
    """

    def __init__(self, counts: dict[int, int]) -> None:
        self._counts = counts
        self._empty_groups: set[int] = set()
        self.surfaces: list[Surface] = []
        self.unread_kinds: Counter[str] = Counter()
        self._geometries: dict[int, Corners] = {}
        self._n_corners = 0

    def visit(self, node: Node, world_from_node: Numbers) -> None:
        """Add the surfaces of a node and of its children, at a transform (4, 4)."""
        if node.kind == "Shape":
            self._add_shape(node, world_from_node)
            return
        if node.kind in IGNORED_NODES or id(node) in self._empty_groups:
            return
        if self._counts.get(id(node)) == 0:
            self._empty_groups.add(id(node))
        if node.kind == "Transform":
            world_from_node = product(world_from_node, _transform(node))
        elif node.kind not in (*GROUPS, "Switch", "LOD", "Scene"):
            self.unread_kinds[node.kind] += 1
            return
        for child in _chosen_children(node):
            self.visit(child, world_from_node)

    def _add_shape(self, node: Node, world_from_node: Numbers) -> None:
        geometry = node.node("geometry")
        if geometry is None:
            return
        make = GEOMETRIES.get(geometry.kind)
        if make is None:
            self.unread_kinds[geometry.kind] += 1
            return
        if id(geometry) not in self._geometries:
            self._geometries[id(geometry)] = make(geometry)
        corners, uvs = self._geometries[id(geometry)]
        self._n_corners += len(corners)
        if self._n_corners > MAX_CORNERS:
            raise GraphError(node.line, f"has more than {MAX_CORNERS} corners of triangles")
        if len(corners) == 0:
            return
        points = rotate_rows(world_from_node[:3, :3], corners) + world_from_node[:3, 3]
        if determinant(world_from_node[:3, :3]) < 0.0:
            points, uvs = _reverse(points), None if uvs is None else _reverse(uvs)
        x, y, z = points.T
        colour, images = _appearance(node, geometry)
        if images and uvs is None:
            uvs = _default_uvs(corners)
        self.surfaces.append(
            Surface(corners=np.stack([x, -z, y], axis=-1), uvs=uvs, colour=colour, images=images)
        )


def _chosen_children(node: Node) -> list[Node]:
    """Return the visible children of a group, a switch or a level of detail."""
    children = node.nodes("children")
    if node.kind == "LOD":
        return (node.nodes("level") or children)[:1]
    if node.kind == "Switch":
        index = int(node.numbers("whichChoice", [-1])[0])
        choices = node.nodes("choice") or children
        return choices[index : index + 1] if index >= 0 else []
    return children


def _transform(node: Node) -> Numbers:
    """Return the matrix of a Transform, (4, 4)."""
    centre = node.numbers("center", [0.0, 0.0, 0.0])
    scale = node.numbers("scale", [1.0, 1.0, 1.0])
    rotation = _rotation(node.numbers("rotation", [0.0, 0.0, 1.0, 0.0]))
    stretch = _rotation(node.numbers("scaleOrientation", [0.0, 0.0, 1.0, 0.0]))
    linear = product(rotation, product(stretch * scale, stretch.T))
    matrix = np.eye(4)
    matrix[:3, :3] = linear
    translation = node.numbers("translation", [0.0, 0.0, 0.0])
    matrix[:3, 3] = translation + centre - product(linear, centre)
    return matrix


def _rotation(axis_angle: Numbers) -> Numbers:
    axis, angle = axis_angle[:3], float(axis_angle[3])
    return rotation_about(axis, angle) if axis.any() else np.eye(3)


def _appearance(node: Node, geometry: Node) -> tuple[Colour, tuple[str, ...]]:
    """Return the diffuse colour and the names of the image."""
    appearance = node.node("appearance")
    material = None if appearance is None else appearance.node("material")
    texture = None if appearance is None else appearance.node("texture")
    red, green, blue = (1.0, 1.0, 1.0)
    if material is not None:
        red, green, blue = material.numbers("diffuseColor", [0.8, 0.8, 0.8]).tolist()
    colours = geometry.node("color")
    if colours is not None:
        rows = colours.array("color", 4 if colours.kind == "ColorRGBA" else 3)
        if len(rows):
            red, green, blue = rows[:, :3].mean(axis=0).tolist()
    images = () if texture is None else tuple(texture.texts("url"))
    return (red, green, blue), images


def _default_uvs(corners: Numbers) -> Numbers:
    """Return the default texture coordinates: s along the longest side of the box, t the next."""
    low, size = corners.min(axis=0), np.ptp(corners, axis=0)
    first, second = (int(index) for index in np.argsort(-size, kind="stable")[:2])
    length = max(float(size[first]), 1e-12)
    return (
        np.stack([corners[:, first] - low[first], corners[:, second] - low[second]], axis=-1)
        / length
    )


def _reverse(rows: Numbers) -> Numbers:
    """Return the corners of triangles in the other direction."""
    reversed_rows: Numbers = rows.reshape(-1, 3, rows.shape[1])[:, ::-1].reshape(rows.shape)
    return reversed_rows


Corners = tuple[Numbers, Numbers | None]
"""The corners of triangles, (n, 3), and their texture coordinates, (n, 2)."""


def _indexed_faces(node: Node) -> Corners:
    points = _points(node)
    index = _indices(node, "coordIndex")
    counts, corners = _polygons(index, len(points), node)
    triangles = triangulate(points[corners], counts).ravel()
    uvs = _indexed_uvs(node, index, corners)
    result = points[corners][triangles], None if uvs is None else uvs[triangles]
    return _wind(node, *result)


def _indexed_uvs(node: Node, index: np.ndarray, corners: np.ndarray) -> Numbers | None:
    """Return the texture coordinates of the corners of the faces; None without any."""
    coordinates = node.node("texCoord")
    if coordinates is None:
        return None
    rows = coordinates.array("point", 2)
    texture_index = _indices(node, "texCoordIndex")
    uv_indices = corners if len(texture_index) == 0 else texture_index[texture_index >= 0]
    if len(uv_indices) != len(corners) or len(rows) == 0 or uv_indices.max(initial=0) >= len(rows):
        return None
    uvs: Numbers = rows[uv_indices]
    return uvs


def _indexed_triangles(node: Node) -> Corners:
    points, index = _points(node), _indices(node, "index")
    index = index[: len(index) // 3 * 3]
    _check_indices(index, len(points), node)
    coordinates = node.node("texCoord")
    rows = None if coordinates is None else coordinates.array("point", 2)
    uvs = rows[index] if rows is not None and len(rows) == len(points) else None
    return _wind(node, points[index], uvs)


def _triangles(node: Node) -> Corners:
    points = _points(node)
    points = points[: len(points) // 3 * 3]
    coordinates = node.node("texCoord")
    rows = None if coordinates is None else coordinates.array("point", 2)[: len(points)]
    return _wind(node, points, rows if rows is not None and len(rows) == len(points) else None)


def _elevation_grid(node: Node) -> Corners:
    """Return the triangles of heights y over x and z."""
    nx = int(node.numbers("xDimension", [0])[0])
    nz = int(node.numbers("zDimension", [0])[0])
    heights = node.array("height", 1)[:, 0]
    if nx < 2 or nz < 2 or nx * nz > MAX_CELLS or len(heights) != nx * nz:
        raise GraphError(
            node.line, f"ElevationGrid has {len(heights)} heights; expected {nx} x {nz}"
        )
    dx = float(node.numbers("xSpacing", [1.0])[0])
    dz = float(node.numbers("zSpacing", [1.0])[0])
    i, k = np.meshgrid(np.arange(nx), np.arange(nz))
    points = np.stack([i.ravel() * dx, heights, k.ravel() * dz], axis=-1)
    uvs = np.stack([i.ravel() / (nx - 1), k.ravel() / (nz - 1)], axis=-1)
    first = (np.arange(nz - 1)[:, None] * nx + np.arange(nx - 1)).ravel()
    quads = np.stack([first, first + nx, first + nx + 1, first + 1], axis=-1)
    index = quads[:, [0, 1, 2, 0, 2, 3]].ravel()
    coordinates = node.node("texCoord")
    rows = None if coordinates is None else coordinates.array("point", 2)
    uvs = rows if rows is not None and len(rows) == len(points) else uvs
    return _wind(node, points[index], uvs[index])


def _box(node: Node) -> Corners:
    import trimesh

    size = node.numbers("size", [2.0, 2.0, 2.0])
    return _solid(trimesh.creation.box(size)), None


def _sphere(node: Node) -> Corners:
    import trimesh

    radius = float(node.numbers("radius", [1.0])[0])
    return _solid(trimesh.creation.uv_sphere(radius=radius, count=[SEGMENTS, SEGMENTS])), None


def _cylinder(node: Node) -> Corners:
    import trimesh

    radius = float(node.numbers("radius", [1.0])[0])
    height = float(node.numbers("height", [2.0])[0])
    mesh = trimesh.creation.cylinder(radius=radius, height=height, sections=SEGMENTS)
    return _turn_to_y(_solid(mesh)), None


def _cone(node: Node) -> Corners:
    import trimesh

    radius = float(node.numbers("bottomRadius", [1.0])[0])
    height = float(node.numbers("height", [2.0])[0])
    mesh = trimesh.creation.cone(radius=radius, height=height, sections=SEGMENTS)
    return _turn_to_y(_solid(mesh) - [0.0, 0.0, 0.5 * height]), None


def _solid(mesh: object) -> Numbers:
    vertices = np.asarray(mesh.vertices, dtype=np.float64)  # type: ignore[attr-defined]
    return vertices[np.asarray(mesh.faces).ravel()]  # type: ignore[attr-defined]


def _turn_to_y(corners: Numbers) -> Numbers:
    """Return a solid about z as one about y."""
    x, y, z = corners.T
    return np.stack([x, z, -y], axis=-1)


def _points(node: Node) -> Numbers:
    coordinates = node.node("coord")
    return np.zeros((0, 3)) if coordinates is None else coordinates.array("point", 3)


def _indices(node: Node, name: str) -> np.ndarray:
    values = node.array(name, 1)[:, 0]
    if not (np.abs(values) < 2**31).all():
        raise GraphError(node.line, f"{node.kind} has an index that is no number of a point")
    return values.astype(np.int64)


def _polygons(index: np.ndarray, n_points: int, node: Node) -> tuple[np.ndarray, np.ndarray]:
    """Return the numbers of corners of the faces, and the indices of the points of the corners."""
    ends = np.flatnonzero(index < 0)
    bounds = np.concatenate([[-1], ends, [len(index)]])
    counts = np.diff(bounds) - 1
    corners = index[index >= 0]
    _check_indices(corners, n_points, node)
    return counts[counts > 0], corners


def _check_indices(index: np.ndarray, n_points: int, node: Node) -> None:
    if len(index) and not 0 <= index.min() <= index.max() < n_points:
        raise GraphError(node.line, f"{node.kind} has the index of a point that does not exist")


def _wind(node: Node, corners: Numbers, uvs: Numbers | None) -> Corners:
    """Return triangles counter-clockwise from outside."""
    if node.flag("ccw", default=True):
        return corners, uvs
    return _reverse(corners), None if uvs is None else _reverse(uvs)


GEOMETRIES: dict[str, Callable[[Node], Corners]] = {
    "IndexedFaceSet": _indexed_faces,
    "IndexedTriangleSet": _indexed_triangles,
    "TriangleSet": _triangles,
    "ElevationGrid": _elevation_grid,
    "Box": _box,
    "Sphere": _sphere,
    "Cylinder": _cylinder,
    "Cone": _cone,
}
"""The geometries that have a surface here."""

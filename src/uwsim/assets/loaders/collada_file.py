"""The reader of Collada files by pycollada, with remarks about unreadable parts.

pycollada leaves out a geometry whose material is broken. Here such a material is replaced by its
diffuse colour, or by grey; a part that is left out for another reason gets a remark.
"""

from __future__ import annotations

import copy
import io
import re
import warnings
from collections.abc import Iterator
from typing import Any

import collada
import numpy as np
import numpy.typing as npt
import trimesh
from collada.common import DaeBrokenRefError, DaeError
from collada.geometry import Geometry
from collada.material import DaeMissingSampler2D, Effect, Map, Material
from collada.scene import GeometryNode, Node

from ...base.numerics.linear import product
from ...errors import AssetError
from .polygons import triangulate
from .references import References

GREY = (0.7, 0.7, 0.7, 1.0)
"""The colour of a material that cannot be read."""
MAX_REMARKS = 20
"""The greatest number of remarks about one file."""
MAX_NAME_LENGTH = 80
"""The number of letters of a name of the file in a remark."""

Matrix = npt.NDArray[np.float64]
_MESSAGE_TAIL = re.compile(r" in (effect|node|material) .*", re.DOTALL)
_IGNORED_ERROR = re.compile(r"Camera |Light |Invalid url in (camera|light) |Unknown input semantic")
_NOT_FOUND = re.compile(r"(?:Geometry|Node) #(.*) not found in library", re.DOTALL)


def read_parts(
    data: bytes, references: References
) -> tuple[list[tuple[Matrix, trimesh.Trimesh]], tuple[str, ...]]:
    """Return the meshes of a file with the poses of their nodes, and remarks on what is broken.

    Args:
        data: the file.
        references: the reader of the images of the file.

    Raises:
        AssetError: the file has no scene, or only broken parts.
    """
    document = _Document(io.BytesIO(data), ignore=[DaeError])
    remarks = document.remarks()
    if document.scene is None:
        causes = [error.msg for error in document.errors]
        raise AssetError(f"has no scene that can be read{_cause_suffix(causes)}")
    materials = {item.id: _material_of(item.effect, references) for item in document.materials}
    parts = [
        part for node in document.scene.nodes for part in _parts_of(node, np.eye(4), materials)
    ]
    if remarks and not any(len(mesh.faces) for _, mesh in parts):
        raise AssetError(f"has no triangles that can be read{_cause_suffix(remarks)}")
    return parts, remarks[:MAX_REMARKS]


class _Document(collada.Collada):  # type: ignore[misc]  # pycollada has no types
    """A Collada file in which broken materials are replaced by plain colours."""

    def __init__(self, file: io.BytesIO, ignore: list[type]) -> None:
        self._broken_effects: dict[str, str] = {}
        self._broken_materials: dict[str, str] = {}
        self._broken_geometries: dict[str, str] = {}
        self._remarks: list[str] = []
        self._n_errors = 0
        super().__init__(file, ignore=ignore)

    def remarks(self) -> tuple[str, ...]:
        """Return the broken parts of the scene, with the reasons."""
        material_names = (node.get("target")[1:] for node in self._elements("instance_material"))
        remarks = [
            f"material {_quote_name(name)} cannot be read ({self._broken_materials[name]})"
            for name in material_names
            if name in self._broken_materials
        ]
        remarks += self._remarks
        for error in self.errors[self._n_errors :]:
            if not _IGNORED_ERROR.match(error.msg):
                remarks.append(f"{self._describe_loss(error.msg)}: it is left out")
        return tuple(dict.fromkeys(remarks))

    def _describe_loss(self, message: str) -> str:
        match = _NOT_FOUND.fullmatch(message)
        if match and match[1] in self._broken_geometries:
            reason = self._broken_geometries[match[1]]
            return f"geometry {_quote_name(match[1])} cannot be read ({reason})"
        return f"a part of its scene cannot be read ({message[:200]})"

    def _elements(self, kind: str) -> Iterator[Any]:
        yield from self.xmlnode.getroot().iter(self.tag(kind))

    def _loadEffects(self) -> None:  # noqa: N802  # pycollada calls it
        """Load all effects; replace a broken one by its diffuse colour, or by grey."""
        for library in self.xmlnode.findall(self.tag("library_effects")):
            for node in library.findall(self.tag("effect")):
                try:
                    effect = self._effect(node)
                except Exception as error:  # pycollada raises many kinds on broken effects
                    effect, substitute = self._substitute_effect(node)
                    self._broken_effects[effect.id] = f"{_reason(error)}; {substitute}"
                self.effects.append(effect)

    def _effect(self, node: Any) -> Effect:
        effect = Effect.load(self, {}, node)
        texture = node.find(f".//{self.tag('diffuse')}/{self.tag('texture')}")
        if texture is not None and not isinstance(effect.diffuse, Map):  # left black by pycollada
            raise DaeBrokenRefError(f"Missing image {texture.get('texture')!r}")
        return effect

    def _substitute_effect(self, node: Any) -> tuple[Effect, str]:
        for removed_tags in ((), ("newparam",)):
            plain_node = copy.deepcopy(node)
            unused_tags = {self.tag(name) for name in Effect.supported if name != "diffuse"}
            unused_tags |= {self.tag(name) for name in ("extra", *removed_tags)}
            for child in [child for child in plain_node.iter() if child.tag in unused_tags]:
                child.getparent().remove(child)
            try:
                effect = self._effect(plain_node)
            except Exception:  # as above
                continue
            if effect.diffuse is not None:
                return effect, "only its diffuse colour is used"
        return _grey(node.get("id")), "grey is used"

    def _loadMaterials(self) -> None:  # noqa: N802  # pycollada calls it
        """Load all materials, and add a grey one for each that is broken or absent."""
        for library in self.xmlnode.findall(self.tag("library_materials")):
            for node in library.findall(self.tag("material")):
                self.materials.append(self._material(node))
        for node in self._elements("instance_material"):
            name = (node.get("target") or "").removeprefix("#")
            node.set("target", f"#{name}")
            if name not in self.materials:
                self._broken_materials[name] = "no material has that id; grey is used"
                self.materials.append(Material(name, name, _grey(name)))

    def _material(self, node: Any) -> Material:
        name = node.get("id") or ""
        try:
            material = Material.load(self, {}, node)
        except Exception as error:  # as above
            self._broken_materials[name] = f"{_reason(error)}; grey is used"
            return Material(name, name, _grey(name), xmlnode=node)
        if reason := self._broken_effects.get(material.effect.id):
            self._broken_materials[name] = reason
        return material

    def _loadGeometry(self) -> None:  # noqa: N802  # pycollada calls it
        """Load all geometries; a skin is not applied to its geometry."""
        for library in self.xmlnode.findall(self.tag("library_geometries")):
            for node in library.findall(self.tag("geometry")):
                if (mesh := node.find(self.tag("mesh"))) is not None:
                    for lines in mesh.findall(self.tag("linestrips")):
                        mesh.remove(lines)
                    self._load_geometry(node)
        self._n_errors = len(self.errors)
        self._leave_out_skins()

    def _load_geometry(self, node: Any) -> None:
        name = node.get("id") or ""
        with warnings.catch_warnings():
            warnings.filterwarnings("error", "string or file could not be read")
            try:
                self.geometries.append(Geometry.load(self, {}, node))
            except Exception as error:  # as above, and of numpy
                self._broken_geometries[name] = _reason(error)

    def _leave_out_skins(self) -> None:
        """Replace every instance of a controller by an instance of its geometry."""
        sources = {
            node.get("id"): (child.get("source") or "").removeprefix("#")
            for node in self._elements("controller")
            for child in node
            if child.tag in (self.tag("skin"), self.tag("morph"))
        }
        for node in self._elements("instance_controller"):
            name = (node.get("url") or "").removeprefix("#")
            geometry = sources.get(sources.get(name, ""), sources.get(name))
            if geometry is not None:
                node.tag = self.tag("instance_geometry")
                node.set("url", f"#{geometry}")
                self._remarks.append(
                    f"controller {_quote_name(name)} is not applied: "
                    "its geometry is used as modelled"
                )

    def _loadControllers(self) -> None:  # noqa: N802  # pycollada calls it
        """Load none: controllers are not applied."""


def _grey(name: str | None) -> Effect:
    return Effect(name or "", [], "phong", diffuse=GREY)


def _reason(error: Exception) -> str:
    """Return why something cannot be read; pycollada's own errors name it, others do not."""
    if isinstance(error, DaeError):
        return _MESSAGE_TAIL.sub("", str(error.msg))[:200]
    if isinstance(error, DaeMissingSampler2D):
        return _MESSAGE_TAIL.sub("", str(error))[:200]
    return "malformed"


def _quote_name(name: str) -> str:
    return repr(name[:MAX_NAME_LENGTH])


def _cause_suffix(causes: list[str] | tuple[str, ...]) -> str:
    return f": {causes[0]}" if causes else ""


def _parts_of(
    node: Any, world_from_parent: Matrix, materials: dict[str, Any]
) -> Iterator[tuple[Matrix, trimesh.Trimesh]]:
    """Yield the triangles of a node and of its children, each with its pose."""
    if isinstance(node, GeometryNode):
        symbols = {binding.symbol: materials[binding.target.id] for binding in node.materials}
        for primitive in node.geometry.primitives:
            if (mesh := _mesh_of(primitive, symbols)) is not None:
                yield world_from_parent, mesh
    elif isinstance(node, Node):
        world_from_node = product(world_from_parent, node.matrix)
        for child in node.children or ():
            yield from _parts_of(child, world_from_node, materials)


def _mesh_of(primitive: Any, symbols: dict[str, Any]) -> trimesh.Trimesh | None:
    """Return the triangles of a primitive; None for lines and for a primitive without vertices."""
    if isinstance(primitive, collada.polylist.Polylist):
        primitive = _triangles_of(primitive)
    if not isinstance(primitive, collada.triangleset.TriangleSet) or primitive.vertex is None:
        return None
    corners = primitive.vertex[primitive.vertex_index].reshape(-1, 3)
    visuals: Any = trimesh.visual
    visual, colours = None, None
    if primitive.material in symbols:
        visual = visuals.TextureVisuals(uv=_uvs_of(primitive), material=symbols[primitive.material])
    elif (sources := primitive.sources.get("COLOR")) and len(primitive.index):
        indices = primitive.index[:, :, sources[0][0]]
        colours = sources[0][4].data[indices].reshape(len(corners), -1)
    return trimesh.Trimesh(
        vertices=corners,
        faces=np.arange(len(corners)).reshape(-1, 3),
        vertex_normals=_normals_of(primitive),
        vertex_colors=colours,
        visual=visual,
    )


def _triangles_of(primitive: Any) -> Any:
    """Cut the polygons of a primitive into triangles, without the notches of concave ones."""
    if primitive.vertex is None or not len(primitive.index):
        return primitive.triangleset()
    triangles = triangulate(primitive.vertex[primitive.vertex_index], primitive.vcounts)
    corners = primitive.index[triangles.ravel()].ravel()
    return collada.triangleset.TriangleSet(
        primitive.sources, primitive.material, corners, primitive.xmlnode
    )


def _normals_of(primitive: Any) -> npt.NDArray[np.float64] | None:
    """Return the normals of the corners, so that corners with different normals are not merged."""
    if primitive.normal is None:
        return None
    normals: npt.NDArray[np.float64] = primitive.normal[primitive.normal_index]
    return normals.reshape(-1, 3)


def _uvs_of(primitive: Any) -> npt.NDArray[np.float64] | None:
    if not len(primitive.texcoordset):
        return None
    uvs: npt.NDArray[np.float64] = primitive.texcoordset[0][primitive.texcoord_indexset[0]]
    return uvs.reshape(-1, 2)


def _material_of(effect: Effect, references: References) -> Any:
    """Convert the diffuse colour or image of an effect to a material of trimesh."""
    colour, image = np.ones(4), None
    if isinstance(effect.diffuse, Map):
        try:
            name = effect.diffuse.sampler.surface.image.path
        except Exception:  # pycollada has no image there
            name = None
        image = None if name is None else references.image(name)
    elif effect.diffuse is not None:
        colour = np.asarray(effect.diffuse, dtype=np.float64)
    materials: Any = trimesh.visual.material
    return materials.PBRMaterial(baseColorFactor=colour, baseColorTexture=image)

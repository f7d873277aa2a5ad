"""Collada files, read by pycollada: what it cannot read is reported, not silently left out.

pycollada leaves out a geometry whose material is broken. Here such a material is replaced by its
diffuse colour, or by grey; what is lost for another reason gets a remark.
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
from .polygons import cut
from .references import References

GREY = (0.7, 0.7, 0.7, 1.0)
"""The colour of a material that cannot be read."""
MAX_REMARKS = 20
"""Most remarks about one file."""
MAX_SHOWN = 80
"""Most letters of a name of the file in a remark."""

Matrix = npt.NDArray[np.float64]
_TAIL = re.compile(r" in (effect|node|material) .*", re.DOTALL)
_UNUSED = re.compile(r"Camera |Light |Invalid url in (camera|light) |Unknown input semantic")
_NOT_FOUND = re.compile(r"(?:Geometry|Node) #(.*) not found in library", re.DOTALL)


def read_parts(
    data: bytes, references: References
) -> tuple[list[tuple[Matrix, trimesh.Trimesh]], tuple[str, ...]]:
    """Return the meshes of a file with the poses of their nodes, and remarks on what is broken.

    Args:
        data: the file.
        references: reads its images.

    Raises:
        AssetError: it has no scene, or broken parts alone.
    """
    document = _Document(io.BytesIO(data), ignore=[DaeError])
    remarks = document.remarks()
    if document.scene is None:
        causes = [error.msg for error in document.errors]
        raise AssetError(f"has no scene that can be read{_because(causes)}")
    materials = {each.id: _look(each.effect, references) for each in document.materials}
    parts = [
        part for node in document.scene.nodes for part in _parts_of(node, np.eye(4), materials)
    ]
    if remarks and not any(len(mesh.faces) for _, mesh in parts):
        raise AssetError(f"holds no triangles that can be read{_because(remarks)}")
    return parts, remarks[:MAX_REMARKS]


class _Document(collada.Collada):  # type: ignore[misc]  # pycollada has no types
    """A file whose materials are all there, broken ones as plain colours."""

    def __init__(self, file: io.BytesIO, ignore: list[type]) -> None:
        self._broken_effects: dict[str, str] = {}
        self._broken_materials: dict[str, str] = {}
        self._broken_geometries: dict[str, str] = {}
        self._remarks: list[str] = []
        self._n_errors = 0
        super().__init__(file, ignore=ignore)

    def remarks(self) -> tuple[str, ...]:
        """Return what of the scene is broken, with the reason."""
        used = (node.get("target")[1:] for node in self._all("instance_material"))
        said = [
            f"material {_shown(name)} cannot be read ({self._broken_materials[name]})"
            for name in used
            if name in self._broken_materials
        ]
        said += self._remarks
        for error in self.errors[self._n_errors :]:
            if not _UNUSED.match(error.msg):
                said.append(f"{self._what_is_lost(error.msg)}: it is left out")
        return tuple(dict.fromkeys(said))

    def _what_is_lost(self, message: str) -> str:
        found = _NOT_FOUND.fullmatch(message)
        if found and found[1] in self._broken_geometries:
            why = self._broken_geometries[found[1]]
            return f"geometry {_shown(found[1])} cannot be read ({why})"
        return f"a part of its scene cannot be read ({message[:200]})"

    def _all(self, kind: str) -> Iterator[Any]:
        yield from self.xmlnode.getroot().iter(self.tag(kind))

    def _loadEffects(self) -> None:  # noqa: N802  # pycollada calls it
        """Load all effects; of a broken one its diffuse colour, else grey."""
        for library in self.xmlnode.findall(self.tag("library_effects")):
            for node in library.findall(self.tag("effect")):
                try:
                    effect = self._effect(node)
                except Exception as error:  # pycollada raises many kinds on broken effects
                    effect, kept = self._replaced(node)
                    self._broken_effects[effect.id] = f"{_reason(error)}; {kept}"
                self.effects.append(effect)

    def _effect(self, node: Any) -> Effect:
        effect = Effect.load(self, {}, node)
        texture = node.find(f".//{self.tag('diffuse')}/{self.tag('texture')}")
        if texture is not None and not isinstance(effect.diffuse, Map):  # left black by pycollada
            raise DaeBrokenRefError(f"Missing image {texture.get('texture')!r}")
        return effect

    def _replaced(self, node: Any) -> tuple[Effect, str]:
        for without in ((), ("newparam",)):
            plain = copy.deepcopy(node)
            unused = {self.tag(each) for each in Effect.supported if each != "diffuse"}
            unused |= {self.tag(each) for each in ("extra", *without)}
            for each in [each for each in plain.iter() if each.tag in unused]:
                each.getparent().remove(each)
            try:
                effect = self._effect(plain)
            except Exception:  # as above
                continue
            if effect.diffuse is not None:
                return effect, "of its looks the diffuse one is used"
        return _grey(node.get("id")), "grey is used"

    def _loadMaterials(self) -> None:  # noqa: N802  # pycollada calls it
        """Load all materials, and add a grey one for each that is broken or not there."""
        for library in self.xmlnode.findall(self.tag("library_materials")):
            for node in library.findall(self.tag("material")):
                self.materials.append(self._material(node))
        for node in self._all("instance_material"):
            name = (node.get("target") or "").removeprefix("#")
            node.set("target", f"#{name}")
            if name not in self.materials:
                self._broken_materials[name] = "there is none of that id; grey is used"
                self.materials.append(Material(name, name, _grey(name)))

    def _material(self, node: Any) -> Material:
        name = node.get("id") or ""
        try:
            material = Material.load(self, {}, node)
        except Exception as error:  # as above
            self._broken_materials[name] = f"{_reason(error)}; grey is used"
            return Material(name, name, _grey(name), xmlnode=node)
        if why := self._broken_effects.get(material.effect.id):
            self._broken_materials[name] = why
        return material

    def _loadGeometry(self) -> None:  # noqa: N802  # pycollada calls it
        """Load all geometries; those of a skin are used without it."""
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
        """Make an instance of its geometry of every instance of a controller."""
        sources = {
            node.get("id"): (each.get("source") or "").removeprefix("#")
            for node in self._all("controller")
            for each in node
            if each.tag in (self.tag("skin"), self.tag("morph"))
        }
        for node in self._all("instance_controller"):
            name = (node.get("url") or "").removeprefix("#")
            geometry = sources.get(sources.get(name, ""), sources.get(name))
            if geometry is not None:
                node.tag = self.tag("instance_geometry")
                node.set("url", f"#{geometry}")
                self._remarks.append(
                    f"controller {_shown(name)} is not applied: its geometry is used as modelled"
                )

    def _loadControllers(self) -> None:  # noqa: N802  # pycollada calls it
        """Load none: they are not applied."""


def _grey(name: str | None) -> Effect:
    return Effect(name or "", [], "phong", diffuse=GREY)


def _reason(error: Exception) -> str:
    """Return why something cannot be read; pycollada's own errors name it, others do not."""
    if isinstance(error, DaeError):
        return _TAIL.sub("", str(error.msg))[:200]
    if isinstance(error, DaeMissingSampler2D):
        return _TAIL.sub("", str(error))[:200]
    return "malformed"


def _shown(name: str) -> str:
    return repr(name[:MAX_SHOWN])


def _because(causes: list[str] | tuple[str, ...]) -> str:
    return f": {causes[0]}" if causes else ""


def _parts_of(
    node: Any, world_from_parent: Matrix, materials: dict[str, Any]
) -> Iterator[tuple[Matrix, trimesh.Trimesh]]:
    """Give the triangles of a node and of those in it, each with its pose."""
    if isinstance(node, GeometryNode):
        symbols = {each.symbol: materials[each.target.id] for each in node.materials}
        for primitive in node.geometry.primitives:
            if (mesh := _mesh_of(primitive, symbols)) is not None:
                yield world_from_parent, mesh
    elif isinstance(node, Node):
        world_from_node = product(world_from_parent, node.matrix)
        for child in node.children or ():
            yield from _parts_of(child, world_from_node, materials)


def _mesh_of(primitive: Any, symbols: dict[str, Any]) -> trimesh.Trimesh | None:
    """Return the triangles of a primitive; None of lines and of what has no vertices."""
    if isinstance(primitive, collada.polylist.Polylist):
        primitive = _triangles_of(primitive)
    if not isinstance(primitive, collada.triangleset.TriangleSet) or primitive.vertex is None:
        return None
    corners = primitive.vertex[primitive.vertex_index].reshape(-1, 3)
    visuals: Any = trimesh.visual
    visual, colours = None, None
    if primitive.material in symbols:
        visual = visuals.TextureVisuals(uv=_uvs_of(primitive), material=symbols[primitive.material])
    elif (given := primitive.sources.get("COLOR")) and len(primitive.index):
        colours = given[0][4].data[primitive.index[:, :, given[0][0]]].reshape(len(corners), -1)
    return trimesh.Trimesh(
        vertices=corners,
        faces=np.arange(len(corners)).reshape(-1, 3),
        vertex_normals=_normals_of(primitive),
        vertex_colors=colours,
        visual=visual,
    )


def _triangles_of(primitive: Any) -> Any:
    """Return the polygons of a primitive as triangles; pycollada's fans cover what is notched."""
    if primitive.vertex is None or not len(primitive.index):
        return primitive.triangleset()
    triangles = cut(primitive.vertex[primitive.vertex_index], primitive.vcounts)
    corners = primitive.index[triangles.ravel()].ravel()
    return collada.triangleset.TriangleSet(
        primitive.sources, primitive.material, corners, primitive.xmlnode
    )


def _normals_of(primitive: Any) -> npt.NDArray[np.float64] | None:
    """Return the normals of the corners: those of different normals are not merged."""
    if primitive.normal is None:
        return None
    normals: npt.NDArray[np.float64] = primitive.normal[primitive.normal_index]
    return normals.reshape(-1, 3)


def _uvs_of(primitive: Any) -> npt.NDArray[np.float64] | None:
    if not len(primitive.texcoordset):
        return None
    uvs: npt.NDArray[np.float64] = primitive.texcoordset[0][primitive.texcoord_indexset[0]]
    return uvs.reshape(-1, 2)


def _look(effect: Effect, references: References) -> Any:
    """Return the diffuse colour or image of an effect as trimesh has it."""
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

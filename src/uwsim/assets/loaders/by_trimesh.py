"""The reader of GLB, OBJ, STL, PLY, DAE, VRML and X3D files, with their images."""

from __future__ import annotations

import contextlib
import io
import logging
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path, PurePosixPath
from typing import Any

import numpy as np
import numpy.typing as npt

from ...base.files.input_files import read_bytes
from ...errors import AssetError
from ..collada_asset import ColladaAsset, read_collada_asset
from ..mesh import Mesh
from ..procedural.shapes import Shape, mesh
from . import (
    collada_limits,
    gltf_defects,
    gltf_limits,
    gltf_materials,
    gltf_rewriting,
    gltf_structure,
    mesh_cache,
    obj_rewriting,
)
from .directed_meshes import Directions, convert_directed, transform_directions
from .materials import Materials, check_image_size
from .mtl_materials import read_mtl_materials
from .obj_lines import find_invalid_line
from .references import References

MESH_FORMATS = (".glb", ".gltf", ".obj", ".stl", ".ply", ".dae", ".wrl", ".x3d", ".x3dv")
"""The formats that are read without an external program."""
GLTF_FORMATS = (".glb", ".gltf")
"""The suffixes of glTF files."""
VRML_FORMATS = (".wrl", ".x3d", ".x3dv")
"""The suffixes of VRML and X3D files."""

MAX_TRIANGLES = 4_000_000
"""The greatest number of triangles of a model."""

MAX_FILE_BYTES = 256 * 2**20
"""The greatest size of a file [bytes]."""
MAX_TEXT_BYTES = 64 * 2**20
"""The greatest size of a text file [bytes]: reading it takes some twenty times as much memory."""

STL_HEADER_BYTES = 80
"""The length of the header of a binary STL file [bytes]."""

MAX_COORDINATE = 1e6
"""The greatest coordinate of a vertex [m]; only broken files have greater ones."""


@dataclass(frozen=True, eq=False)
class Part:
    """A mesh of a file at the pose of its node."""

    geometry: Any
    """The transformed mesh of trimesh, without materials."""
    visual: Any
    """The materials and texture coordinates of trimesh."""
    directions: Directions | None
    """The normals and tangents of the file, where it has maps."""


def read_meshes(
    path: Path,
    *,
    name: str = "",
    allowed_folders: tuple[Path, ...] = (),
    original: Path | None = None,
) -> tuple[tuple[Mesh, ...], ColladaAsset | None, tuple[str, ...]]:
    """Return the meshes of a file in the file's frame and units, its Collada asset, and remarks.

    The remarks are on parts that cannot be read, and were left out or replaced. Normals are
    computed anew from the faces, unless the material has maps of a glTF file. Colours of vertices
    become one mean colour a mesh.

    Args:
        path: The file.
        name: The name by which it was looked up.
        allowed_folders: The folders of its materials and images; by default the file's folder.
        original: The file before its conversion; images may be next to this file as well.

    Raises:
        AssetError: The file is broken, empty or too large.
    """
    with _raise_asset_errors(path):
        data = _read_checked(path, name or path.name, original)
        asset = read_collada_asset(data) if path.suffix.lower() == ".dae" else None
        file = mesh_cache.cache_file(data, path.suffix.lower())
        cached_meshes = mesh_cache.read(file) if original is None else None
        if cached_meshes is not None:
            return cached_meshes, asset, ()
        references = _references(path, name or path.name, allowed_folders, original)
        parts, materials, remarks = _parts(path, data, references)
    meshes, image_remarks = _meshes(path, parts, materials, references)
    remarks = tuple(f"{original or path}: {remark}" for remark in (*remarks, *image_remarks))
    if original is None and not references.were_requested and not remarks:
        mesh_cache.store(file, meshes)
    return meshes, asset, remarks


@contextlib.contextmanager
def _raise_asset_errors(path: Path) -> Iterator[None]:
    """Convert every error of the readers to one `AssetError` that names the file."""
    try:
        yield
    except AssetError as error:
        message = str(error)
        raise AssetError(message if f"{path}:" in message else f"{path}: {message}.") from error
    except PermissionError:
        raise
    except (Exception, RecursionError) as error:  # trimesh raises whatever its parsers raise
        messages = str(error).strip().splitlines()
        reason = messages[0][:200] if messages else ""
        if path.suffix.lower() == ".obj" and (place := find_invalid_line(path.read_bytes())):
            raise AssetError(f"{path}:{place}.") from error
        if path.suffix.lower() in GLTF_FORMATS and not isinstance(error, OSError):
            raise AssetError(
                f"{path}: not valid glTF 2.0; a validator of glTF names the entry at fault."
            ) from error
        raise AssetError(
            f"{path}: not a {path.suffix.lower()} file that can be read "
            f"({type(error).__name__}{': ' + reason if reason else ''})."
        ) from error


def _meshes(
    path: Path, parts: list[Part], materials: Materials, references: References
) -> tuple[tuple[Mesh, ...], list[str]]:
    """Return the meshes with their materials, and remarks on images that cannot be read."""
    optional_meshes = [
        _convert_part(part, materials, path) for part in parts if len(part.geometry.faces)
    ]
    meshes = tuple(part_mesh for part_mesh in optional_meshes if part_mesh is not None)
    if not meshes:
        raise AssetError(f"{path}: none of its triangles has an area.")
    names = references.broken_images(is_decoded=materials.has_broken_image)
    broken_images = [f"its image {name[:200]!r}" for name in names]
    if materials.has_broken_image and not broken_images:
        broken_images = ["an image in it"]
    end = "cannot be read: the colour of its material is used"
    return meshes, [f"{image} {end}" for image in broken_images]


def _read_checked(path: Path, name: str, original: Path | None) -> bytes:
    """Return the bytes of a file; converted files are not recorded, as the original file is."""
    suffix = path.suffix.lower()
    if original is not None and suffix in (".obj", ".mtl"):
        return path.read_bytes()
    data = read_bytes(path, name=name, at_most=MAX_FILE_BYTES)
    if len(data) > MAX_TEXT_BYTES and _is_text(data, suffix):
        max_mib = MAX_TEXT_BYTES >> 20
        raise AssetError(f"{path}: is text of more than {max_mib} MiB; write it as .glb or .stl.")
    # a Collada file needs no document type; one that has it may be a trap
    if suffix == ".dae" and (b"<!DOCTYPE" in data or b"<!ENTITY" in data):
        raise AssetError(f"{path}: document types and entities are not read.")
    if limit_error := _limit_error(data, suffix):
        raise AssetError(f"{path}: {limit_error}.")
    return data


def _limit_error(data: bytes, suffix: str) -> str:
    if suffix == ".dae":
        return collada_limits.limit_error(data)
    if suffix not in GLTF_FORMATS:
        return ""
    return gltf_limits.limit_error(data, suffix) or gltf_structure.structure_error(data, suffix)


def _read_reference(path: Path, name: str, original: Path | None, suffix: str) -> bytes:
    data = _read_checked(path, name, original)
    check_image_size(data, path)
    return to_utf8(data, suffix)


def _is_text(data: bytes, suffix: str) -> bool:
    """Return whether a format takes far more memory to read than to store."""
    if suffix == ".stl":
        return not _is_binary_stl(data)
    is_text = suffix in (".obj", ".dae", ".gltf", ".mtl", *VRML_FORMATS)
    return is_text or b"format ascii" in data[:200]


def _references(
    path: Path, name: str, allowed_folders: tuple[Path, ...], original: Path | None
) -> References:
    folders = [path.parent, *([] if original is None else [original.parent])]
    allowed_folders = allowed_folders or (path.absolute().parent,)
    return References(
        folders,
        [path.parent, *allowed_folders] if original is not None else allowed_folders,
        lambda file, place: _read_reference(
            file, str(PurePosixPath(name).parent / place), original, place.suffix.lower()
        ),
    )


def _parts(
    path: Path, data: bytes, references: References
) -> tuple[list[Part], Materials, tuple[str, ...]]:
    """Return the meshes of a file at the poses of its nodes, their materials, and remarks."""
    import trimesh

    logging.getLogger("trimesh").setLevel(logging.CRITICAL)
    suffix = path.suffix.lower()
    is_gltf = suffix in GLTF_FORMATS
    numbers, material_remarks = gltf_materials.read_materials(data, suffix) if is_gltf else ({}, [])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            if suffix == ".dae":
                from .collada_file import read_parts

                posed_parts, remarks = read_parts(data, references)
            elif suffix == ".ply":
                from . import ply_file

                posed_parts, remarks = ply_file.read_parts(to_utf8(data, suffix), references), ()
            elif suffix in VRML_FORMATS:
                from .scene_graphs.vrml_file import read_parts as read_vrml_parts

                posed_parts, remarks = read_vrml_parts(data, suffix, references)
            else:
                posed_parts, remarks = _read_by_trimesh(data, suffix, references), ()
            if is_gltf:
                remarks = tuple(gltf_defects.read_defects(data, suffix, references.get))
        finally:
            references.check()
        meshes = [item for item in posed_parts if isinstance(item[1], trimesh.Trimesh)]
        _check_triangle_count(path, sum(len(part.faces) for _, part in meshes))
        if suffix == ".obj":
            used_materials = [getattr(part.visual, "material", None) for _, part in meshes]
            numbers = read_mtl_materials(used_materials, references)
            references.check()
        parts = [
            Part(
                _transform_part(part, transform),
                part.visual,
                transform_directions(part.vertex_attributes, transform),
            )
            for transform, part in meshes
        ]
        return parts, Materials(path, numbers), (*remarks, *material_remarks)


def _read_by_trimesh(data: bytes, suffix: str, references: References) -> list[tuple[Any, Any]]:
    """Return the pose and the geometry of each node."""
    import trimesh

    if suffix in GLTF_FORMATS:
        data = gltf_rewriting.rewrite(data, suffix, references.get)
    data = to_utf8(data, suffix)
    if suffix == ".obj":
        data = obj_rewriting.rewrite(data)
    resolver: Any = references
    scene = trimesh.load_scene(
        io.BytesIO(data), file_type=suffix.lstrip("."), resolver=resolver, process=False
    )
    instances = [scene.graph[node] for node in scene.graph.nodes_geometry]
    return [(transform, scene.geometry[geometry]) for transform, geometry in instances]


def _check_triangle_count(path: Path, n_triangles: int) -> None:
    if n_triangles == 0:
        raise AssetError(f"{path}: has no triangles.")
    if n_triangles > MAX_TRIANGLES:
        raise AssetError(f"{path}: has {n_triangles} triangles; expected at most {MAX_TRIANGLES}.")


def _transform_part(part: Any, transform: npt.NDArray[np.float64]) -> Any:
    """Return a transformed copy without materials, so that images are not copied."""
    import trimesh

    transformed_part = trimesh.Trimesh(vertices=part.vertices, faces=part.faces, process=False)
    transformed_part.apply_transform(transform)
    return transformed_part


def to_utf8(data: bytes, suffix: str) -> bytes:
    """Convert the text of a mesh or material file from Latin-1 to UTF-8, if it is not UTF-8.

    Old modelling programs write comments and names in Latin-1.
    """
    text, rest = data, b""
    if suffix == ".stl" and _is_binary_stl(data):
        text, rest = data[:STL_HEADER_BYTES], data[STL_HEADER_BYTES:]
    elif suffix == ".ply":
        head, mark, body = data.partition(b"end_header")
        text, rest = head, mark + body
    elif suffix not in (".obj", ".mtl", ".stl"):
        return data
    try:
        text.decode("utf-8")
    except UnicodeDecodeError:
        if rest and suffix == ".stl":  # a header of fixed length
            return text.decode("ascii", "replace").replace("\ufffd", "?").encode() + rest
        return text.decode("latin-1").encode("utf-8") + rest
    return data


def _is_binary_stl(data: bytes) -> bool:
    """Return whether the length of the file fits the number of triangles behind its header."""
    count = int.from_bytes(data[STL_HEADER_BYTES : STL_HEADER_BYTES + 4], "little")
    return len(data) == STL_HEADER_BYTES + 4 + 50 * count


def _convert_part(part: Part, materials: Materials, path: Path) -> Mesh | None:
    """Convert a mesh of trimesh; None when it has no area."""
    vertices = np.asarray(part.geometry.vertices, dtype=np.float64)
    faces = np.asarray(part.geometry.faces, dtype=np.int64)
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        place = find_invalid_line(path.read_bytes()) if path.suffix.lower() == ".obj" else ""
        location = f":{place}" if place else ": its vertices do not have 3 numbers"
        raise AssetError(f"{path}{location}.")
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise AssetError(f"{path}: a triangle has the index of a vertex that does not exist.")
    if not np.isfinite(vertices).all() or np.abs(vertices).max() > MAX_COORDINATE:
        raise AssetError(f"{path}: has vertices that are infinite or beyond {MAX_COORDINATE:g} m.")
    uvs = np.zeros((len(vertices), 2))
    appearance = materials.appearance(part.visual)
    uv_values = getattr(part.visual, "uv", None)
    if uv_values is not None and np.shape(uv_values) == (len(vertices), 2):
        uv_values = np.asarray(uv_values, dtype=np.float64)
        uvs = np.where(np.isfinite(uv_values), uv_values, 0.0)
    shape = Shape(vertices[faces], uvs[faces])
    if shape.area <= 0.0:
        return None
    if appearance.has_maps and part.directions is not None and part.directions.fits(vertices):
        return convert_directed(vertices, faces, uvs, part.directions, appearance)
    plain_mesh = mesh(shape, colour=appearance.colour, texture=appearance.texture, two_sided=True)
    if appearance.material is None:
        return plain_mesh
    return replace(
        plain_mesh,
        opacity=appearance.opacity,
        two_sided=appearance.two_sided,
        material=appearance.material,
    )

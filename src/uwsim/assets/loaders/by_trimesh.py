"""GLB, OBJ, STL, PLY and DAE files, read by trimesh, with their pictures."""

from __future__ import annotations

import io
import logging
import warnings
from pathlib import Path, PurePosixPath
from typing import Any

import numpy as np
import numpy.typing as npt

from ...errors import AssetError
from ...input_files import read_bytes
from ..mesh import Mesh, Texture
from ..procedural.shapes import Shape, mesh
from .obj_lines import wrong_line

READABLE = (".glb", ".gltf", ".obj", ".stl", ".ply", ".dae")
"""Formats that are read without help from outside."""

LARGEST_MODEL = 4_000_000
"""Models with more triangles are refused."""

LARGEST_PICTURE = 2048
"""Textures are reduced to this many pixels a side."""

STL_HEADER = 80
"""Length [bytes] of what a binary STL file says of itself."""

FARTHEST = 1e6
"""Vertices farther out than this [m] are taken for a broken file."""


def read_meshes(
    path: Path,
    *,
    name: str = "",
    max_triangles: int | None = None,
    original: Path | None = None,
) -> tuple[Mesh, ...]:
    """The meshes of a file, in its own frame and units; axes are left as they are.

    Normals are computed anew from the faces. Colours of vertices become one mean colour a mesh.

    Args:
        path: The file.
        name: What it was asked for by.
        max_triangles: Simplified to about this many in all when there are more.
        original: What the file was converted from; pictures are looked for beside it, too.

    Raises:
        AssetError: Broken, empty or too large.
    """
    try:
        parts = _geometries(path, name or path.name, original)
    except (AssetError, PermissionError):
        raise
    except (Exception, RecursionError) as error:  # trimesh raises whatever its parsers raise
        said = str(error).strip().splitlines()
        why = said[0][:200] if said else ""
        if path.suffix.lower() == ".obj" and (place := wrong_line(path.read_bytes())):
            raise AssetError(f"{path}:{place}.") from error
        raise AssetError(
            f"{path}: not a {path.suffix.lower()} file that can be read "
            f"({type(error).__name__}{': ' + why if why else ''})."
        ) from error
    total = sum(len(part.faces) for part in parts)
    if total == 0:
        raise AssetError(f"{path}: holds no triangles.")
    if total > LARGEST_MODEL:
        raise AssetError(f"{path}: {total} triangles; at most {LARGEST_MODEL} are read.")
    keep = 1.0 if max_triangles is None else min(1.0, max_triangles / total)
    made = [_mesh(part, path, keep) for part in parts if len(part.faces)]
    meshes = tuple(found for found in made if found is not None)
    if not meshes:
        raise AssetError(f"{path}: all of its triangles are without area.")
    return meshes


def _bytes(path: Path, name: str, original: Path | None) -> bytes:
    """A file of a model; what was converted follows from its original and is not recorded."""
    if original is not None and path.suffix.lower() in (".obj", ".mtl"):
        return path.read_bytes()
    data = read_bytes(path, name=name)
    # a Collada file needs no document type; one that has it may be a trap
    if path.suffix.lower() == ".dae" and (b"<!DOCTYPE" in data or b"<!ENTITY" in data):
        raise AssetError(f"{path}: document types and entities are not read.")
    return data


def _geometries(path: Path, name: str, original: Path | None) -> list[Any]:
    import trimesh

    class Folders(trimesh.resolvers.FilePathResolver):
        """Looks for a picture in the file's folder, then beside the original."""

        def get(self, wanted: str) -> bytes:
            asked = PurePosixPath(wanted.strip().replace("\\", "/"))
            for folder in (path.parent, None if original is None else original.parent):
                for place in (asked, PurePosixPath(asked.name)):
                    if folder is not None and (folder / place).is_file():
                        called = str(PurePosixPath(name).parent / place)
                        found = _bytes(folder / place, called, original)
                        return in_utf8(found, place.suffix.lower())
            raise FileNotFoundError(wanted)

    logging.getLogger("trimesh").setLevel(logging.CRITICAL)
    suffix = path.suffix.lower()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        scene = trimesh.load_scene(
            io.BytesIO(in_utf8(_bytes(path, name, original), suffix)),
            file_type=suffix.lstrip("."),
            resolver=Folders(str(path)),
            process=False,
        )
        dumped = scene.dump(concatenate=False)
    return [part for part in dumped if isinstance(part, trimesh.Trimesh)]


def in_utf8(data: bytes, suffix: str) -> bytes:
    """What is text in a mesh file or its materials, as UTF-8; other than that it is Latin-1.

    Old modellers write the comments and names of their users' languages so.
    """
    text, rest = data, b""
    if suffix == ".stl" and _is_binary_stl(data):
        text, rest = data[:STL_HEADER], data[STL_HEADER:]
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
    """Whether the file is as long as the number of triangles behind its header says."""
    count = int.from_bytes(data[STL_HEADER : STL_HEADER + 4], "little")
    return len(data) == STL_HEADER + 4 + 50 * count


def _mesh(part: Any, path: Path, keep: float) -> Mesh | None:
    """One trimesh mesh as ours; None when it has no area."""
    vertices = np.asarray(part.vertices, dtype=np.float64)
    faces = np.asarray(part.faces, dtype=np.int64)
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        place = wrong_line(path.read_bytes()) if path.suffix.lower() == ".obj" else ""
        where = f":{place}" if place else ": vertices of other than 3 numbers"
        raise AssetError(f"{path}{where}.")
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise AssetError(f"{path}: a triangle names a vertex that is not there.")
    if not np.isfinite(vertices).all() or np.abs(vertices).max() > FARTHEST:
        raise AssetError(f"{path}: vertices that are not finite or beyond {FARTHEST:g} m.")
    uvs = np.zeros((len(vertices), 2))
    colour, texture = _look(part, path)
    given = getattr(part.visual, "uv", None)
    if given is not None and np.shape(given) == (len(vertices), 2):
        uvs = np.nan_to_num(np.asarray(given, dtype=np.float64))
    if keep < 1.0:
        vertices, faces, uvs = _simplified(vertices, faces, uvs, keep)
    shape = Shape(vertices[faces], uvs[faces])
    if shape.area <= 0.0:
        return None
    return mesh(shape, colour=colour, texture=texture, two_sided=True)


def _simplified(
    vertices: npt.NDArray[np.float64],
    faces: npt.NDArray[np.int64],
    uvs: npt.NDArray[np.float64],
    keep: float,
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int64], npt.NDArray[np.float64]]:
    """Fewer triangles; texture coordinates are taken from the nearest old vertex."""
    import fast_simplification
    from scipy.spatial import cKDTree

    _, first, number = np.unique(vertices, axis=0, return_index=True, return_inverse=True)
    welded = vertices[first]
    points, triangles = fast_simplification.simplify(
        welded.astype(np.float32), number.ravel()[faces].astype(np.int32), 1.0 - keep
    )
    if not len(triangles):
        return vertices, faces, uvs
    points = np.asarray(points, dtype=np.float64)
    _, nearest = cKDTree(vertices).query(points)
    return points, np.asarray(triangles, dtype=np.int64), uvs[nearest]


def _look(part: Any, path: Path) -> tuple[tuple[float, float, float], Texture | None]:
    """Colour and picture of a trimesh mesh."""
    material = getattr(part.visual, "material", None)
    if material is None:
        if getattr(part.visual, "kind", None) not in ("face", "vertex"):
            return (0.7, 0.7, 0.7), None
        colours = np.asarray(part.visual.face_colors, dtype=np.float64)
        red, green, blue = (colours[:, :3].mean(axis=0) / 255.0).tolist()
        return (red, green, blue), None
    image = getattr(material, "baseColorTexture", None) or getattr(material, "image", None)
    factor = getattr(material, "baseColorFactor", None)
    if factor is None and hasattr(material, "diffuse"):
        factor = material.diffuse
    numbers = np.asarray(factor if factor is not None else (255, 255, 255), dtype=np.float64)
    numbers = numbers[:3] / (255.0 if numbers.max() > 1.0 else 1.0)
    if image is None:
        red, green, blue = np.clip(numbers, 0.0, 1.0).tolist()
        return (red, green, blue), None
    try:
        picture = image.convert("RGB")
        picture.thumbnail((LARGEST_PICTURE, LARGEST_PICTURE))
        pixels = np.array(picture, dtype=np.uint8)
    except Exception as error:
        raise AssetError(f"{path}: its picture cannot be read ({type(error).__name__}).") from error
    # A file's diffuse factor beside a picture is usually an exporter's default: not used.
    return (1.0, 1.0, 1.0), Texture(name=f"{path}#{id(part)}", pixels=pixels)

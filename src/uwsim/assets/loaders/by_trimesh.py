"""GLB, OBJ, STL, PLY and DAE files as trimesh has them, with their images."""

from __future__ import annotations

import contextlib
import io
import logging
import warnings
from collections.abc import Iterator
from pathlib import Path, PurePosixPath
from typing import Any

import numpy as np
import numpy.typing as npt

from ...base.files.input_files import read_bytes
from ...errors import AssetError
from ..collada_asset import ColladaAsset, read_collada_asset
from ..mesh import Mesh
from ..procedural.shapes import Shape, mesh
from . import collada_limits, gltf_limits, gltf_plain, mesh_cache, obj_plain
from .looks import Looks, check_size
from .obj_lines import wrong_line
from .references import References

READABLE = (".glb", ".gltf", ".obj", ".stl", ".ply", ".dae")
"""Formats that are read without help from outside."""

MAX_TRIANGLES = 4_000_000
"""Models with more triangles are refused."""

MAX_FILE_BYTES = 256 * 2**20
"""Largest file [bytes]."""
MAX_TEXT_BYTES = 64 * 2**20
"""Largest file of a format that is text [bytes]: reading it takes some twenty times as much."""

STL_HEADER = 80
"""Length [bytes] of what a binary STL file says of itself."""

MAX_COORDINATE = 1e6
"""Vertices farther out than this [m] are taken for a broken file."""


def read_meshes(
    path: Path,
    *,
    name: str = "",
    within: tuple[Path, ...] = (),
    original: Path | None = None,
) -> tuple[tuple[Mesh, ...], ColladaAsset | None, tuple[str, ...]]:
    """The meshes of a file in its own frame and units, and what a Collada file states of those.

    The last are remarks on what of it cannot be read, and was left out or replaced.

    Normals are computed anew from the faces. Colours of vertices become one mean colour a mesh.

    Args:
        path: The file.
        name: The name by which it was looked up.
        within: Folders that its materials and images may lie in; its own by default.
        original: What the file was converted from; images are looked for next to it, too.

    Raises:
        AssetError: Broken, empty or too large.
    """
    with _errors_as_ours(path):
        data = _bytes(path, name or path.name, original)
        asset = read_collada_asset(data) if path.suffix.lower() == ".dae" else None
        file = mesh_cache.file_of(data, path.suffix.lower())
        kept = mesh_cache.read(file) if original is None else None
        if kept is not None:
            return kept, asset, ()
        references = _references(path, name or path.name, within, original)
        parts, remarks = _parts(path, data, references)
    meshes, of_images = _meshes(path, parts, references)
    remarks = tuple(f"{original or path}: {remark}" for remark in (*remarks, *of_images))
    if original is None and not references.were_needed and not remarks:
        mesh_cache.keep(file, meshes)
    return meshes, asset, remarks


@contextlib.contextmanager
def _errors_as_ours(path: Path) -> Iterator[None]:
    """Make one `AssetError`, with the place, of whatever the readers of a file raise."""
    try:
        yield
    except AssetError as error:
        message = str(error)
        raise AssetError(message if f"{path}:" in message else f"{path}: {message}.") from error
    except PermissionError:
        raise
    except (Exception, RecursionError) as error:  # trimesh raises whatever its parsers raise
        messages = str(error).strip().splitlines()
        why = messages[0][:200] if messages else ""
        if path.suffix.lower() == ".obj" and (place := wrong_line(path.read_bytes())):
            raise AssetError(f"{path}:{place}.") from error
        raise AssetError(
            f"{path}: not a {path.suffix.lower()} file that can be read "
            f"({type(error).__name__}{': ' + why if why else ''})."
        ) from error


def _meshes(
    path: Path, parts: list[tuple[Any, Any]], references: References
) -> tuple[tuple[Mesh, ...], list[str]]:
    """The meshes with their looks, and remarks on images that cannot be read."""
    looks = Looks(path)
    made = [_mesh(part, looks, visual, path) for part, visual in parts if len(part.faces)]
    meshes = tuple(found for found in made if found is not None)
    if not meshes:
        raise AssetError(f"{path}: all of its triangles are without area.")
    names = references.broken_images(is_decoded=looks.has_broken_image)
    broken = [f"its image {name[:200]!r}" for name in names]
    if looks.has_broken_image and not broken:
        broken = ["an image in it"]
    end = "cannot be read: the colour of its material is used"
    return meshes, [f"{image} {end}" for image in broken]


def _bytes(path: Path, name: str, original: Path | None) -> bytes:
    """A file of a model; what was converted follows from its original and is not recorded."""
    suffix = path.suffix.lower()
    if original is not None and suffix in (".obj", ".mtl"):
        return path.read_bytes()
    data = read_bytes(path, name=name, at_most=MAX_FILE_BYTES)
    if len(data) > MAX_TEXT_BYTES and _is_text(data, suffix):
        most = MAX_TEXT_BYTES >> 20
        raise AssetError(f"{path}: is text of more than {most} MiB; write it as .glb or .stl.")
    # a Collada file needs no document type; one that has it may be a trap
    if suffix == ".dae" and (b"<!DOCTYPE" in data or b"<!ENTITY" in data):
        raise AssetError(f"{path}: document types and entities are not read.")
    if why := _too_much(data, suffix):
        raise AssetError(f"{path}: {why}.")
    return data


def _too_much(data: bytes, suffix: str) -> str:
    """Report which limit a file exceeds, before it is loaded; empty if none."""
    if suffix == ".dae":
        return collada_limits.too_much(data)
    return gltf_limits.too_much(data, suffix) if suffix in (".gltf", ".glb") else ""


def _referred(path: Path, name: str, original: Path | None, suffix: str) -> bytes:
    """A file that a model names."""
    data = _bytes(path, name, original)
    check_size(data, path)
    return in_utf8(data, suffix)


def _is_text(data: bytes, suffix: str) -> bool:
    """Whether it is a format that takes far more memory to read than to keep."""
    if suffix == ".stl":
        return not _is_binary_stl(data)
    return suffix in (".obj", ".dae", ".gltf", ".mtl") or b"format ascii" in data[:200]


def _references(
    path: Path, name: str, within: tuple[Path, ...], original: Path | None
) -> References:
    folders = [path.parent, *([] if original is None else [original.parent])]
    within = within or (path.absolute().parent,)
    return References(
        folders,
        [path.parent, *within] if original is not None else within,
        lambda found, place: _referred(
            found, str(PurePosixPath(name).parent / place), original, place.suffix.lower()
        ),
    )


def _parts(
    path: Path, data: bytes, references: References
) -> tuple[list[tuple[Any, Any]], tuple[str, ...]]:
    """The meshes of a file at the poses of its nodes, with their materials, and remarks."""
    import trimesh

    logging.getLogger("trimesh").setLevel(logging.CRITICAL)
    suffix = path.suffix.lower()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            if suffix == ".dae":
                from .collada_file import read_parts

                found, remarks = read_parts(data, references)
            elif suffix == ".ply":
                from . import ply_file

                found, remarks = ply_file.read_parts(in_utf8(data, suffix), references), ()
            else:
                found, remarks = _read_by_trimesh(data, suffix, references), ()
        finally:
            references.check()
        meshes = [each for each in found if isinstance(each[1], trimesh.Trimesh)]
        _check_number(path, sum(len(part.faces) for _, part in meshes))
        return [(_moved(part, transform), part.visual) for transform, part in meshes], remarks


def _read_by_trimesh(data: bytes, suffix: str, references: References) -> list[tuple[Any, Any]]:
    """The pose and the geometry of each node."""
    import trimesh

    if suffix in (".gltf", ".glb"):
        data = gltf_plain.plain(data, suffix, references.get)
    data = in_utf8(data, suffix)
    if suffix == ".obj":
        data = obj_plain.plain(data)
    resolver: Any = references
    scene = trimesh.load_scene(
        io.BytesIO(data),
        file_type=suffix.lstrip("."),
        resolver=resolver,
        process=False,
    )
    placed = [scene.graph[node] for node in scene.graph.nodes_geometry]
    return [(transform, scene.geometry[geometry]) for transform, geometry in placed]


def _check_number(path: Path, n_triangles: int) -> None:
    if n_triangles == 0:
        raise AssetError(f"{path}: holds no triangles.")
    if n_triangles > MAX_TRIANGLES:
        raise AssetError(f"{path}: {n_triangles} triangles; at most {MAX_TRIANGLES} are read.")


def _moved(part: Any, transform: npt.NDArray[np.float64]) -> Any:
    """A transformed copy without materials, so that images are not copied."""
    import trimesh

    moved = trimesh.Trimesh(vertices=part.vertices, faces=part.faces, process=False)
    moved.apply_transform(transform)
    return moved


def in_utf8(data: bytes, suffix: str) -> bytes:
    """The text of a mesh or material file as UTF-8; otherwise it is read as Latin-1.

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


def _mesh(part: Any, looks: Looks, visual: Any, path: Path) -> Mesh | None:
    """One trimesh mesh as ours; None when it has no area."""
    vertices = np.asarray(part.vertices, dtype=np.float64)
    faces = np.asarray(part.faces, dtype=np.int64)
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        place = wrong_line(path.read_bytes()) if path.suffix.lower() == ".obj" else ""
        where = f":{place}" if place else ": vertices of other than 3 numbers"
        raise AssetError(f"{path}{where}.")
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise AssetError(f"{path}: a triangle names a vertex that is not there.")
    if not np.isfinite(vertices).all() or np.abs(vertices).max() > MAX_COORDINATE:
        raise AssetError(f"{path}: vertices that are not finite or beyond {MAX_COORDINATE:g} m.")
    uvs = np.zeros((len(vertices), 2))
    colour, texture = looks.of(visual)
    given = getattr(visual, "uv", None)
    if given is not None and np.shape(given) == (len(vertices), 2):
        uvs = np.nan_to_num(np.asarray(given, dtype=np.float64))
    shape = Shape(vertices[faces], uvs[faces])
    if shape.area <= 0.0:
        return None
    return mesh(shape, colour=colour, texture=texture, two_sided=True)

"""Assets: models by the names that scene files use, from files or made by us.

`load_model` looks for the file (`find.py`), then for a file of the same stem that it can read,
then for our stand-in of that relative name (`STAND_INS`).
"""

from __future__ import annotations

import hashlib
from pathlib import Path, PurePosixPath

from ..errors import AssetNotFound, did_you_mean
from .find import UNDER, candidates, find, folders_searched, plain_name, roots
from .loaders import BY_OSGCONV, READABLE, can_read, read_model
from .mesh import Mesh, Model, Texture
from .model_cache import made
from .primitives import primitive
from .procedural.placeholder import labelled_box
from .stand_ins import STAND_INS, StandIn

__all__ = [
    "READABLE",
    "STAND_INS",
    "Mesh",
    "Model",
    "StandIn",
    "Texture",
    "find",
    "folders_searched",
    "load_model",
    "primitive",
    "unknown_model",
]


def load_model(
    name: str,
    *,
    beside: Path | None = None,
    data_path: tuple[Path, ...] = (),
    max_triangles: int | None = None,
) -> Model:
    """The model called ``name``, as a scene or robot file calls it.

    Args:
        name: Path, absolute or relative, of a mesh file.
        beside: The file that names it, or that file's folder.
        data_path: Further folders to search.
        max_triangles: Meshes of files with more triangles than this are simplified.

    Raises:
        AssetNotFound: Neither a file nor a stand-in; names the folders searched.
        AssetError: The file was found and cannot be read.
    """
    name = plain_name(name)
    stem = name.rpartition(".")[0] or name
    names = [name, *(stem + suffix for suffix in (*READABLE, *BY_OSGCONV))]
    found = list(candidates(names, beside=beside, data_path=data_path))
    path = next((path for path in found if can_read(path)), next(iter(found), None))
    if path is not None:
        return read_model(path, name=name, max_triangles=max_triangles)
    stand_in = _stand_in_name(stem)
    if stand_in is not None:
        return made(stand_in)
    raise AssetNotFound(
        f"There is no file {name!r}, nor a stand-in of that name."
        f"{did_you_mean(stem.removeprefix('data/'), STAND_INS)} Searched, in order: "
        + ", ".join(str(root) for root in roots(beside=beside, data_path=data_path))
        + f"; each also under {', '.join(UNDER[1:])}."
    )


def unknown_model(name: str) -> Model:
    """A labelled box of 0.3 m in the place of a model that is nowhere."""
    label = PurePosixPath(plain_name(name).replace("\\", "/")).stem[:16] or "?"
    return Model(
        name=plain_name(name),
        meshes=labelled_box(label, (0.3, 0.3, 0.3)),
        source="labelled box",
        sha256=hashlib.sha256(f"labelled box {label}".encode()).hexdigest(),
    )


def _stand_in_name(stem: str) -> str | None:
    """The name in `STAND_INS` that ends ``stem`` (which may start with ``data/`` or a path)."""
    parts = PurePosixPath(stem.replace("\\", "/")).parts
    for k in range(len(parts)):
        tail = "/".join(parts[k:])
        if tail in STAND_INS:
            return tail
    return None

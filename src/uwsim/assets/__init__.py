"""Assets: models by the names that scene files use, from files or generated.

`load_model` looks for the file (`find.py`), then for a file of the same stem that it can read,
then for our replacement of that relative name (`STAND_INS`).
"""

from __future__ import annotations

import hashlib
from pathlib import Path, PurePosixPath

from ..errors import AssetError, AssetNotFound, did_you_mean
from ..files.input_files import is_inside
from .find import (
    UNDER,
    bundled_robot,
    bundled_robots,
    candidates,
    find,
    folders_searched,
    plain_name,
    roots,
)
from .loaders import BY_OSGCONV, READABLE, can_read, read_model
from .mesh import Mesh, Model, Texture
from .model_cache import made
from .paint import painted
from .primitives import primitive
from .stand_ins import STAND_INS, StandIn

__all__ = [
    "READABLE",
    "STAND_INS",
    "Mesh",
    "Model",
    "StandIn",
    "Texture",
    "bundled_robot",
    "bundled_robots",
    "find",
    "folders_searched",
    "has_model",
    "load_model",
    "painted",
    "primitive",
    "unknown_model",
    "why_unreadable",
]


def load_model(
    name: str,
    *,
    named_by: Path | None = None,
    data_path: tuple[Path, ...] = (),
) -> Model:
    """The model called ``name``, as a scene or robot file calls it.

    Args:
        name: Path, absolute or relative, of a mesh file.
        named_by: The file that names it, or that file's folder.
        data_path: Further folders to search.

    Raises:
        AssetNotFound: Neither a file nor a stand-in; names the folders searched.
        AssetError: The file was found and cannot be read.
    """
    path = _path_of(name, named_by, data_path)
    name = plain_name(name)
    stem = _stem(name)
    if path is not None:
        above = roots(named_by=named_by or path, data_path=data_path)
        own = max(above, key=lambda root: len(root.parts) if is_inside(path, [root]) else -1)
        within = (own.absolute(), *data_path)
        return read_model(path, name=name, within=within)
    stand_in = _stand_in_name(stem)
    if stand_in is not None:
        return made(stand_in)
    raise AssetNotFound(
        f"There is no file {name!r}, nor a stand-in of that name."
        f"{did_you_mean(stem.removeprefix('data/'), STAND_INS)} Searched, in order: "
        + ", ".join(str(root) for root in roots(named_by=named_by, data_path=data_path))
        + f"; each also under {', '.join(UNDER[1:])}."
    )


def has_model(name: str, *, named_by: Path | None = None, data_path: tuple[Path, ...] = ()) -> bool:
    """Whether `load_model` finds a file or a stand-in."""
    is_there = _path_of(name, named_by, data_path) is not None
    return is_there or _stand_in_name(_stem(plain_name(name))) is not None


def why_unreadable(
    name: str, *, named_by: Path | None = None, data_path: tuple[Path, ...] = ()
) -> str:
    """Why the file that `load_model` finds cannot be read; empty if it can, or is not there."""
    try:
        load_model(name, named_by=named_by, data_path=data_path)
    except AssetNotFound:
        return ""
    except AssetError as error:
        return str(error).removesuffix(".")
    return ""


def _path_of(name: str, named_by: Path | None, data_path: tuple[Path, ...]) -> Path | None:
    """The file of a model: of its name or its stem, one that can be read if there is any."""
    name = plain_name(name)
    names = [name, *(_stem(name) + suffix for suffix in (*READABLE, *BY_OSGCONV))]
    found = list(candidates(names, named_by=named_by, data_path=data_path))
    return next((path for path in found if can_read(path)), next(iter(found), None))


def _stem(name: str) -> str:
    return name.rpartition(".")[0] or name


def unknown_model(name: str) -> Model:
    """A labelled box of 0.3 m in place of a model that is not found."""
    from .procedural.placeholder import labelled_box

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

"""Assets: models by the names that scene files use, from files or generated.

`load_model` looks for the file (`find.py`), then for a file of the same stem that it can read,
then for our replacement of that relative name (`STAND_INS`).
"""

from __future__ import annotations

import hashlib
from pathlib import Path, PurePosixPath

from ..base.files.input_files import is_inside
from ..errors import AssetError, AssetNotFound, did_you_mean
from .find import (
    UNDER,
    above,
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
from .packages import OURS, PREFIXES, environment_folders, package_folders, package_of
from .paint import painted
from .places import may_be_elsewhere, package_remark, place_remark, searched_for
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
    "model_place_remark",
    "model_remarks",
    "package_remark",
    "painted",
    "place_remark",
    "primitive",
    "searched_for",
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
    given, name = name, plain_name(name)
    if path is not None:
        if (in_package := package_of(given)) is not None and in_package[0] != OURS:
            name = "/".join(in_package)
        places = [*roots(named_by=named_by or path, data_path=data_path), *environment_folders()]
        own = max(places, key=lambda root: len(root.parts) if is_inside(path, [root]) else -1)
        within = (own.absolute(), *data_path)
        return read_model(path, name=name, within=within)
    stand_in = _stand_in_of(given, named_by, data_path)
    if stand_in is not None:
        return made(stand_in)
    remark = package_remark(given, named_by=named_by, data_path=data_path)
    raise AssetNotFound(
        f"There is no file {name!r}, nor a stand-in of that name."
        f"{did_you_mean(_stem(name).removeprefix('data/'), STAND_INS)} "
        + (f"{remark[0].upper()}{remark[1:]}. " if remark else "")
        + "Searched, in order: "
        + ", ".join(str(root) for root in roots(named_by=named_by, data_path=data_path))
        + f"; each also under {', '.join(UNDER[1:])}."
    )


def has_model(name: str, *, named_by: Path | None = None, data_path: tuple[Path, ...] = ()) -> bool:
    """Whether `load_model` finds a file or a stand-in."""
    is_there = _path_of(name, named_by, data_path) is not None
    return is_there or _stand_in_of(name, named_by, data_path) is not None


def model_place_remark(
    name: str, *, named_by: Path | None = None, data_path: tuple[Path, ...] = ()
) -> str:
    """Say that the file of a model is another than its name states; empty if it is that one.

    A file of OpenSceneGraph's formats is silently replaced by its conversion to another format.
    """
    suffix = PurePosixPath(plain_name(name)).suffix.lower()
    if suffix not in READABLE and not may_be_elsewhere(name):
        return ""
    try:
        path = _path_of(name, named_by, data_path)
    except AssetError:
        return ""
    if remark := place_remark(name, path, named_by=named_by, data_path=data_path):
        return remark
    if path is None or suffix not in READABLE or path.suffix.lower() == suffix:
        return ""
    return f"{plain_name(name)[:200]!r} is not found; {path} is used"


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


def model_remarks(
    name: str, *, named_by: Path | None = None, data_path: tuple[Path, ...] = ()
) -> tuple[str, ...]:
    """What of the file that `load_model` finds cannot be read, though the rest of it can."""
    try:
        path = _path_of(name, named_by, data_path)
        if path is None or path.suffix.lower() in (".stl", ".ply"):  # these have no materials
            return ()
        return load_model(name, named_by=named_by, data_path=data_path).remarks
    except AssetError:
        return ()


def _path_of(name: str, named_by: Path | None, data_path: tuple[Path, ...]) -> Path | None:
    """The file of a model: of its name or its stem, one that can be read if there is any."""
    in_package, plain = package_of(name), plain_name(name)
    prefix = "" if in_package is None else f"{PREFIXES[0]}{in_package[0]}/"
    stems = (_stem(plain) + suffix for suffix in (*READABLE, *BY_OSGCONV))
    names = [prefix + plain, *(prefix + stem for stem in stems)]
    first = None
    for path in candidates(names, named_by=named_by, data_path=data_path):
        if can_read(path):
            return path
        first = first or path
    return first


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


def _stand_in_of(name: str, named_by: Path | None, data_path: tuple[Path, ...]) -> str | None:
    """The stand-in for a name; a package that is there has its own files alone."""
    in_package = package_of(name)
    if in_package is not None and in_package[0] != OURS:
        folders = package_folders(in_package[0], above(named_by), data_path)
        if next(folders, None) is not None:
            return None
    return _stand_in_name(_stem(plain_name(name)))


def _stand_in_name(stem: str) -> str | None:
    """The name in `STAND_INS` that ends ``stem`` (which may start with ``data/`` or a path)."""
    parts = PurePosixPath(stem.replace("\\", "/")).parts
    for k in range(len(parts)):
        tail = "/".join(parts[k:])
        if tail in STAND_INS:
            return tail
    return None

"""Assets: find and read the models that scene and robot files name, or bundled ones.

`load_model` searches for the file (`find.py`), then for a readable file of the same stem, then for
the bundled model of that relative name (`BUNDLED_MODELS`).
"""

from __future__ import annotations

import hashlib
from pathlib import Path, PurePosixPath

from ..base.files.input_files import is_inside
from ..errors import AssetError, AssetNotFound, did_you_mean
from .bundled_models import bundled_model
from .find import (
    SUBFOLDERS,
    bundled_robot,
    bundled_robots,
    candidates,
    find,
    parent_folders,
    plain_name,
    roots,
    searched_folders,
)
from .loaders import MESH_FORMATS, OSGCONV_FORMATS, can_read, read_model
from .location_remarks import describe_search, location_remark, package_remark, states_location
from .mesh import Mesh, Model, Texture
from .packages import PREFIXES, UWSIM_PACKAGE, environment_folders, package_folders, package_of
from .paint import paint_model
from .primitives import primitive, rounded_cylinder
from .stand_ins import BUNDLED_MODELS, STAND_INS, StandIn

__all__ = [
    "BUNDLED_MODELS",
    "MESH_FORMATS",
    "STAND_INS",
    "Mesh",
    "Model",
    "StandIn",
    "Texture",
    "bundled_robot",
    "bundled_robots",
    "describe_search",
    "find",
    "has_model",
    "load_model",
    "location_remark",
    "model_location_remark",
    "model_read_error",
    "model_remarks",
    "package_remark",
    "paint_model",
    "primitive",
    "rounded_cylinder",
    "searched_folders",
    "unknown_model",
]


def load_model(
    name: str, *, named_by: Path | None = None, data_path: tuple[Path, ...] = ()
) -> Model:
    """Return the model that a scene or robot file names.

    Args:
        name: Path, absolute or relative, of a mesh file.
        named_by: The file that names it, or that file's folder.
        data_path: Further folders to search.

    Raises:
        AssetNotFound: There is neither a file nor a stand-in; the error message lists the folders.
        AssetError: The file was found and cannot be read.
    """
    path = _model_path(name, named_by, data_path)
    requested_name, name = name, plain_name(name)
    if path is not None:
        in_package = package_of(requested_name)
        if in_package is not None and in_package[0] != UWSIM_PACKAGE:
            name = "/".join(in_package)
        folders = [*roots(named_by=named_by or path, data_path=data_path), *environment_folders()]
        root = max(folders, key=lambda root: len(root.parts) if is_inside(path, [root]) else -1)
        allowed_folders = (root.absolute(), *data_path)
        return read_model(path, name=name, allowed_folders=allowed_folders)
    stand_in = _stand_in_of(requested_name, named_by, data_path)
    if stand_in is not None:
        return bundled_model(stand_in)
    remark = package_remark(requested_name, named_by=named_by, data_path=data_path)
    raise AssetNotFound(
        f"There is no file {name!r}, and no stand-in of that name."
        f"{did_you_mean(_stem(name).removeprefix('data/'), BUNDLED_MODELS)} "
        + (f"{remark[0].upper()}{remark[1:]}. " if remark else "")
        + "Searched, in order: "
        + ", ".join(str(root) for root in roots(named_by=named_by, data_path=data_path))
        + f"; each also under {', '.join(SUBFOLDERS[1:])}."
    )


def has_model(name: str, *, named_by: Path | None = None, data_path: tuple[Path, ...] = ()) -> bool:
    """Return whether `load_model` finds a file or a stand-in."""
    has_file = _model_path(name, named_by, data_path) is not None
    return has_file or _stand_in_of(name, named_by, data_path) is not None


def model_location_remark(
    name: str, *, named_by: Path | None = None, data_path: tuple[Path, ...] = ()
) -> str:
    """Return a remark if the file of a model is not the one that its name states; otherwise "".

    There is no remark if the name has a format of OpenSceneGraph and another format is read.
    """
    suffix = PurePosixPath(plain_name(name)).suffix.lower()
    if suffix not in MESH_FORMATS and not states_location(name):
        return ""
    try:
        path = _model_path(name, named_by, data_path)
    except AssetError:
        return ""
    if remark := location_remark(name, path, named_by=named_by, data_path=data_path):
        return remark
    if path is None or suffix not in MESH_FORMATS or path.suffix.lower() == suffix:
        return ""
    return f"{plain_name(name)[:200]!r} is not found; {path} is used"


def model_read_error(
    name: str, *, named_by: Path | None = None, data_path: tuple[Path, ...] = ()
) -> str:
    """Return why the file that `load_model` finds cannot be read; otherwise ""."""
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
    """Return remarks on the unreadable parts of the file that `load_model` finds."""
    try:
        path = _model_path(name, named_by, data_path)
        if path is None or path.suffix.lower() in (".stl", ".ply"):  # these have no materials
            return ()
        return load_model(name, named_by=named_by, data_path=data_path).remarks
    except AssetError:
        return ()


def _model_path(name: str, named_by: Path | None, data_path: tuple[Path, ...]) -> Path | None:
    """Return the file with the name or the stem of a model, a readable one if there is any."""
    in_package, file_name = package_of(name), plain_name(name)
    prefix = "" if in_package is None else f"{PREFIXES[0]}{in_package[0]}/"
    stems = (_stem(file_name) + suffix for suffix in (*MESH_FORMATS, *OSGCONV_FORMATS))
    names = [prefix + file_name, *(prefix + stem for stem in stems)]
    first_path = None
    for path in candidates(names, named_by=named_by, data_path=data_path):
        if can_read(path):
            return path
        first_path = first_path or path
    return first_path


def _stem(name: str) -> str:
    return name.rpartition(".")[0] or name


def unknown_model(name: str) -> Model:
    """Return a labelled box of 0.3 m in place of a model that is not found."""
    from .procedural.placeholder import labelled_box

    label = PurePosixPath(plain_name(name).replace("\\", "/")).stem[:16] or "?"
    return Model(
        name=plain_name(name),
        meshes=labelled_box(label, (0.3, 0.3, 0.3)),
        source="labelled box",
        digest=hashlib.sha256(f"labelled box {label}".encode()).hexdigest(),
    )


def _stand_in_of(name: str, named_by: Path | None, data_path: tuple[Path, ...]) -> str | None:
    """Return the name of the stand-in for a model; None in another package that is found."""
    in_package = package_of(name)
    if in_package is not None and in_package[0] != UWSIM_PACKAGE:
        folders = package_folders(in_package[0], parent_folders(named_by), data_path)
        if next(folders, None) is not None:
            return None
    return _stand_in_name(_stem(plain_name(name)))


def _stand_in_name(stem: str) -> str | None:
    """Return the name in `BUNDLED_MODELS` that ends ``stem``, which may begin with folders."""
    parts = PurePosixPath(stem.replace("\\", "/")).parts
    for k in range(len(parts)):
        tail = "/".join(parts[k:])
        if tail in BUNDLED_MODELS:
            return tail
    return None

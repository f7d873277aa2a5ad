"""Readers of mesh files, by trimesh or after a conversion by `osgconv`."""

from __future__ import annotations

from pathlib import Path

from ...base.files.input_files import file_stamps, read_bytes, record, record_inputs
from ...errors import AssetError
from ..mesh import Model
from .by_trimesh import MESH_FORMATS, read_meshes
from .openscenegraph import OSGCONV_FORMATS, convert_to_obj, has_osgconv, osgconv_error

__all__ = ["MESH_FORMATS", "OSGCONV_FORMATS", "can_read", "format_error", "read_model"]

CACHE_SIZE = 256
"""The number of models in memory."""

_Key = tuple[Path, str, tuple[Path, ...]]
_cache: dict[_Key, tuple[tuple[tuple[int, int], ...], Model]] = {}


def can_read(path: Path) -> bool:
    """Return whether files of this type can be read with the installed programs."""
    suffix = path.suffix.lower()
    return suffix in MESH_FORMATS or (suffix in OSGCONV_FORMATS and has_osgconv())


def format_error(path: Path) -> str:
    """Return why files of this type cannot be read on this computer; "" if they can."""
    suffix = path.suffix.lower()
    if can_read(path):
        return ""
    if suffix in OSGCONV_FORMATS:
        return osgconv_error(path)
    formats = ", ".join((*MESH_FORMATS, *OSGCONV_FORMATS))
    return f"{path}: files of type {suffix or 'none'} are not read; expected one of {formats}"


def read_model(path: Path, *, name: str, allowed_folders: tuple[Path, ...] = ()) -> Model:
    """Return the model in a file, cached until one of its files changes.

    Args:
        path: The file.
        name: The name by which it was looked up.
        allowed_folders: The folders of its materials and images; by default the file's folder.

    Raises:
        AssetError: It cannot be read.
    """
    allowed_folders = allowed_folders or (path.absolute().parent,)
    key = (path, name, allowed_folders)
    entry = _cache.get(key)
    if entry is not None and entry[0] == file_stamps(entry[1].files):
        record(entry[1].files)
        return entry[1]
    try:
        model = _read(path, name, allowed_folders)
    except OSError as error:
        raise AssetError(f"{path}: cannot be read ({error.strerror}).") from error
    while len(_cache) >= CACHE_SIZE:
        del _cache[next(iter(_cache))]
    _cache[key] = file_stamps(model.files), model
    return model


def _read(path: Path, name: str, allowed_folders: tuple[Path, ...]) -> Model:
    suffix = path.suffix.lower()
    with record_inputs() as files:
        if suffix in MESH_FORMATS:
            meshes, asset, remarks = read_meshes(path, name=name, allowed_folders=allowed_folders)
        elif suffix in OSGCONV_FORMATS:
            read_bytes(path, name=name)
            with convert_to_obj(path) as obj:
                meshes, asset, remarks = read_meshes(
                    obj, name=name, allowed_folders=allowed_folders, original=path
                )
        else:
            raise AssetError(format_error(path))
    digest = files[0].sha256.removeprefix("sha256:")
    return Model(
        name=name,
        meshes=meshes,
        source="file",
        digest=digest,
        files=tuple(files),
        asset=asset,
        remarks=remarks,
    )

"""Readers of mesh files: by trimesh, or converted by `osgconv` first."""

from __future__ import annotations

from pathlib import Path

from ...base.files.input_files import read_bytes, record, record_inputs
from ...errors import AssetError
from ..mesh import Model
from .by_trimesh import READABLE, read_meshes
from .openscenegraph import BY_OSGCONV, converted, has_osgconv, without_osgconv

__all__ = ["BY_OSGCONV", "READABLE", "can_read", "read_model", "why_not_read"]

KEPT = 256
"""Number of models kept in memory."""

_Stamp = tuple[int, int]
_Key = tuple[Path, str, tuple[Path, ...]]
_kept: dict[_Key, tuple[tuple[_Stamp, ...], Model]] = {}


def can_read(path: Path) -> bool:
    """Whether files of that type can be read here and now."""
    suffix = path.suffix.lower()
    return suffix in READABLE or (suffix in BY_OSGCONV and has_osgconv())


def why_not_read(path: Path) -> str:
    """Why files of that type cannot be read here and now; empty if they can."""
    suffix = path.suffix.lower()
    if can_read(path):
        return ""
    if suffix in BY_OSGCONV:
        return without_osgconv(path)
    known = ", ".join((*READABLE, *BY_OSGCONV))
    return f"{path}: files of type {suffix or 'none'} are not read; expected one of {known}"


def read_model(path: Path, *, name: str, within: tuple[Path, ...] = ()) -> Model:
    """The model in a file, cached until one of its files changes.

    Args:
        path: The file.
        name: The name by which it was looked up.
        within: Folders that its materials and images may lie in; its own by default.

    Raises:
        AssetError: It cannot be read.
    """
    within = within or (path.absolute().parent,)
    key = (path, name, within)
    kept = _kept.get(key)
    if kept is not None and kept[0] == _stamps(kept[1]):
        record(kept[1].files)
        return kept[1]
    try:
        model = _read(path, name, within)
    except OSError as error:
        raise AssetError(f"{path}: cannot be read ({error.strerror}).") from error
    while len(_kept) >= KEPT:
        del _kept[next(iter(_kept))]
    _kept[key] = _stamps(model), model
    return model


def _stamps(model: Model) -> tuple[_Stamp, ...]:
    """Time and size of the files that a model is made of, as they are now."""
    facts = [file.path.stat() if file.path.exists() else None for file in model.files]
    return tuple((0, 0) if each is None else (each.st_mtime_ns, each.st_size) for each in facts)


def _read(path: Path, name: str, within: tuple[Path, ...]) -> Model:
    suffix = path.suffix.lower()
    with record_inputs() as files:
        if suffix in READABLE:
            meshes, asset, remarks = read_meshes(path, name=name, within=within)
        elif suffix in BY_OSGCONV:
            read_bytes(path, name=name)
            with converted(path) as obj:
                meshes, asset, remarks = read_meshes(obj, name=name, within=within, original=path)
        else:
            raise AssetError(why_not_read(path))
    digest = files[0].sha256.removeprefix("sha256:")
    return Model(
        name=name,
        meshes=meshes,
        source="file",
        sha256=digest,
        files=tuple(files),
        asset=asset,
        remarks=remarks,
    )

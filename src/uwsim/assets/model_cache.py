"""Disk cache of generated models: generating the tank takes half a second.

The key of a model is the hash of all that it depends on: this package's sources and the versions
of numpy and OpenCV. `disk_cache` rejects files that changed after they were written.
"""

from __future__ import annotations

import hashlib
import io
import platform
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ..base.files import disk_cache
from ..base.numerics.opencv import deterministic_opencv
from .mesh import Mesh, Model, Texture
from .stand_ins import STAND_INS

Arrays = dict[str, npt.NDArray[Any]]
_ARRAYS = ("vertices", "normals", "uvs", "triangles")


class CacheMiss(Exception):
    """The error if the cache does not contain a file, or contains a damaged one."""


@cache
def generated_model(name: str) -> Model:
    """Return the generated model of a name in `STAND_INS`, from the cache if possible."""
    file = disk_cache.cache_folder("models") / _key() / (name.replace("/", "-") + ".npz")
    try:
        return _read(name, file)
    except CacheMiss:
        model = _make(name)
        _store(model, file)
        return model


def _make(name: str) -> Model:
    stand_in = STAND_INS[name]
    with deterministic_opencv():
        meshes = stand_in.make()
    digest = hashlib.sha256()
    for mesh in meshes:
        for array in _ARRAYS:
            digest.update(getattr(mesh, array).tobytes())
        if mesh.texture is not None:
            digest.update(mesh.texture.pixels.tobytes())
    return Model(name=name, meshes=meshes, source=stand_in.source, sha256=digest.hexdigest())


@cache
def _key() -> str:
    """Return the hash of everything that generated models depend on."""
    digest = hashlib.sha256()
    package = Path(__file__).parent
    for source in sorted([*package.glob("*.py"), *package.glob("procedural/*.py")]):
        digest.update(source.read_bytes())
    digest.update(
        f"{np.__version__} {version('opencv-python-headless')} {platform.machine()}".encode()
    )
    return digest.hexdigest()[:32]


def _store(model: Model, file: Path) -> None:
    arrays: dict[str, Any] = {"sha256": np.array(model.sha256)}
    for i, mesh in enumerate(model.meshes):
        for name in _ARRAYS:
            arrays[f"{i}/{name}"] = getattr(mesh, name)
        arrays[f"{i}/colour"] = np.array(mesh.colour)
        arrays[f"{i}/two_sided"] = np.array(mesh.two_sided)
        texture = mesh.texture
        if texture is not None:
            arrays[f"{i}/texture"] = np.array(texture.name)
            image = _texture_path(file, texture.name)
            if not image.exists():
                _write(image, pixels=texture.pixels, repeats=np.array(texture.repeats))
    _write(file, **arrays)


def _write(file: Path, **arrays: Any) -> None:
    buffer = io.BytesIO()
    np.savez(buffer, **arrays)
    disk_cache.write(file, buffer.getvalue())


def _texture_path(file: Path, texture: str) -> Path:
    """Return the path of a texture, next to the models, several of which may share it."""
    return file.parent / ("texture-" + texture.replace("/", "-") + ".npz")


def _read(name: str, file: Path) -> Model:
    arrays = _read_arrays(file)
    n = sum(key.endswith("/vertices") for key in arrays)
    meshes = tuple(_mesh(arrays, i, file) for i in range(n))
    source = STAND_INS[name].source
    return Model(name=name, meshes=meshes, source=source, sha256=str(arrays["sha256"]))


def _mesh(stored_arrays: Arrays, i: int, file: Path) -> Mesh:
    red, green, blue = stored_arrays[f"{i}/colour"].tolist()
    texture = None
    if f"{i}/texture" in stored_arrays:
        texture_name = str(stored_arrays[f"{i}/texture"])
        texture = _texture(texture_name, _texture_path(file, texture_name))
    arrays: Any = {array: stored_arrays[f"{i}/{array}"] for array in _ARRAYS}
    return Mesh(
        **arrays,
        colour=(red, green, blue),
        texture=texture,
        two_sided=bool(stored_arrays[f"{i}/two_sided"]),
    )


@cache
def _texture(name: str, file: Path) -> Texture:
    """Share one texture object between all meshes that use it, so that they are drawn together."""
    arrays = _read_arrays(file)
    return Texture(name=name, pixels=arrays["pixels"], repeats=bool(arrays["repeats"]))


def _read_arrays(file: Path) -> Arrays:
    data = disk_cache.read(file)
    if data is None:
        raise CacheMiss
    with np.load(io.BytesIO(data), allow_pickle=False) as archive:
        return dict(archive)

"""Models that uwsim makes itself, kept on disk between runs: making the tank takes half a second.

A kept model is found by the hash of everything that makes it: this package's sources and the
versions of numpy and OpenCV. Nothing that could have been made otherwise is ever read back. What
cannot be read or written is made anew, in silence: the cache is a convenience, never a need.
"""

from __future__ import annotations

import hashlib
import os
import platform
import zipfile
from contextlib import suppress
from functools import cache
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import Any

import cv2
import numpy as np

from ..opencv import plain_opencv
from .mesh import Mesh, Model, Texture
from .stand_ins import STAND_INS

_ARRAYS = ("vertices", "normals", "uvs", "triangles")


@cache
def made(name: str) -> Model:
    """Our model of that name in `STAND_INS`: made once, or read back as it was made."""
    file = _folder() / _key() / (name.replace("/", "-") + ".npz")
    try:
        return _read(name, file)
    except (OSError, ValueError, KeyError, IndexError, zipfile.BadZipFile):
        model = _make(name)
        with suppress(OSError):
            _keep(model, file)
        return model


def _make(name: str) -> Model:
    stand_in = STAND_INS[name]
    with plain_opencv():
        meshes = stand_in.make()
    digest = hashlib.sha256()
    for mesh in meshes:
        for array in _ARRAYS:
            digest.update(getattr(mesh, array).tobytes())
        if mesh.texture is not None:
            digest.update(mesh.texture.pixels.tobytes())
    return Model(name=name, meshes=meshes, source=stand_in.source, sha256=digest.hexdigest())


def _folder() -> Path:
    """Where models are kept: the user's cache folder (XDG Base Directory Specification)."""
    home = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
    return Path(home) / "uwsim" / "models"


@cache
def _key() -> str:
    """Hash of all that our models depend on."""
    digest = hashlib.sha256()
    package = Path(__file__).parent
    for source in sorted([*package.glob("*.py"), *package.glob("procedural/*.py")]):
        digest.update(source.read_bytes())
    digest.update(f"{np.__version__} {cv2.__version__} {platform.machine()}".encode())
    return digest.hexdigest()[:32]


def _keep(model: Model, file: Path) -> None:
    """Write a model and its textures; each file whole or not at all."""
    file.parent.mkdir(parents=True, exist_ok=True)
    arrays: dict[str, Any] = {"sha256": np.array(model.sha256)}
    for i, mesh in enumerate(model.meshes):
        for name in _ARRAYS:
            arrays[f"{i}/{name}"] = getattr(mesh, name)
        arrays[f"{i}/colour"] = np.array(mesh.colour)
        arrays[f"{i}/two_sided"] = np.array(mesh.two_sided)
        texture = mesh.texture
        if texture is not None:
            arrays[f"{i}/texture"] = np.array(texture.name)
            picture = _picture(file, texture.name)
            if not picture.exists():
                _write(picture, pixels=texture.pixels, repeats=np.array(texture.repeats))
    _write(file, **arrays)


def _write(file: Path, **arrays: Any) -> None:
    with NamedTemporaryFile(dir=file.parent, suffix=".part", delete=False) as draft:
        try:
            np.savez(draft, **arrays)
            draft.flush()
            os.replace(draft.name, file)
        except BaseException:
            os.unlink(draft.name)
            raise


def _picture(file: Path, texture: str) -> Path:
    """Where a texture is kept: beside the models, for several of them share it."""
    return file.parent / ("texture-" + texture.replace("/", "-") + ".npz")


def _read(name: str, file: Path) -> Model:
    with file.open("rb") as stream, np.load(stream, allow_pickle=False) as kept:
        n = sum(key.endswith("/vertices") for key in kept.files)
        meshes = tuple(_mesh(kept, i, file) for i in range(n))
        sha256 = str(kept["sha256"])
    return Model(name=name, meshes=meshes, source=STAND_INS[name].source, sha256=sha256)


def _mesh(kept: Any, i: int, file: Path) -> Mesh:
    red, green, blue = kept[f"{i}/colour"].tolist()
    texture = None
    if f"{i}/texture" in kept.files:
        called = str(kept[f"{i}/texture"])
        texture = _texture(called, _picture(file, called))
    return Mesh(
        **{array: kept[f"{i}/{array}"] for array in _ARRAYS},
        colour=(red, green, blue),
        texture=texture,
        two_sided=bool(kept[f"{i}/two_sided"]),
    )


@cache
def _texture(name: str, file: Path) -> Texture:
    """One object a texture, however many meshes wear it: they are drawn together."""
    with file.open("rb") as stream, np.load(stream, allow_pickle=False) as kept:
        return Texture(name=name, pixels=kept["pixels"], repeats=bool(kept["repeats"]))

"""Disk cache of compiled models: to compile thousands of shapes takes seconds.

A model is found by the hash of all that it is compiled from: the spec of the scene, its robots, the
hydrodynamics, the step, the shapes, the sources of uwsim and the version of MuJoCo. Models of few
shapes are not kept.
"""

from __future__ import annotations

import dataclasses
import enum
import hashlib
import struct
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from ..base.engine import model_bytes
from ..base.files import disk_cache
from ..base.files.code_digest import code_digest
from ..base.geometry import Array, Pose
from ..model.collision.shapes import CollisionShape

MIN_SHAPES = 500
"""Models of fewer shapes are compiled anew."""
SOURCES = ("base", "schema", "devices", "scene", "model", "physics", "world")
"""Of this package, what models follow from."""
PACKAGES = ("mujoco", "numpy", "scipy", "numba")
NAME = "scene.mjb"
NONE = np.zeros(0)


class NoContent(Exception):
    """A value whose content cannot be hashed."""


def cached_model(
    inputs: Sequence[object], n_shapes: int, build: Callable[[], mujoco.MjModel]
) -> mujoco.MjModel:
    """Return what ``build`` compiles, from the cache if possible.

    Args:
        inputs: all that the model follows from, besides code.
        n_shapes: how many shapes it has.
        build: compiles it.
    """
    if n_shapes < MIN_SHAPES:
        return build()
    try:
        digest = content_digest(inputs)
    except NoContent:
        return build()
    file = disk_cache.cache_folder("compiled") / f"{digest.hex()[:32]}.mjb"
    data = disk_cache.read(file)
    if data is not None:
        return mujoco.MjModel.from_binary_path(NAME, {NAME: data})
    model = build()
    disk_cache.write(file, model_bytes(model))
    return model


def content_digest(inputs: Sequence[object]) -> bytes:
    """Hash values by their content, and the code that compiles models, (32 bytes).

    Raises:
        NoContent: a value is of a type that is not known here.
    """
    package = Path(__file__).parents[1]
    digest = hashlib.sha256(code_digest([package / name for name in SOURCES], PACKAGES))
    parts: list[bytes] = []
    _add(tuple(inputs), parts)
    digest.update(b"".join(parts))
    return digest.digest()


def _add(value: object, parts: list[bytes]) -> None:
    """Append a value's type, its length and its content: no two values have the same bytes."""
    if value is None or isinstance(value, bool | int | str | Path | enum.Enum):
        parts.append(_framed(type(value).__name__, f"{value}".encode()))
    elif isinstance(value, float):
        parts.append(b"f" + struct.pack("<d", value))
    elif isinstance(value, bytes):
        parts.append(_framed("bytes", value))
    elif isinstance(value, np.ndarray):
        kind = f"{value.dtype.str} {value.shape}"
        parts.append(_framed(kind, np.ascontiguousarray(value).tobytes()))
    elif isinstance(value, tuple | list) and value and isinstance(value[0], CollisionShape):
        _add_shapes(value, parts)
    elif isinstance(value, tuple | list):
        parts.append(_framed("list", str(len(value)).encode()))
        for each in value:
            _add(each, parts)
    elif isinstance(value, Mapping):
        parts.append(_framed("mapping", str(len(value)).encode()))
        for key, each in value.items():
            _add(key, parts)
            _add(each, parts)
    elif isinstance(value, Pose):
        _add((value.position, value.rotation), parts)
    elif dataclasses.is_dataclass(value) and not isinstance(value, type):
        parts.append(_framed("object", f"{type(value).__module__} {type(value).__name__}".encode()))
        for name in _compared(type(value)):
            _add(getattr(value, name), parts)
    else:
        raise NoContent(f"{type(value).__name__} has no content that is known.")


def _add_shapes(shapes: Sequence[CollisionShape], parts: list[bytes]) -> None:
    """Append the content of thousands of shapes, column by column."""
    _add(tuple(f"{shape.kind} {shape.size}" for shape in shapes), parts)
    columns: list[list[Array]] = [
        [shape.body_from_shape.position for shape in shapes],
        [shape.body_from_shape.rotation for shape in shapes],
        [NONE if shape.corners is None else shape.corners for shape in shapes],
        [NONE if shape.heights is None else shape.heights for shape in shapes],
    ]
    for arrays in columns:
        forms = " ".join(str(array.shape) for array in arrays)
        parts.append(_framed("forms", forms.encode()))
        _add(np.concatenate([array.ravel() for array in (NONE, *arrays)]), parts)


def _framed(kind: str, content: bytes) -> bytes:
    return f"{kind} {len(content)} ".encode() + content


@cache
def _compared(kind: Any) -> tuple[str, ...]:
    """Names of the fields of a dataclass; where it was read is no part of its content."""
    return tuple(field.name for field in dataclasses.fields(kind) if field.name != "source_line")

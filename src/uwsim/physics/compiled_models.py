"""The disk cache of MuJoCo models, as the compilation of thousands of shapes takes seconds.

The key of a model is the hash of all its inputs: the spec of the scene, its robots, the
hydrodynamics, the timestep, the shapes, the sources of uwsim and the versions of MuJoCo and other
packages. Models with few shapes are not cached.
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
"""The minimum number of shapes of a model that is cached."""
SOURCES = ("base", "schema", "devices", "scene", "model", "physics", "world")
"""The subpackages of uwsim whose source code models depend on."""
PACKAGES = ("mujoco", "numpy", "scipy", "numba")
"""The packages whose versions models depend on."""
NAME = "scene.mjb"
EMPTY_ARRAY = np.zeros(0)


class NoContent(Exception):
    """A value of an unsupported type, whose content cannot be hashed."""


def cached_model(
    inputs: Sequence[object], n_shapes: int, build: Callable[[], mujoco.MjModel]
) -> mujoco.MjModel:
    """Return the model that ``build`` compiles, from the cache if possible.

    Args:
        inputs: all values that the model depends on, besides source code.
        n_shapes: the number of shapes of the model.
        build: the function that compiles the model.
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
    """Return a hash of the content of values and of the code that compiles models, (32 bytes).

    Raises:
        NoContent: the type of a value is not supported.
    """
    package = Path(__file__).parents[1]
    digest = hashlib.sha256(code_digest([package / name for name in SOURCES], PACKAGES))
    parts: list[bytes] = []
    _add(tuple(inputs), parts)
    digest.update(b"".join(parts))
    return digest.digest()


def _add(value: object, parts: list[bytes]) -> None:
    """Append the type, length and content of a value, so that different values differ in bytes."""
    if value is None or isinstance(value, bool | int | str | Path | enum.Enum):
        parts.append(_encode(type(value).__name__, f"{value}".encode()))
    elif isinstance(value, float):
        parts.append(b"f" + struct.pack("<d", value))
    elif isinstance(value, bytes):
        parts.append(_encode("bytes", value))
    elif isinstance(value, np.ndarray):
        kind = f"{value.dtype.str} {value.shape}"
        parts.append(_encode(kind, np.ascontiguousarray(value).tobytes()))
    elif isinstance(value, tuple | list) and value and isinstance(value[0], CollisionShape):
        _add_shapes(value, parts)
    elif isinstance(value, tuple | list):
        parts.append(_encode("list", str(len(value)).encode()))
        for element in value:
            _add(element, parts)
    elif isinstance(value, Mapping):
        parts.append(_encode("mapping", str(len(value)).encode()))
        for key, element in value.items():
            _add(key, parts)
            _add(element, parts)
    elif isinstance(value, Pose):
        _add((value.position, value.rotation), parts)
    elif dataclasses.is_dataclass(value) and not isinstance(value, type):
        parts.append(_encode("object", f"{type(value).__module__} {type(value).__name__}".encode()))
        for name in _content_fields(type(value)):
            _add(getattr(value, name), parts)
    else:
        raise NoContent(f"{type(value).__name__} has no content that can be hashed.")


def _add_shapes(shapes: Sequence[CollisionShape], parts: list[bytes]) -> None:
    """Append the content of thousands of shapes, column by column."""
    _add(tuple(f"{shape.kind} {shape.size} {shape.friction}" for shape in shapes), parts)
    columns: list[list[Array]] = [
        [shape.body_from_shape.position for shape in shapes],
        [shape.body_from_shape.rotation for shape in shapes],
        [EMPTY_ARRAY if shape.corners is None else shape.corners for shape in shapes],
        [EMPTY_ARRAY if shape.heights is None else shape.heights for shape in shapes],
    ]
    for arrays in columns:
        forms = " ".join(str(array.shape) for array in arrays)
        parts.append(_encode("forms", forms.encode()))
        _add(np.concatenate([array.ravel() for array in (EMPTY_ARRAY, *arrays)]), parts)


def _encode(kind: str, content: bytes) -> bytes:
    return f"{kind} {len(content)} ".encode() + content


@cache
def _content_fields(kind: Any) -> tuple[str, ...]:
    """Return the names of the fields of a dataclass, except that of the line in the source file."""
    return tuple(field.name for field in dataclasses.fields(kind) if field.name != "source_line")

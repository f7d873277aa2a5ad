"""The lengths in glTF files: of buffers, of views of them, and of accessors in views."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, TypeGuard

Tree = dict[str, Any]

COMPONENT_BYTES = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
"""The size of a number by ``componentType`` [bytes]."""
TYPE_COMPONENTS = {
    **{"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4},
    **{"MAT2": 4, "MAT3": 9, "MAT4": 16},
}
"""The number of components of an element by ``type``."""


def check_views(tree: Tree, chunk: bytes | None) -> Iterator[str]:
    """Report lengths beyond the data of a file.

    Args:
        tree: the JSON of the file, in which the indices between entries are valid.
        chunk: the binary part of a ``.glb``; None for a ``.gltf``.
    """
    buffers, views = tree.get("buffers", []), tree.get("bufferViews", [])
    errors = [*_buffer_errors(buffers, chunk), *_view_errors(views, buffers)]
    yield from errors
    if errors:
        return
    for number, accessor in enumerate(tree.get("accessors", [])):
        yield from _accessor_errors(f"accessors[{number}]", accessor, views)
    if tree.get("meshes") and not views:
        yield "its meshes have no data: it has no bufferViews"


def is_integer(value: object) -> TypeGuard[int]:
    """Return whether a value is a whole number of at least 0."""
    return isinstance(value, int) and not isinstance(value, bool) and value >= 0


def _buffer_errors(buffers: list[Tree], chunk: bytes | None) -> Iterator[str]:
    for number, buffer in enumerate(buffers):
        place, uri, n = f"buffers[{number}]", buffer.get("uri"), buffer.get("byteLength")
        if not is_integer(n):
            yield _describe(f"{place}.byteLength", n, "a number of bytes")
            continue
        if uri is None and (chunk is None or number > 0):
            yield f"its {place} has no uri, and so no data"
            continue
        if uri is not None and not isinstance(uri, str):
            yield _describe(f"{place}.uri", uri, "a text")
            continue
        n_bytes = _count_bytes(uri, chunk)
        if n_bytes is not None and n > n_bytes:
            yield _describe(f"{place}.byteLength", n, f"at most the {n_bytes} bytes of its data")


def _count_bytes(uri: str | None, chunk: bytes | None) -> int | None:
    """Return the size of a buffer's data [bytes]; None if it is in another file."""
    if uri is None:
        return len(chunk or b"")
    _, mark, text = uri.partition("base64,")
    return (len(text) * 3 + 3) // 4 if mark else None


def _view_errors(views: list[Tree], buffers: list[Tree]) -> Iterator[str]:
    for number, view in enumerate(views):
        place, start, n = (
            f"bufferViews[{number}]",
            view.get("byteOffset", 0),
            view.get("byteLength"),
        )
        stride = view.get("byteStride", 1)
        if not is_integer(start) or not is_integer(n):
            yield f"its {place} has no valid byteOffset and byteLength; expected whole numbers"
            continue
        if not is_integer(stride) or stride == 0:
            yield _describe(f"{place}.byteStride", stride, "a positive number of bytes")
        end = buffers[view["buffer"]].get("byteLength")
        if is_integer(end) and start + n > end:
            yield _describe(f"{place}", f"at bytes {start} to {start + n}", f"at most {end}")


def _accessor_errors(place: str, accessor: Tree, views: list[Tree]) -> Iterator[str]:
    count, start = accessor.get("count"), accessor.get("byteOffset", 0)
    component: Any = accessor.get("componentType")
    kind: Any = accessor.get("type")
    has_component = is_integer(component) and component in COMPONENT_BYTES
    has_type = isinstance(kind, str) and kind in TYPE_COMPONENTS
    if not has_component:
        yield _describe(f"{place}.componentType", component, f"one of {[*COMPONENT_BYTES]}")
    if not has_type:
        yield _describe(f"{place}.type", kind, f"one of {', '.join(TYPE_COMPONENTS)}")
    if not is_integer(count):
        yield _describe(f"{place}.count", count, "a number of elements")
    if not is_integer(start):
        yield _describe(f"{place}.byteOffset", start, "a number of bytes")
    is_valid = has_component and has_type
    if not (is_valid and is_integer(count) and is_integer(start)) or "bufferView" not in accessor:
        return
    size = COMPONENT_BYTES[component] * TYPE_COMPONENTS[kind]
    view = views[accessor["bufferView"]]
    n_bytes = start + view.get("byteStride", size) * (count - 1) + size if count else 0
    if n_bytes > view["byteLength"]:
        yield _describe(
            place,
            f"{n_bytes} bytes of bufferViews[{accessor['bufferView']}]",
            f"at most its {view['byteLength']} bytes",
        )


def _describe(place: str, value: object, expected: str) -> str:
    text = value if isinstance(value, str) else "missing" if value is None else repr(value)
    return f"its {place} is {text[:60]}; expected {expected}"

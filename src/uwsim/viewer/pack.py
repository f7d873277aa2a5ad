"""Packs: compressed JSON with the binary arrays that it refers to; `head` defines the format."""

from __future__ import annotations

import base64
import gzip
import json
import struct
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

Ref = tuple[int, int, str]
"""The reference to an array: offset of its first byte, number of elements, element type."""
Json = Mapping[str, Any]

ELEMENT_TYPES = {
    np.dtype(name): element_type
    for name, element_type in (
        ("<f4", "f4"),
        ("<u4", "u4"),
        ("<u2", "u2"),
        ("<i2", "i2"),
        ("i1", "i1"),
        ("u1", "u1"),
    )
}
"""The name of an element type in a reference, by its numpy type."""
# the digits of base 85 that are markup in HTML, and the characters that replace them
_TO_TEXT = bytes.maketrans(b"<>&", b",./")


class Blob:
    """The binary part of a pack: its arrays, one after the other."""

    def __init__(self) -> None:
        self._parts: list[bytes] = []
        self._length = 0

    def add(self, array: npt.NDArray[Any]) -> Ref:
        """Append an array, in row-major order, and return its reference."""
        ref = self._length, array.size, ELEMENT_TYPES[array.dtype]
        data = np.ascontiguousarray(array).tobytes()
        data += bytes(-len(data) % 4)
        self._parts.append(data)
        self._length += len(data)
        return ref

    def add_bytes(self, data: bytes) -> Ref:
        """Append bytes and return their reference."""
        return self.add(np.frombuffer(data, np.uint8))

    @property
    def data(self) -> bytes:
        """The bytes of all arrays."""
        return b"".join(self._parts)


def make_pack(head: Json, blob: Blob) -> bytes:
    """Return the bytes of a pack; equal content gives equal bytes."""
    text = json.dumps(head, separators=(",", ":"), allow_nan=False).encode()
    text += b" " * (-(len(text) + 4) % 8)
    content = struct.pack("<I", len(text)) + text + blob.data
    return gzip.compress(content, compresslevel=9, mtime=0)


def as_text(pack: bytes) -> str:
    """Return a pack as text for HTML: base 85 without markup, 5 characters for 4 bytes (`head`)."""
    return base64.b85encode(pack).translate(_TO_TEXT).decode("ascii")

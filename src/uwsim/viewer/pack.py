"""Packs: JSON with the numbers that it refers to, as the page reads them (`head`)."""

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
"""The reference to an array: offset [byte], count of numbers, kind."""
Json = Mapping[str, Any]

KINDS = {
    np.dtype(name): kind
    for name, kind in (
        ("<f4", "f4"),
        ("<u4", "u4"),
        ("<u2", "u2"),
        ("<i2", "i2"),
        ("i1", "i1"),
        ("u1", "u1"),
    )
}

_TO_TEXT = bytes.maketrans(b"<>&", b",./")


class Blob:
    """The numbers of a pack, one array after the other."""

    def __init__(self) -> None:
        self._parts: list[bytes] = []
        self._length = 0

    def add(self, array: npt.NDArray[Any]) -> Ref:
        """Append an array, flat, and return its reference."""
        ref = self._length, array.size, KINDS[array.dtype]
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
    """Return a pack; the same bytes for the same content."""
    text = json.dumps(head, separators=(",", ":"), allow_nan=False).encode()
    text += b" " * (-(len(text) + 4) % 8)
    content = struct.pack("<I", len(text)) + text + blob.data
    return gzip.compress(content, compresslevel=9, mtime=0)


def as_text(pack: bytes) -> str:
    """Return bytes as text for HTML, 5 characters for 4 bytes: base 85 without markup (`head`)."""
    return base64.b85encode(pack).translate(_TO_TEXT).decode("ascii")

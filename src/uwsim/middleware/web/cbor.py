"""Encoding of messages as CBOR (RFC 8949), with typed arrays (RFC 8746), as rosbridge does."""

from __future__ import annotations

import struct
from typing import Any

import numpy as np

TAGS = {"u1": 64, "u2": 69, "u4": 70, "u8": 71, "i1": 72, "i2": 77, "i4": 78, "i8": 79}
"""The tags of little-endian arrays of integers, by dtype."""
FLOAT_TAGS = {"f4": 85, "f8": 86}
"""The tags of little-endian arrays of floating-point numbers, by dtype."""
SIMPLE_VALUES = {False: b"\xf4", True: b"\xf5", None: b"\xf6"}
"""The encodings of truth values and None."""
_DOUBLE = struct.Struct(">d")


def encode_cbor(value: Any) -> bytes:
    """Encode numbers, texts, bytes, arrays, lists and dicts as CBOR."""
    if value is None or isinstance(value, bool):
        return SIMPLE_VALUES[value]
    if isinstance(value, int):
        return _head(0, value) if value >= 0 else _head(1, -1 - value)
    if isinstance(value, float):
        return b"\xfb" + _DOUBLE.pack(value)
    if isinstance(value, str):
        data = value.encode("utf-8", "surrogatepass")
        return _head(3, len(data)) + data
    if isinstance(value, bytes):
        return _head(2, len(value)) + value
    if isinstance(value, np.ndarray):
        return _encode_array(value)
    if isinstance(value, dict):
        pairs = (encode_cbor(str(key)) + encode_cbor(element) for key, element in value.items())
        return _head(5, len(value)) + b"".join(pairs)
    return _head(4, len(value)) + b"".join(encode_cbor(element) for element in value)


def _encode_array(array: np.ndarray[Any, Any]) -> bytes:
    """Encode bytes as bytes, other numbers as a typed array, truth values as a list."""
    if array.dtype.kind == "b":
        return encode_cbor(array.tolist())
    name = f"{array.dtype.kind}{array.dtype.itemsize}"
    data = array.astype(f"<{name}", copy=False).tobytes()
    if name == "u1":
        return encode_cbor(data)
    return _head(6, {**TAGS, **FLOAT_TAGS}[name]) + encode_cbor(data)


def _head(major_type: int, n: int) -> bytes:
    for code, (limit, form) in enumerate(((2**8, "B"), (2**16, ">H"), (2**32, ">I")), start=24):
        if n < 24:
            return bytes([major_type << 5 | n])
        if n < limit:
            return bytes([major_type << 5 | code]) + struct.pack(form, n)
    return bytes([major_type << 5 | 27]) + struct.pack(">Q", n)

"""Reads packs as the page does."""

from __future__ import annotations

import base64
import gzip
import json
import struct
from typing import Any

import numpy as np
import numpy.typing as npt

from uwsim.viewer.pack import KINDS, Ref


def unpacked(pack: bytes) -> tuple[dict[str, Any], bytes]:
    """Return the JSON of a pack, and the bytes that it refers to."""
    content = gzip.decompress(pack)
    (length,) = struct.unpack_from("<I", content)
    return json.loads(content[4 : 4 + length]), content[4 + length :]


def numbers(ref: Ref | list[Any], data: bytes) -> npt.NDArray[Any]:
    """Return the array that a reference means, flat."""
    offset, count, kind = ref
    dtype = {kind: dtype for dtype, kind in KINDS.items()}[kind]
    return np.frombuffer(data, dtype, count, offset)


def from_text(text: str) -> bytes:
    """Return the bytes of `as_text`."""
    return base64.b85decode(text.encode("ascii").translate(bytes.maketrans(b",./", b"<>&")))

"""Read the packs of scene data that the page of the viewer reads."""

from __future__ import annotations

import base64
import gzip
import json
import struct
from typing import Any

import numpy as np
import numpy.typing as npt

from uwsim.viewer.pack import ELEMENT_TYPES, Ref


def unpack(pack: bytes) -> tuple[dict[str, Any], bytes]:
    """Return the JSON of a pack, and its binary data."""
    content = gzip.decompress(pack)
    (length,) = struct.unpack_from("<I", content)
    return json.loads(content[4 : 4 + length]), content[4 + length :]


def read_array(ref: Ref | list[Any], data: bytes) -> npt.NDArray[Any]:
    """Return the flat array of a reference."""
    offset, count, kind = ref
    dtype = {kind: dtype for dtype, kind in ELEMENT_TYPES.items()}[kind]
    return np.frombuffer(data, dtype, count, offset)


def decode_text(text: str) -> bytes:
    """Decode the text of `as_text`."""
    return base64.b85decode(text.encode("ascii").translate(bytes.maketrans(b",./", b"<>&")))

r"""The record in an image file: which model of the water produced the image, and from what.

A PNG file has it as a text chunk (PNG specification, ISO/IEC 15948, ``iTXt``) with the keyword
``uwsim``, a JPEG file as a comment (ISO/IEC 10918-1, ``COM``). The text is JSON with sorted keys:

.. code-block:: json

    {"camera": "bowtech1", "exposure": 4.0, "image_model": "physical", "scene": "tank.xml",
     "time": 12.5, "transfer": "srgb", "water": "scene"}

Images of 12 bit fill the 16 bit of a PNG as its specification recommends (13.12, sample depth
rescaling): the upper bits repeat in the lower ones,

.. math:: p = 16 n + \lfloor n / 256 \rfloor, \quad n = \lfloor p / 16 \rfloor

and the chunk ``sBIT`` has the number 12. ``gAMA`` says that linear images are linear. So a viewer
shows them as bright as they are, and a reader gets the numbers of the camera back. The bytes depend
on the pixels, the record and the encoder alone.
"""

from __future__ import annotations

import json
import struct
import zlib
from dataclasses import asdict, dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

KEYWORD = "uwsim"
"""The keyword of the text chunk, and the first word of the comment."""
SIGNATURE = b"\x89PNG\r\n\x1a\n"
HEADER_SIZE = len(SIGNATURE) + 25
"""The size of the signature and of the first chunk, IHDR [bytes]."""
JPEG_START = b"\xff\xd8"
LINEAR_GAMMA = 100_000
"""The value of ``gAMA`` of linear numbers, 1 / 100000."""
N_BITS = 12
"""The number of bits of a linear camera."""
MAX_COMMENT = 65533
"""The greatest size of a comment of JPEG [bytes]."""


@dataclass(frozen=True, kw_only=True)
class ImageRecord:
    """The origin of an image."""

    scene: str
    """The name of the scene file."""
    time: float
    """The simulation time [s]."""
    camera: str
    """The name of the camera or of the view."""
    image_model: Literal["uwsim", "physical"]
    """The model of the water: ``uwsim``, its fog law, or ``physical``."""
    water: Literal["scene", "purest"] = "scene"
    """The water: that of the scene, or the purest one in views without fog."""
    exposure: float | None = None
    """The ratio of linear full scale to radiance; None with UWSim's law."""
    transfer: Literal["srgb", "linear", "uwsim"] = "uwsim"
    """The curve of the stored values: sRGB's, linear, or none with UWSim's law."""

    @property
    def text(self) -> str:
        """The text in an image file."""
        return json.dumps(asdict(self), sort_keys=True, ensure_ascii=True)


def add_record(image: bytes, record: ImageRecord, *, n_bits: int = 0) -> bytes:
    """Return a PNG or JPEG file with a record.

    Args:
        image: the file; other formats are returned as they are.
        record: the record.
        n_bits: the number of significant bits of a PNG of more; 0: all.
    """
    if image.startswith(SIGNATURE):
        n_channels = 3 if image[25] & 2 else 1  # IHDR's colour type
        chunks = _make_chunk(
            b"iTXt", KEYWORD.encode() + b"\0\0\0\0\0" + record.text.encode("utf-8")
        )
        if record.transfer == "linear":
            chunks = _make_chunk(b"gAMA", struct.pack(">I", LINEAR_GAMMA)) + chunks
        if n_bits:
            chunks = _make_chunk(b"sBIT", bytes([n_bits] * n_channels)) + chunks
        return image[:HEADER_SIZE] + chunks + image[HEADER_SIZE:]
    if image.startswith(JPEG_START):
        comment = f"{KEYWORD} {record.text}".encode()[:MAX_COMMENT]
        segment = b"\xff\xfe" + struct.pack(">H", len(comment) + 2) + comment
        return JPEG_START + segment + image[len(JPEG_START) :]
    return image


def remove_record(png: bytes) -> bytes:
    """Return a PNG file of 8 bit without its record; other files are returned as they are."""
    record = b"iTXt" + KEYWORD.encode() + b"\0"
    start = HEADER_SIZE
    if not png.startswith(SIGNATURE) or png[start + 4 : start + 4 + len(record)] != record:
        return png
    (length,) = struct.unpack(">I", png[start : start + 4])
    return png[:start] + png[start + length + 12 :]


def fill_sixteen_bits(numbers: npt.NDArray[np.uint16]) -> npt.NDArray[np.uint16]:
    """Return numbers of 12 bit, 0 to 4095, over the whole range of 16 bit, 0 to 65535."""
    return ((numbers << 4) | (numbers >> 8)).astype(np.uint16)


def _make_chunk(kind: bytes, content: bytes) -> bytes:
    checksum = zlib.crc32(kind + content)
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", checksum)

"""Images of textures: arrays of pixels, and encoded images that are decoded when they are read."""

from __future__ import annotations

import io
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt


@dataclass(frozen=True, eq=False)
class PixelImage:
    """An image whose pixels are in memory."""

    pixels: npt.NDArray[np.uint8]
    """The stored values, (h, w, 3) or (h, w, 4), row 0 at the top."""
    jpeg: None = None
    """The bytes of a JPEG file: there are none."""


@dataclass(frozen=True, eq=False)
class EncodedImage:
    """An image of the package that is decoded when its pixels are read for the first time.

    A scene without cameras does not read them, so that it decodes no image.
    """

    data: bytes
    """The bytes of a JPEG or PNG file."""
    is_jpeg: bool
    """True if the bytes are those of a JPEG file."""

    @cached_property
    def pixels(self) -> npt.NDArray[np.uint8]:
        """The stored values, (h, w, 3), row 0 at the top."""
        from PIL import Image

        with Image.open(io.BytesIO(self.data)) as picture:
            return np.array(picture.convert("RGB"), dtype=np.uint8)

    @property
    def jpeg(self) -> bytes | None:
        """The bytes, if they are those of a JPEG file."""
        return self.data if self.is_jpeg else None

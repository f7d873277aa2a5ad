"""The images that structured-light projectors project: red, green, blue and opacity."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..errors import AssetError
from .loaders.materials import check_image_size

FORMATS = ("BMP", "GIF", "JPEG", "PNG", "PPM", "TGA", "TIFF")
"""The image formats that are read."""
MAX_SIDE = 4096
"""The greatest side of a pattern [px]."""


def read_pattern(path: Path) -> npt.NDArray[np.uint8]:
    """Read an image, (h, w, 4), row 0 at the top; one without opacity is opaque.

    Raises:
        AssetError: the file is not an image in one of `FORMATS`, or is too large.
    """
    from PIL import Image

    check_image_size(path.read_bytes(), path.name)
    try:
        with Image.open(path, formats=FORMATS) as image:
            if max(image.size) > MAX_SIDE:
                raise AssetError(
                    f"{path} has {image.size} pixels; expected at most {MAX_SIDE} a side."
                )
            return np.asarray(image.convert("RGBA"), dtype=np.uint8).copy()
    except (OSError, ValueError, SyntaxError) as error:
        raise AssetError(f"{path} cannot be read as an image: {error}") from error

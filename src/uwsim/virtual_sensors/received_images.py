"""The decoding of images and depth images that arrive on topics."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..assets.loaders.materials import check_image_size
from ..errors import AssetError
from ..messages import CompressedImage, Image
from ..messages.bag_camera import BYTES_PER_PIXEL, GREY_ENCODINGS, RED_FIRST_ENCODINGS

DEPTH_ENCODINGS = {"32FC1": ("<f4", 1.0), "16UC1": ("<u2", 1e-3), "mono16": ("<u2", 1e-3)}
"""The number type of depth images, and the length of their unit [m], by encoding."""
MILLIMETRE_ENCODING = "16UC1"


def decode_image(message: Image | CompressedImage) -> npt.NDArray[np.uint8]:
    """Return the pixels of an image, (h, w, 3) red first, or (h, w) if it is grey.

    Raises:
        AssetError: the encoding is not supported, the size does not match the data, or the image is
            too large.
    """
    if isinstance(message, CompressedImage):
        return _decompress(message)
    encoding = message.encoding
    if encoding not in (*GREY_ENCODINGS, *BYTES_PER_PIXEL):
        raise AssetError(
            f"an image is encoded as {encoding[:40]!r}; expected one of "
            f"{', '.join((*GREY_ENCODINGS, *BYTES_PER_PIXEL))}."
        )
    n_bytes = BYTES_PER_PIXEL.get(encoding, 1)
    rows = _read_rows(message, n_bytes)
    if encoding in GREY_ENCODINGS:
        return rows
    pixels = rows.reshape(message.height, message.width, n_bytes)[..., :3]
    return pixels if encoding in RED_FIRST_ENCODINGS else pixels[..., ::-1]


def decode_depth(message: Image) -> npt.NDArray[np.float64]:
    """Return the distances along the optical axis of a depth image, (h, w) [m]; inf: unknown.

    Raises:
        AssetError: the encoding is not that of a depth image, or the size does not match the data.
    """
    if message.encoding not in DEPTH_ENCODINGS:
        raise AssetError(
            f"a depth image is encoded as {message.encoding[:40]!r}; expected one of "
            f"{', '.join(DEPTH_ENCODINGS)}."
        )
    number_type, unit = DEPTH_ENCODINGS[message.encoding]
    if message.is_bigendian:
        number_type = number_type.replace("<", ">")
    rows = _read_rows(message, np.dtype(number_type).itemsize)
    depth = np.frombuffer(rows.tobytes(), dtype=number_type).astype(np.float64) * unit
    with np.errstate(invalid="ignore"):
        depth[~(depth > 0.0)] = np.inf  # 0 and NaN: no measurement
    return depth.reshape(message.height, message.width)


def _read_rows(message: Image, n_bytes: int) -> npt.NDArray[np.uint8]:
    """Return the bytes of the pixels, (h, w * n_bytes)."""
    height, width, step = int(message.height), int(message.width), int(message.step)
    data = np.asarray(message.data, dtype=np.uint8)
    if height < 1 or width < 1 or step < width * n_bytes or len(data) < height * step:
        raise AssetError(
            f"an image has a header for {width}x{height} pixels of {n_bytes} bytes in rows of "
            f"{step}, and {len(data)} bytes of pixels."
        )
    return data[: height * step].reshape(height, step)[:, : width * n_bytes]


def _decompress(message: CompressedImage) -> npt.NDArray[np.uint8]:
    import cv2

    data = np.asarray(message.data, dtype=np.uint8)
    check_image_size(data.tobytes(), "a compressed image")
    image = cv2.imdecode(data, cv2.IMREAD_UNCHANGED) if len(data) else None
    if image is None or image.dtype != np.uint8:
        raise AssetError(
            f"an image is compressed as {str(message.format)[:40]!r}; expected an image of 8 bits "
            "that OpenCV can read."
        )
    pixels = np.asarray(image, dtype=np.uint8)
    return pixels if pixels.ndim == 2 else pixels[..., 2::-1]

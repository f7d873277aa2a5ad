"""Functions that build and read common messages."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ..base.geometry import Pose
from .geometry_msgs import Quaternion, Transform, TransformStamped, Vector3
from .sensor_msgs import Image
from .std_msgs import Float32MultiArray, Header, MultiArrayLayout, Time

WIDE_ENCODINGS = ("rgb16", "mono16")
"""The encodings of images whose numbers have 16 bit."""
NANOSECONDS = 1_000_000_000
"""The number of nanoseconds in a second."""


def time_from_seconds(time: float) -> Time:
    """Return ``time`` [s] as a ROS time, to the nearest nanosecond."""
    total = round(time * NANOSECONDS)
    return Time(sec=total // NANOSECONDS, nanosec=total % NANOSECONDS)


def seconds(stamp: Time) -> float:
    """Return a ROS time in seconds."""
    return stamp.sec + stamp.nanosec / NANOSECONDS


def header(time: float, frame_id: str = "") -> Header:
    """Build a header for simulation time ``time`` [s]."""
    return Header(stamp=time_from_seconds(time), frame_id=frame_id)


def image(
    pixels: npt.NDArray[np.uint8] | npt.NDArray[np.uint16], *, time: float, frame_id: str = ""
) -> Image:
    """Build an ``rgb8`` image from (h, w, 3) or ``mono8`` from (h, w); row 0 is the top.

    Numbers of 16 bit give ``rgb16`` or ``mono16``.
    """
    height, width = pixels.shape[:2]
    channels = 3 if pixels.ndim == 3 else 1
    n_bits = 8 * pixels.itemsize
    values = np.ascontiguousarray(pixels, dtype=f"<u{pixels.itemsize}")
    return Image(
        header=header(time, frame_id),
        height=height,
        width=width,
        encoding=f"rgb{n_bits}" if channels == 3 else f"mono{n_bits}",
        is_bigendian=0,
        step=width * channels * pixels.itemsize,
        data=values.reshape(-1).view(np.uint8),
    )


def depth_image(depth: npt.NDArray[np.float64], *, time: float, frame_id: str = "") -> Image:
    """Build a ``32FC1`` image, as in REP 118, from depths (h, w) [m]; row 0 is the top."""
    return _one_channel(depth, "32FC1", "<f4", header(time, frame_id))


def image_of(values: npt.NDArray[Any], *, time: float) -> Image:
    """Build the image of values (h, w, 3) or (h, w, 1): of 8 or 16 bit, or of depths (float32)."""
    one_channel = values[..., 0]
    if values.dtype == np.float32:
        return depth_image(one_channel, time=time)
    return image(values if values.shape[2] == 3 else one_channel, time=time)


def array_of(message: Image) -> npt.NDArray[Any]:
    """Return the values of an image of `image_of`, (h, w, 3) or (h, w, 1), without a copy."""
    encoding = message.encoding
    number_type = "<f4" if encoding == "32FC1" else "<u2" if encoding in WIDE_ENCODINGS else "u1"
    return message.data.view(number_type).reshape(message.height, message.width, -1)


def label_image(labels: npt.NDArray[np.uint16], *, time: float, frame_id: str = "") -> Image:
    """Build a ``16UC1`` image from whole numbers (h, w); row 0 is the top."""
    return _one_channel(labels, "16UC1", "<u2", header(time, frame_id))


def _one_channel(values: npt.NDArray[Any], encoding: str, dtype: str, head: Header) -> Image:
    """Build an image of one channel from values (h, w)."""
    height, width = values.shape
    return Image(
        header=head,
        height=height,
        width=width,
        encoding=encoding,
        is_bigendian=0,
        step=np.dtype(dtype).itemsize * width,
        data=np.ascontiguousarray(values, dtype=dtype).reshape(-1).view(np.uint8),
    )


def pixels_of(message: Image) -> npt.NDArray[np.uint8]:
    """Return the pixels of an ``rgb8`` (h, w, 3) or ``mono8`` (h, w) image, without a copy.

    Of ``rgb16`` and ``mono16``, with the numbers 0 to 4095 of a camera of 12 bit, they are copied
    and have the upper 8 of these 12 bits.
    """
    values = message.data
    if message.encoding in WIDE_ENCODINGS:
        values = (numbers_of(message).reshape(-1) >> 4).astype(np.uint8)
    if message.encoding in ("mono8", "mono16"):
        return values.reshape(message.height, message.width)
    return values.reshape(message.height, message.width, 3)


def numbers_of(message: Image) -> npt.NDArray[np.uint16]:
    """Return the numbers of an ``rgb16`` (h, w, 3) or ``mono16`` (h, w) image, without a copy."""
    numbers = message.data.view("<u2")
    if message.encoding == "mono16":
        return numbers.reshape(message.height, message.width)
    return numbers.reshape(message.height, message.width, 3)


def floats(values: Sequence[float] | npt.NDArray[np.float64]) -> Float32MultiArray:
    """Build a Float32MultiArray without a layout."""
    return Float32MultiArray(
        layout=MultiArrayLayout(dim=[], data_offset=0), data=np.asarray(values, dtype=np.float32)
    )


def transform(parent: str, child: str, parent_from_child: Pose, time: float) -> TransformStamped:
    """Build a transform at ``time`` [s]; leading slashes of names are removed, as tf2 requires."""
    w, x, y, z = parent_from_child.quaternion.tolist()
    px, py, pz = parent_from_child.position.tolist()
    return TransformStamped(
        header=header(time, parent.strip().lstrip("/")),
        child_frame_id=child.strip().lstrip("/"),
        transform=Transform(
            translation=Vector3(x=px, y=py, z=pz), rotation=Quaternion(x=x, y=y, z=z, w=w)
        ),
    )

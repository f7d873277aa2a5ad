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


def image(pixels: npt.NDArray[np.uint8], *, time: float, frame_id: str = "") -> Image:
    """Build an ``rgb8`` image from (h, w, 3) or ``mono8`` from (h, w); row 0 is the top."""
    height, width = pixels.shape[:2]
    channels = 3 if pixels.ndim == 3 else 1
    return Image(
        header=header(time, frame_id),
        height=height,
        width=width,
        encoding="rgb8" if channels == 3 else "mono8",
        is_bigendian=0,
        step=width * channels,
        data=np.ascontiguousarray(pixels).reshape(-1),
    )


def depth_image(depth: npt.NDArray[np.float64], *, time: float, frame_id: str = "") -> Image:
    """Build a ``32FC1`` image, as in REP 118, from depths (h, w) [m]; row 0 is the top."""
    return _one_channel(depth, "32FC1", "<f4", header(time, frame_id))


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
    """Return the pixels of an ``rgb8`` (h, w, 3) or ``mono8`` (h, w) image, without a copy."""
    if message.encoding == "mono8":
        return message.data.reshape(message.height, message.width)
    return message.data.reshape(message.height, message.width, 3)


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

"""Conversion of sensor_msgs/PointCloud2 of any layout to arrays, and of arrays to PointCloud2.

A cloud is ``height`` rows of ``width`` points. A row takes ``row_step`` bytes, a point takes
``point_step`` bytes, and each field of a point has an offset in these: padding and other fields
are skipped. x, y, z may each be float32 or float64, in either byte order.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..errors import BadSetting
from .build import header
from .sensor_msgs import PointCloud2, PointField

FLOAT_TYPES = {7: "f4", 8: "f8"}
"""The names in NumPy, without byte order, of the PointField types FLOAT32 and FLOAT64."""
OTHER_TYPES = {1: "int8", 2: "uint8", 3: "int16", 4: "uint16", 5: "int32", 6: "uint32"}
"""The names of the other PointField types in error messages."""


def points(cloud: PointCloud2) -> npt.NDArray[np.float64]:
    """Return x, y, z of every point, row by row, (n, 3) [m]; NaN is kept.

    Raises:
        BadSetting: the cloud has no x, y, z, one of them is not a float, or bytes are missing.
    """
    try:
        return _points(cloud)
    except (AttributeError, TypeError, ValueError) as error:  # a message built by other code
        raise BadSetting(f"it cannot be read: {error}") from error


def _points(cloud: PointCloud2) -> npt.NDArray[np.float64]:
    data = np.ascontiguousarray(cloud.data, dtype=np.uint8).reshape(-1)
    height, width = int(cloud.height), int(cloud.width)
    step, row = int(cloud.point_step), int(cloud.row_step)
    order = ">" if cloud.is_bigendian else "<"
    coordinates = [_find_coordinate(cloud, axis, step) for axis in "xyz"]
    if height <= 0 or width <= 0:
        return np.empty((0, 3))
    if height > 1 and row < width * step:
        raise BadSetting(f"its row_step is {row}, too short for {width} points of {step} bytes")
    n_bytes = (height - 1) * row + width * step  # the last row may have no padding
    if data.size < n_bytes:
        raise BadSetting(f"it has {data.size} bytes, {height} x {width} points need {n_bytes}")
    xyz = np.empty((height, width, 3))
    for axis, (offset, kind) in enumerate(coordinates):
        xyz[..., axis] = np.ndarray(
            (height, width), np.dtype(order + kind), data, offset, (row, step)
        )
    return xyz.reshape(-1, 3)


def _find_coordinate(cloud: PointCloud2, axis: str, step: int) -> tuple[int, str]:
    """Return the offset of a coordinate in a point [byte], and the name of its type in NumPy."""
    coordinate = next((field for field in cloud.fields if field.name == axis), None)
    if coordinate is None:
        names = ", ".join(repr(field.name[:20]) for field in list(cloud.fields)[:8]) or "none"
        raise BadSetting(f"it has no field {axis!r}; its fields: {names}")
    kind = FLOAT_TYPES.get(int(coordinate.datatype))
    if kind is None:
        type_name = OTHER_TYPES.get(int(coordinate.datatype), f"of type {int(coordinate.datatype)}")
        raise BadSetting(f"its field {axis!r} is {type_name}; expected float32 or float64")
    offset = int(coordinate.offset)
    if offset < 0 or offset + int(kind[1]) > step:
        raise BadSetting(f"its field {axis!r} at byte {offset} lies outside a point of {step}")
    return offset, kind


def point_colours(cloud: PointCloud2) -> npt.NDArray[np.uint8]:
    """Return red, green, blue of every point from its field ``rgb`` or ``rgba``, (n, 3).

    Raises:
        BadSetting: the cloud has no such field, or bytes are missing.
    """
    colours = next((field for field in cloud.fields if field.name in ("rgb", "rgba")), None)
    if colours is None:
        raise BadSetting("it has four fields, none of them 'rgb'")
    offset, step = int(colours.offset), int(cloud.point_step)
    height, width, row = int(cloud.height), int(cloud.width), int(cloud.row_step)
    if offset < 0 or offset + 4 > step:
        raise BadSetting(
            f"its field {colours.name!r} at byte {offset} lies outside a point of {step}"
        )
    data = np.ascontiguousarray(cloud.data, dtype=np.uint8).reshape(-1)
    if height <= 0 or width <= 0:
        return np.empty((0, 3), dtype=np.uint8)
    try:
        colour_bytes = np.ndarray((height, width, 4), np.uint8, data, offset, (row, step, 1))
    except (TypeError, ValueError) as error:  # a message built by other code
        raise BadSetting(f"it cannot be read: {error}") from error
    order = [1, 2, 3] if cloud.is_bigendian else [2, 1, 0]
    return colour_bytes[..., order].reshape(-1, 3)


def point_cloud(
    positions: npt.NDArray[np.float64], *, time: float = 0.0, frame_id: str = ""
) -> PointCloud2:
    """Build a point cloud with float32 x, y, z.

    Args:
        positions: the points [m], (n, 3); or (h, w, 3), one for each pixel, row 0 at the top.
        time: the time stamp of the cloud [s].
        frame_id: the name of the frame of the points.
    """
    height, width = (1, len(positions)) if positions.ndim == 2 else positions.shape[:2]
    return PointCloud2(
        header=header(time, frame_id),
        height=height,
        width=width,
        fields=[PointField(name=a, offset=4 * i, datatype=7, count=1) for i, a in enumerate("xyz")],
        is_bigendian=False,
        point_step=12,
        row_step=12 * width,
        data=np.frombuffer(np.ascontiguousarray(positions, dtype="<f4").tobytes(), dtype=np.uint8),
        is_dense=bool(np.isfinite(positions).all()),
    )

"""Write small bags with rosbags: ROS 1, ROS 2 with SQLite, ROS 2 with MCAP."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_typestore

KINDS = ("ros1", "sqlite3", "mcap")
IMAGE, INFO = "/camera/image_raw", "/camera/camera_info"
START_TIME = 1_700_000_000_000_000_000  # [ns]
NAMES = {"ros1": "dive.bag", "sqlite3": "dive", "mcap": "dive"}


def sample_pixels(shade: int, encoding: str = "rgb8") -> np.ndarray:
    """Return an image of 5x4 pixels with varied values, in the order of the encoding."""
    channels = {"mono8": 1, "rgba8": 4, "bgra8": 4}.get(encoding, 3)
    values = (np.arange(4 * 5 * channels) * 13 + shade) % 256
    shape = (4, 5) if channels == 1 else (4, 5, channels)
    return values.astype(np.uint8).reshape(shape)


def write_bag(
    folder: Path,
    kind: str,
    frames: Sequence[tuple[float, np.ndarray]],
    *,
    encoding: str = "rgb8",
    padding: int = 0,
    with_info: bool = True,
    image_type: str = "sensor_msgs/msg/Image",
) -> Path:
    """Write images at times [s], each with a camera's info 1 ms later; return the path."""
    is_ros1 = kind == "ros1"
    store = get_typestore(Stores.ROS1_NOETIC if is_ros1 else Stores.ROS2_HUMBLE)
    types = store.types
    path = folder / NAMES[kind]
    plugin = StoragePlugin.MCAP if kind == "mcap" else StoragePlugin.SQLITE3
    writer: Any = Writer1(path) if is_ros1 else Writer2(path, version=9, storage_plugin=plugin)

    def header(time: float) -> Any:
        stamp = types["builtin_interfaces/msg/Time"](sec=int(time) + 7, nanosec=0)
        seq = {"seq": 0} if is_ros1 else {}
        return types["std_msgs/msg/Header"](stamp=stamp, frame_id="bow", **seq)

    def image(time: float, pixels: np.ndarray) -> Any:
        if image_type == "std_msgs/msg/String":
            return types[image_type](data="no image")
        if image_type == "sensor_msgs/msg/CompressedImage":
            _, png_data = cv2.imencode(".png", pixels)
            return types[image_type](header=header(time), format="png", data=png_data.reshape(-1))
        rows = pixels.reshape(pixels.shape[0], -1)
        padded_rows = np.pad(rows, ((0, 0), (0, padding)), constant_values=77)
        return types[image_type](
            header=header(time),
            height=pixels.shape[0],
            width=pixels.shape[1],
            encoding=encoding,
            is_bigendian=0,
            step=padded_rows.shape[1],
            data=padded_rows.reshape(-1),
        )

    def info(time: float) -> Any:
        matrices = {
            "d": np.array([0.1, 0.0]),
            "k": np.arange(9.0) + time,
            "r": np.eye(3).reshape(-1),
            "p": np.arange(12.0),
        }
        roi = types["sensor_msgs/msg/RegionOfInterest"](
            x_offset=0, y_offset=0, height=0, width=0, do_rectify=False
        )
        return types["sensor_msgs/msg/CameraInfo"](
            header=header(time),
            height=4,
            width=5,
            distortion_model="plumb_bob",
            binning_x=0,
            binning_y=0,
            roi=roi,
            **{name.upper() if is_ros1 else name: values for name, values in matrices.items()},
        )

    with writer:
        images = writer.add_connection(IMAGE, image_type, typestore=store)
        infos = writer.add_connection(INFO, "sensor_msgs/msg/CameraInfo", typestore=store)
        serialize = store.serialize_ros1 if is_ros1 else store.serialize_cdr
        for time, pixels in frames:
            timestamp = START_TIME + round(time * 1e9)
            writer.write(images, timestamp, serialize(image(time, pixels), image_type))
            if with_info:
                info_data = serialize(info(time), "sensor_msgs/msg/CameraInfo")
                writer.write(infos, timestamp + 1_000_000, info_data)
    return path

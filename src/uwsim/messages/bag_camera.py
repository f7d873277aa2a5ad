"""The images and camera info of one camera in a ROS 1 or ROS 2 bag.

The bag is a ``.bag`` file, a rosbag2 folder, or a single ``.mcap`` or ``.db3`` file. The package
rosbags reads it while it is replayed: one image at a time is in memory.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from rosbags.interfaces import Connection

from ..base.files.input_files import is_inside
from ..errors import AssetError, UnknownName
from . import CameraInfo, Header, RegionOfInterest, Time

IMAGE = "sensor_msgs/msg/Image"
DEPTH_UNITS = {"32FC1": ("f4", 1.0), "16UC1": ("u2", 1e-3)}
"""The number type of depth images, and the length of their unit [m], by encoding."""
COMPRESSED_IMAGE = "sensor_msgs/msg/CompressedImage"
CAMERA_INFO = "sensor_msgs/msg/CameraInfo"
GREY_ENCODINGS = ("mono8", "8UC1")
"""The encodings with one byte per pixel."""
BYTES_PER_PIXEL = {"rgb8": 3, "bgr8": 3, "8UC3": 3, "rgba8": 4, "bgra8": 4}
"""The number of bytes per pixel of colour encodings; ``8UC3`` begins with blue, as in OpenCV."""
RED_FIRST_ENCODINGS = ("rgb8", "rgba8")
"""The colour encodings that begin with red; the others begin with blue."""


@dataclass(frozen=True, eq=False)
class DecodedImage:
    """A decoded image."""

    pixels: npt.NDArray[np.uint8]
    """The pixels, (h, w, 3) red, green, blue, or (h, w) grey; row 0 is the top."""
    is_blue_first: bool
    """True if blue is the first channel in the recording."""
    frame_id: str
    """The ``frame_id`` in the header of the image."""


@dataclass(frozen=True, eq=False)
class RecordedFrame:
    """An image in a recording, not decoded yet."""

    time: int
    """The time of recording, 0 for the first image [ns]."""
    info: Any
    """The newest CameraInfo recorded before the image; if there is none, the first CameraInfo."""
    label: str
    """The name of the image in error messages."""
    read: Callable[[], Any]
    """A function that returns the Image or CompressedImage, of the classes of rosbags."""
    read_depth: Callable[[], Any] | None = None
    """A function that returns the newest depth image; None: there is none."""

    def decode_depth(self) -> npt.NDArray[np.float64] | None:
        """Return the distance along the optical axis, (h, w) [m]; inf: unknown; None: no image.

        Raises:
            AssetError: the encoding is not supported, or the size does not match the data.
        """
        if self.read_depth is None:
            return None
        message = self.read_depth()
        encoding = str(message.encoding)
        if encoding not in DEPTH_UNITS:
            raise AssetError(
                f"The depth of {self.label} is encoded as {encoding[:40]!r}; expected "
                f"{' or '.join(DEPTH_UNITS)}."
            )
        kind, unit = DEPTH_UNITS[encoding]
        dtype = np.dtype((">" if message.is_bigendian else "<") + kind)
        height, width, step = message.height, message.width, message.step
        row_size = width * dtype.itemsize
        if height < 1 or width < 1 or step < row_size or len(message.data) < height * step:
            raise AssetError(
                f"The depth of {self.label} has a header for {width}x{height} numbers of "
                f"{dtype.itemsize} bytes in rows of {step}, and {len(message.data)} bytes."
            )
        rows = np.frombuffer(message.data, dtype=np.uint8)[: height * step].reshape(height, step)
        numbers = np.ascontiguousarray(rows[:, :row_size]).view(dtype)
        depth: npt.NDArray[np.float64] = numbers.astype(np.float64) * unit
        with np.errstate(invalid="ignore"):
            depth[~(depth > 0.0)] = np.inf  # 0 and NaN: no measurement
        return depth

    def decode(self) -> DecodedImage:
        """Decode the image.

        Raises:
            AssetError: the encoding is not supported, or the size does not match the data.
        """
        message = self.read()
        is_compressed = message.__msgtype__ == COMPRESSED_IMAGE
        pixels, is_blue_first = (
            self._decompress(message) if is_compressed else self._read_pixels(message)
        )
        return DecodedImage(pixels, is_blue_first, str(message.header.frame_id))

    def _read_pixels(self, message: Any) -> tuple[npt.NDArray[np.uint8], bool]:
        encoding = str(message.encoding)
        if encoding not in (*GREY_ENCODINGS, *BYTES_PER_PIXEL):
            raise AssetError(
                f"{self.label} is encoded as {encoding[:40]!r}; expected one of "
                f"{', '.join((*GREY_ENCODINGS, *BYTES_PER_PIXEL))}."
            )
        depth = BYTES_PER_PIXEL.get(encoding, 1)
        height, width, step = message.height, message.width, message.step
        if height < 1 or width < 1 or step < width * depth or len(message.data) < height * step:
            raise AssetError(
                f"{self.label} has a header for {width}x{height} pixels of {depth} bytes in rows "
                f"of {step}, and {len(message.data)} bytes of pixels."
            )
        rows = np.frombuffer(message.data, dtype=np.uint8)[: height * step].reshape(height, step)
        if encoding in GREY_ENCODINGS:
            return rows[:, :width], False
        pixels = rows[:, : width * depth].reshape(height, width, depth)[..., :3]
        return (pixels, False) if encoding in RED_FIRST_ENCODINGS else (pixels[..., ::-1], True)

    def _decompress(self, message: Any) -> tuple[npt.NDArray[np.uint8], bool]:
        import cv2

        data = np.frombuffer(message.data, dtype=np.uint8)
        image = cv2.imdecode(data, cv2.IMREAD_UNCHANGED) if len(data) else None
        if image is None or image.dtype != np.uint8:
            raise AssetError(
                f"{self.label} is compressed as {str(message.format)[:40]!r}; expected an image "
                "of 8 bits that OpenCV can read."
            )
        pixels = np.asarray(image, dtype=np.uint8)
        return (pixels, False) if pixels.ndim == 2 else (pixels[..., 2::-1], True)


class Recording:
    """The recording of one camera in a bag.

    Args:
        path: a ``.bag``, ``.mcap`` or ``.db3`` file, or a rosbag2 folder.
        image_topic: the topic of the Image or CompressedImage messages.
        info_topic: the topic of the CameraInfo messages.
        depth_topic: the topic of depth images; empty: none.

    Raises:
        AssetError: the bag cannot be read, a topic has another type, or there is nothing to replay.
        UnknownName: a topic is not in the bag.
    """

    def __init__(
        self, path: Path, image_topic: str, info_topic: str, depth_topic: str = ""
    ) -> None:
        from rosbags.highlevel import AnyReader
        from rosbags.typesys import Stores, get_typestore

        self._name = path.name
        self._image_topic = image_topic
        if path.is_dir():
            _check_folder(path)
        try:
            self._reader = AnyReader([path], default_typestore=get_typestore(Stores.ROS2_JAZZY))
            self._reader.open()
        except Exception as error:  # a damaged bag may raise anything
            raise self._read_error(error) from error
        try:
            self._start = 0  # time of the first image [ns]
            self._images = self._connections(image_topic, (IMAGE, COMPRESSED_IMAGE))
            self._infos = self._connections(info_topic, (CAMERA_INFO,))
            self._depths = self._connections(depth_topic, (IMAGE,)) if depth_topic else []
            self._first_info = self._read_first_info(info_topic)
            frames = self.frames()
            first_frame = next(frames, None)
            gap = next((frame.time for frame in frames if frame.time > 0), None)
            if first_frame is None or gap is None:
                raise AssetError(
                    f"Topic {image_topic!r} of {self._name} has no two images at different "
                    "times; replay needs their spacing.",
                    name=image_topic,
                )
            first_frame.decode()
        except BaseException:
            self.close()
            raise
        self.first_frame = first_frame
        """The first image."""
        self.gap = gap
        """The time from the first image to the next one with another time [ns]."""
        self.length = max(self._reader.end_time - self._start, gap)
        """The time from the first image to the last message of any topic [ns]."""

    def frames(self) -> Iterator[RecordedFrame]:
        """Yield the images in the order in which they were recorded."""
        start: int | None = None
        read_depth: Callable[[], Any] | None = None
        info, count = self._first_info, 0
        connections = [*self._images, *self._infos, *self._depths]
        for connection, time, data in self._messages(connections):
            if connection.msgtype == CAMERA_INFO:
                info = self._decode(data, CAMERA_INFO)
                continue
            if connection in self._depths:
                read_depth = partial(self._decode, data, connection.msgtype)
                continue
            count += 1
            if start is None:
                start = self._start = time
            label = f"Image {count} of {self._image_topic!r} in {self._name}"
            read = partial(self._decode, data, connection.msgtype)
            yield RecordedFrame(time - start, info, label, read, read_depth)

    def close(self) -> None:
        """Close the files."""
        self._reader.close()

    def _connections(self, topic: str, types: tuple[str, ...]) -> list[Connection]:
        topic_name = topic.strip("/")
        connections = [c for c in self._reader.connections if c.topic.strip("/") == topic_name]
        if not connections:
            raise UnknownName(
                f"topic in {self._name}", topic, {c.topic for c in self._reader.connections}
            )
        for connection in connections:
            if connection.msgtype not in types:
                raise AssetError(
                    f"Topic {topic!r} of {self._name} carries {connection.msgtype}; expected "
                    f"{' or '.join(types)}.",
                    name=topic,
                )
        return connections

    def _read_first_info(self, topic: str) -> Any:
        for connection, _, data in self._messages(self._infos):
            return self._decode(data, connection.msgtype)
        raise AssetError(f"Topic {topic!r} of {self._name} has no messages.", name=topic)

    def _messages(self, connections: list[Connection]) -> Iterator[tuple[Connection, int, bytes]]:
        messages = self._reader.messages(connections)
        while True:
            try:
                message = next(messages, None)
            except Exception as error:  # a damaged bag may raise anything
                raise self._read_error(error) from error
            if message is None:
                return
            yield message

    def _decode(self, data: bytes, msgtype: str) -> Any:
        try:
            return self._reader.deserialize(data, msgtype)
        except Exception as error:  # a damaged bag may raise anything
            raise self._read_error(error) from error

    def _read_error(self, error: Exception) -> AssetError:
        message = " ".join(str(error).split())[:200] or type(error).__name__
        return AssetError(f"{self._name} cannot be read as a recording: {message}")


def _check_folder(bag: Path) -> None:
    """Check that all files of a rosbag2 folder are regular files inside the folder.

    Raises:
        AssetError: a link leads out of the folder, or an entry is not a regular file.
    """
    for file in sorted(bag.iterdir()):
        if not is_inside(file, [bag]):
            raise AssetError(f"{bag.name}/{file.name} leads out of the recording's folder.")
        if not file.is_file() and not file.is_dir():
            raise AssetError(f"{bag.name}/{file.name} is not a regular file.")


def camera_info(info: Any, *, stamp: Time, frame_id: str) -> CameraInfo:
    """Convert a recorded CameraInfo; ROS 1 names its fields d, k, r, p in capitals.

    Args:
        info: the CameraInfo, of a class of rosbags.
        stamp: the time stamp of the result.
        frame_id: the ``frame_id`` of the result.
    """
    d, k, r, p = (
        np.asarray(getattr(info, name if hasattr(info, name) else name.upper()), float)
        for name in "dkrp"
    )
    roi = info.roi
    return CameraInfo(
        header=Header(stamp=stamp, frame_id=frame_id),
        height=info.height,
        width=info.width,
        distortion_model=info.distortion_model,
        d=d,
        k=k,
        r=r,
        p=p,
        binning_x=info.binning_x,
        binning_y=info.binning_y,
        roi=RegionOfInterest(
            x_offset=roi.x_offset,
            y_offset=roi.y_offset,
            height=roi.height,
            width=roi.width,
            do_rectify=roi.do_rectify,
        ),
    )

"""The images and camera info of one camera in a ROS 1 or ROS 2 bag.

Read from ``.bag`` files, rosbag2 folders, and single ``.mcap`` and ``.db3`` files, by rosbags. The
bag is read while it is replayed: one image at a time is in memory.
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
COMPRESSED = "sensor_msgs/msg/CompressedImage"
INFO = "sensor_msgs/msg/CameraInfo"
GREY = ("mono8", "8UC1")
COLOUR = {"rgb8": 3, "bgr8": 3, "8UC3": 3, "rgba8": 4, "bgra8": 4}
"""Encoding -> bytes a pixel; ``8UC3`` is blue first, as OpenCV writes it."""
RED_FIRST = ("rgb8", "rgba8")


@dataclass(frozen=True, eq=False)
class DecodedImage:
    """A decoded image."""

    pixels: npt.NDArray[np.uint8]
    """(h, w, 3), red first; or (h, w) grey; row 0 is the top."""
    is_blue_first: bool
    """Whether blue came first in the recording."""
    frame_id: str
    """Frame of its header."""


@dataclass(frozen=True, eq=False)
class RecordedFrame:
    """An image in a recording, not decoded yet."""

    time: int
    """When it was recorded, from the first image on [ns]."""
    info: Any
    """The newest CameraInfo recorded by then; the first, while there is none."""
    place: str
    """What messages call it."""
    read: Callable[[], Any]
    """Return the Image or CompressedImage, as rosbags gives it."""

    def decode(self) -> DecodedImage:
        """Decode it.

        Raises:
            AssetError: it is none of the encodings read, or its size does not fit them.
        """
        message = self.read()
        is_packed = message.__msgtype__ == COMPRESSED
        pixels, is_blue_first = (
            self._unpacked(message) if is_packed else self._uncompressed(message)
        )
        return DecodedImage(pixels, is_blue_first, str(message.header.frame_id))

    def _uncompressed(self, message: Any) -> tuple[npt.NDArray[np.uint8], bool]:
        encoding = str(message.encoding)
        if encoding not in (*GREY, *COLOUR):
            raise AssetError(
                f"{self.place} is encoded as {encoding[:40]!r}; expected one of "
                f"{', '.join((*GREY, *COLOUR))}."
            )
        depth = COLOUR.get(encoding, 1)
        height, width, step = message.height, message.width, message.step
        if height < 1 or width < 1 or step < width * depth or len(message.data) < height * step:
            raise AssetError(
                f"{self.place} says {width}x{height} pixels of {depth} bytes in rows of {step}, "
                f"and holds {len(message.data)} bytes."
            )
        rows = np.frombuffer(message.data, dtype=np.uint8)[: height * step].reshape(height, step)
        if encoding in GREY:
            return rows[:, :width], False
        pixels = rows[:, : width * depth].reshape(height, width, depth)[..., :3]
        return (pixels, False) if encoding in RED_FIRST else (pixels[..., ::-1], True)

    def _unpacked(self, message: Any) -> tuple[npt.NDArray[np.uint8], bool]:
        import cv2

        data = np.frombuffer(message.data, dtype=np.uint8)
        found = cv2.imdecode(data, cv2.IMREAD_UNCHANGED) if len(data) else None
        if found is None or found.dtype != np.uint8:
            raise AssetError(
                f"{self.place} is compressed as {str(message.format)[:40]!r}, which is no image "
                "of 8 bits that OpenCV reads."
            )
        pixels = np.asarray(found, dtype=np.uint8)
        return (pixels, False) if pixels.ndim == 2 else (pixels[..., 2::-1], True)


class Recording:
    """A camera in a bag.

    Args:
        path: a ``.bag``, ``.mcap`` or ``.db3`` file, or a rosbag2 folder.
        image_topic: Image or CompressedImage.
        info_topic: CameraInfo.

    Raises:
        AssetError: it cannot be read, a topic has another type, or there is nothing to replay.
        UnknownName: a topic is not in it.
    """

    def __init__(self, path: Path, image_topic: str, info_topic: str) -> None:
        from rosbags.highlevel import AnyReader
        from rosbags.typesys import Stores, get_typestore

        self._name = path.name
        self._image_topic = image_topic
        if path.is_dir():
            _check_folder(path)
        try:
            self._reader = AnyReader([path], default_typestore=get_typestore(Stores.ROS2_JAZZY))
            self._reader.open()
        except Exception as error:  # a damaged bag fails as it likes
            raise self._unreadable(error) from error
        try:
            self._start = 0  # when the first image was recorded [ns]
            self._images = self._connections(image_topic, (IMAGE, COMPRESSED))
            self._infos = self._connections(info_topic, (INFO,))
            self._first_info = self._read_first_info(info_topic)
            frames = self.frames()
            first = next(frames, None)
            gap = next((frame.time for frame in frames if frame.time > 0), None)
            if first is None or gap is None:
                raise AssetError(
                    f"Topic {image_topic!r} of {self._name} has no two images at different "
                    "times: there is no spacing to replay.",
                    name=image_topic,
                )
            first.decode()
        except BaseException:
            self.close()
            raise
        self.first = first
        """The first image."""
        self.gap = gap
        """Time from the first image to the next [ns]."""
        self.length = max(self._reader.end_time - self._start, gap)
        """Time from the first image to the last message of any topic [ns]."""

    def frames(self) -> Iterator[RecordedFrame]:
        """Go through the images once, in the order recorded."""
        start: int | None = None
        info, count = self._first_info, 0
        for connection, time, data in self._messages([*self._images, *self._infos]):
            if connection.msgtype == INFO:
                info = self._decoded(data, INFO)
                continue
            count += 1
            if start is None:
                start = self._start = time
            place = f"Image {count} of {self._image_topic!r} in {self._name}"
            yield RecordedFrame(
                time - start, info, place, partial(self._decoded, data, connection.msgtype)
            )

    def close(self) -> None:
        """Close the files."""
        self._reader.close()

    def _connections(self, topic: str, types: tuple[str, ...]) -> list[Connection]:
        wanted = topic.strip("/")
        found = [c for c in self._reader.connections if c.topic.strip("/") == wanted]
        if not found:
            raise UnknownName(
                f"topic in {self._name}", topic, {c.topic for c in self._reader.connections}
            )
        for connection in found:
            if connection.msgtype not in types:
                raise AssetError(
                    f"Topic {topic!r} of {self._name} carries {connection.msgtype}; expected "
                    f"{' or '.join(types)}.",
                    name=topic,
                )
        return found

    def _read_first_info(self, topic: str) -> Any:
        for connection, _, data in self._messages(self._infos):
            return self._decoded(data, connection.msgtype)
        raise AssetError(f"Topic {topic!r} of {self._name} has no messages.", name=topic)

    def _messages(self, connections: list[Connection]) -> Iterator[tuple[Connection, int, bytes]]:
        messages = self._reader.messages(connections)
        while True:
            try:
                found = next(messages, None)
            except Exception as error:  # a damaged bag fails as it likes
                raise self._unreadable(error) from error
            if found is None:
                return
            yield found

    def _decoded(self, data: bytes, msgtype: str) -> Any:
        try:
            return self._reader.deserialize(data, msgtype)
        except Exception as error:  # a damaged bag fails as it likes
            raise self._unreadable(error) from error

    def _unreadable(self, error: Exception) -> AssetError:
        message = " ".join(str(error).split())[:200] or type(error).__name__
        return AssetError(f"{self._name} cannot be read as a recording: {message}")


def _check_folder(bag: Path) -> None:
    """See to it that a rosbag2 folder holds files of its own alone.

    Raises:
        AssetError: a link leads out of it, or something in it is no regular file.
    """
    for file in sorted(bag.iterdir()):
        if not is_inside(file, [bag]):
            raise AssetError(f"{bag.name}/{file.name} leads out of the recording's folder.")
        if not file.is_file() and not file.is_dir():
            raise AssetError(f"{bag.name}/{file.name} is not a regular file.")


def camera_info(recorded: Any, *, stamp: Time, frame_id: str) -> CameraInfo:
    """Return a recorded CameraInfo as of ``stamp``; ROS 1 calls d, k, r, p by capitals."""
    d, k, r, p = (
        np.asarray(getattr(recorded, name if hasattr(recorded, name) else name.upper()), float)
        for name in "dkrp"
    )
    roi = recorded.roi
    return CameraInfo(
        header=Header(stamp=stamp, frame_id=frame_id),
        height=recorded.height,
        width=recorded.width,
        distortion_model=recorded.distortion_model,
        d=d,
        k=k,
        r=r,
        p=p,
        binning_x=recorded.binning_x,
        binning_y=recorded.binning_y,
        roi=RegionOfInterest(
            x_offset=roi.x_offset,
            y_offset=roi.y_offset,
            height=roi.height,
            width=roi.width,
            do_rectify=roi.do_rectify,
        ),
    )

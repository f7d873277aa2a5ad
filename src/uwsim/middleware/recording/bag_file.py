"""A bag of ROS 1, with the definition of each type inside; read by rosbag, rqt_bag, rosbags.

Its chunks are not compressed. It is written next to its place and put there by `BagFile.close`.
"""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import Any

from rosbags.rosbag1 import Writer

from ...base.interrupts import block_interrupts
from ..bridge import LATCHED
from ..encodings import to_ros1
from ..types import WireType, ros1_store

SUFFIX = ".bag"


class BagFile:
    """Writes messages into one bag of ROS 1.

    Args:
        path: the file; it is there after `close`.

    Raises:
        OSError: its folder cannot be written.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        path.parent.mkdir(parents=True, exist_ok=True)
        self._partial = path.with_name(f".{path.name}.partial")
        self._partial.unlink(missing_ok=True)
        self._writer = Writer(self._partial)
        self._writer.open()
        self._connections: dict[str, Any] = {}
        self._n_written: dict[str, int] = {}

    @staticmethod
    def has(kind: WireType) -> bool:
        """Whether ROS 1 has such a type."""
        return bool(kind.md5)

    def write(self, topic: str, kind: WireType, time: int, message: object) -> None:
        """Append a message.

        Args:
            topic: its topic.
            kind: its type.
            time: when it was delivered, since the simulation began [ns].
            message: of that type.
        """
        seq = self._n_written.get(topic, 0)
        data = bytes(to_ros1(message, seq=seq))
        with block_interrupts():
            if topic not in self._connections:
                self._connections[topic] = self._writer.add_connection(
                    topic,
                    kind.ros2_name,
                    typestore=ros1_store(),
                    latching=1 if topic.lstrip("/") in LATCHED else None,
                )
            self._writer.write(self._connections[topic], time, data)
            self._n_written[topic] = seq + 1

    def discard(self) -> None:
        """Leave nothing, where the file cannot be finished."""
        self._partial.unlink(missing_ok=True)
        with suppress(Exception):
            self._writer.close()

    def close(self) -> None:
        """Write the index and put the file in its place."""
        with block_interrupts():
            self._writer.close()
            self._partial.replace(self._path)

"""Writer of ROS 1 bags, for rosbag, rqt_bag and rosbags.

A bag contains the definition of each message type. Its chunks are not compressed. It has a
temporary name until `BagFile.close`.
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
from .reserved_file import ReservedFile, SpaceEstimate

SUFFIX = ".bag"
"""The suffix of the files."""


class BagFile:
    """A bag of ROS 1 that is written message by message.

    Args:
        path: the path of the file, which exists after `close`.

    Raises:
        OSError: the folder of the file cannot be written.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        path.parent.mkdir(parents=True, exist_ok=True)
        self._partial_path = path.with_name(f".{path.name}.partial")
        self._partial_path.unlink(missing_ok=True)
        self._writer = Writer(self._partial_path)
        self._connections: dict[str, Any] = {}
        self._n_written: dict[str, int] = {}
        try:
            self._writer.open()
            writer: Any = self._writer
            writer.bio = ReservedFile(writer.bio, path)
            self._space = SpaceEstimate(writer.bio)
        except OSError:
            self.discard()
            raise

    @staticmethod
    def has_type(kind: WireType) -> bool:
        """Return whether ROS 1 has a message type."""
        return bool(kind.md5)

    def write(self, topic: str, kind: WireType, time: int, message: object) -> None:
        """Append a message.

        Args:
            topic: the topic of the message.
            kind: the type of the message.
            time: the simulation time at which the message is delivered [ns].
            message: the message.

        Raises:
            NoSpaceError: the disk is full; the message is left out, and `close` will succeed.
        """
        seq = self._n_written.get(topic, 0)
        data = bytes(to_ros1(message, seq=seq))
        with block_interrupts():
            self._space.reserve_message(len(data))
            if topic not in self._connections:
                self._connections[topic] = self._writer.add_connection(
                    topic,
                    kind.ros2_name,
                    typestore=ros1_store(),
                    latching=1 if topic.lstrip("/") in LATCHED else None,
                )
                self._space.add_channel(self._connections[topic].msgdef.data)
            self._writer.write(self._connections[topic], time, data)
            self._n_written[topic] = seq + 1

    def discard(self) -> None:
        """Delete the file, which cannot be finished."""
        self._partial_path.unlink(missing_ok=True)
        with suppress(Exception):
            self._writer.close()

    def close(self) -> None:
        """Write the index and move the file to its path."""
        with block_interrupts():
            self._writer.close()
            self._partial_path.replace(self._path)

"""An MCAP file of ROS 2 messages: CDR, with the definition of each type inside.

It is written by rosbags, which writes a folder (a rosbag2); its one file is what is kept. The
folder lies next to the file until `McapFile.close`, so that a run that is killed loses no disk.
The channel of a topic has the quality of service that the simulator offers over ROS 2, where
``ros2 bag play`` looks for it: latched topics are replayed latched.
"""

from __future__ import annotations

import shutil
from contextlib import suppress
from pathlib import Path
from typing import Any

from rosbags.interfaces import (
    Qos,
    QosDurability,
    QosHistory,
    QosLiveliness,
    QosReliability,
    QosTime,
)
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer

from ...base.interrupts import block_interrupts
from ..bridge import DEPTH, LATCHED, LATCHED_DEPTH
from ..encodings import to_cdr
from ..types import WireType, ros2_store

SUFFIX = ".mcap"
BAG = "recording"
"""Name of the rosbag2 inside; the same for every file, so that equal runs give equal bytes."""
FOREVER = QosTime(9223372036, 854775807)
"""What ROS 2 writes for an infinite time."""


def quality_of(topic: str) -> Qos:
    """Return the quality of service with which the simulator publishes a topic over ROS 2."""
    is_latched = topic.lstrip("/") in LATCHED
    return Qos(
        history=QosHistory.KEEP_LAST,
        depth=LATCHED_DEPTH if is_latched else DEPTH,
        reliability=QosReliability.RELIABLE,
        durability=QosDurability.TRANSIENT_LOCAL if is_latched else QosDurability.VOLATILE,
        deadline=FOREVER,
        lifespan=FOREVER,
        liveliness=QosLiveliness.AUTOMATIC,
        liveliness_lease_duration=FOREVER,
        avoid_ros_namespace_conventions=False,
    )


class McapFile:
    """Writes messages into one MCAP file, compressed by zstd.

    Args:
        path: the file; it is there after `close`.

    Raises:
        OSError: its folder cannot be written.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        path.parent.mkdir(parents=True, exist_ok=True)
        self._folder = path.with_name(f".{path.name}.partial")
        shutil.rmtree(self._folder, ignore_errors=True)  # of a run that was killed
        self._folder.mkdir()
        self._writer = Writer(
            self._folder / BAG, version=Writer.VERSION_LATEST, storage_plugin=StoragePlugin.MCAP
        )
        self._writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
        self._writer.open()
        self._channels: dict[str, Any] = {}

    @staticmethod
    def has(kind: WireType) -> bool:
        """Whether ROS 2 has such a type."""
        return bool(kind.type_hash)

    def write(self, topic: str, kind: WireType, time: int, message: object) -> None:
        """Append a message.

        Args:
            topic: its topic.
            kind: its type.
            time: when it was delivered, since the simulation began [ns].
            message: of that type.
        """
        data = to_cdr(message)
        with block_interrupts():
            if topic not in self._channels:
                self._channels[topic] = self._writer.add_connection(
                    topic,
                    kind.ros2_name,
                    typestore=ros2_store(),
                    offered_qos_profiles=[quality_of(topic)],
                )
            self._writer.write(self._channels[topic], time, data)

    def discard(self) -> None:
        """Leave nothing, where the file cannot be finished."""
        shutil.rmtree(self._folder, ignore_errors=True)
        with suppress(Exception):
            self._writer.close()
        shutil.rmtree(self._folder, ignore_errors=True)

    def close(self) -> None:
        """Write the index and put the file in its place."""
        with block_interrupts():
            self._writer.close()
            (self._folder / BAG / f"{BAG}{SUFFIX}").replace(self._path)
            shutil.rmtree(self._folder, ignore_errors=True)

"""Writer of MCAP files with messages of ROS 2, encoded as CDR.

A file contains the definition of each message type. rosbags writes a folder (a rosbag2), of which
one file is kept. The folder is next to the file until `McapFile.close`; if a run is killed, the
next run deletes its folder. The channel of a topic has the quality of service that the simulator
offers over ROS 2, which ``ros2 bag play`` applies: latched topics are replayed latched.
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
from .reserved_file import ReservedFile, SpaceEstimate

SUFFIX = ".mcap"
"""The suffix of the files."""
BAG = "recording"
"""The name of the rosbag2 in the folder, a constant, so that equal runs give equal bytes."""
INFINITE_TIME = QosTime(9223372036, 854775807)
"""The infinite time, as ROS 2 writes it."""


def quality_of(topic: str) -> Qos:
    """Return the quality of service with which the simulator publishes a topic over ROS 2."""
    is_latched = topic.lstrip("/") in LATCHED
    return Qos(
        history=QosHistory.KEEP_LAST,
        depth=LATCHED_DEPTH if is_latched else DEPTH,
        reliability=QosReliability.RELIABLE,
        durability=QosDurability.TRANSIENT_LOCAL if is_latched else QosDurability.VOLATILE,
        deadline=INFINITE_TIME,
        lifespan=INFINITE_TIME,
        liveliness=QosLiveliness.AUTOMATIC,
        liveliness_lease_duration=INFINITE_TIME,
        avoid_ros_namespace_conventions=False,
    )


class McapFile:
    """An MCAP file, compressed by zstd, that is written message by message.

    Args:
        path: the path of the file, which exists after `close`.

    Raises:
        OSError: the folder of the file cannot be written.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        path.parent.mkdir(parents=True, exist_ok=True)
        self._folder = path.with_name(f".{path.name}.partial")
        shutil.rmtree(self._folder, ignore_errors=True)  # a killed run may have left it
        self._folder.mkdir()
        self._writer = Writer(
            self._folder / BAG, version=Writer.VERSION_LATEST, storage_plugin=StoragePlugin.MCAP
        )
        self._writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
        self._channels: dict[str, Any] = {}
        try:
            self._writer.open()
            storage: Any = self._writer.storage
            storage.bio = ReservedFile(storage.bio, path)
            self._space = SpaceEstimate(storage.bio)
        except OSError:
            self.discard()
            raise

    @staticmethod
    def has_type(kind: WireType) -> bool:
        """Return whether ROS 2 has a message type."""
        return bool(kind.type_hash)

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
        data = to_cdr(message)
        with block_interrupts():
            self._space.reserve_message(len(data))
            if topic not in self._channels:
                self._channels[topic] = self._writer.add_connection(
                    topic,
                    kind.ros2_name,
                    typestore=ros2_store(),
                    offered_qos_profiles=[quality_of(topic)],
                )
                self._space.add_channel(self._channels[topic].msgdef.data)
            self._writer.write(self._channels[topic], time, data)

    def discard(self) -> None:
        """Delete the file, which cannot be finished."""
        shutil.rmtree(self._folder, ignore_errors=True)
        with suppress(Exception):
            self._writer.close()
        shutil.rmtree(self._folder, ignore_errors=True)

    def close(self) -> None:
        """Write the index and move the file to its path."""
        with block_interrupts():
            try:
                self._writer.close()
            except OSError:
                if self._writer.storage is not None:
                    raise
                # the file is complete; its folder's metadata.yaml, which is not kept, did not fit
            (self._folder / BAG / f"{BAG}{SUFFIX}").replace(self._path)
            shutil.rmtree(self._folder, ignore_errors=True)

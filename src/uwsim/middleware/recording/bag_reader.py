"""Reader of recordings: bags of ROS 1, rosbag2 folders, single ``.mcap`` and ``.db3`` files.

Messages are converted to the classes of the bus, for every version of ROS. Times are simulation
times; in a recording with times of the wall clock, times and stamps count from the first message.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

from ...errors import AssetError, BadMessage, UnknownName
from ...messages.build import NANOSECONDS
from ..encodings import convert_to_class
from ..stamps import shift_stamps
from ..types import message_class

WALL_TIME = 10**8 * NANOSECONDS
"""The time above which a stamp is a time of the wall clock [ns]; no simulation is as long."""


MAGIC = {".bag": b"#ROSBAG V2.0", ".mcap": b"\x89MCAP0", ".db3": b"SQLite format 3"}
"""The first bytes of recordings, by suffix."""


class BagReader:
    """A recording that is read once, message by message.

    Args:
        path: the file or folder of the recording.

    Raises:
        AssetError: the recording cannot be read, or has no message.
    """

    def __init__(self, path: Path) -> None:
        self._path, self._name = path, path.name
        if not path.exists():
            raise AssetError(f"{path} does not exist; expected a .bag, .mcap or .db3 file.")
        try:
            self._reader = AnyReader([path], default_typestore=get_typestore(Stores.ROS2_JAZZY))
            self._reader.open()
        except Exception as error:  # a damaged bag may raise anything
            raise self._read_error(error) from error
        self.topics: dict[str, type] = {}
        """The class of the messages of each topic, by topic with a leading slash."""
        self.left_out: dict[str, str] = {}
        """The name of the type of each topic whose type is not known."""
        for connection in self._reader.connections:
            topic = f"/{connection.topic.strip('/')}"
            try:
                self.topics[topic] = message_class(connection.msgtype)
            except UnknownName:
                self.left_out[topic] = connection.msgtype
        if self._reader.message_count == 0:
            self.close()
            raise AssetError(f"{self._name} has no message.")
        start_time = self._reader.start_time
        self._origin = start_time if start_time > WALL_TIME else 0
        last_time = self._reader.end_time - 1  # end_time is 1 ns after the last message
        self.duration = (last_time - self._origin) / NANOSECONDS
        """The time of the last message [s]."""
        self.start = self._origin / NANOSECONDS
        """The time 0 of a recording with times of the wall clock, since 1970; else 0 [s]."""

    def messages(self, topics: Collection[str] | None = None) -> Iterator[tuple[float, str, Any]]:
        """Yield the time [s], topic and content of all messages, in the order of their times.

        Messages with equal times are in the order in which they were recorded; in a bag of ROS 1,
        they are topic by topic.

        Args:
            topics: the topics to read, with a leading slash; None: all.
        """
        names = self.topics if topics is None else topics
        connections = [c for c in self._reader.connections if f"/{c.topic.strip('/')}" in names]
        if not connections:
            return  # rosbags would read all
        records = self._reader.messages(connections)
        while True:
            try:
                record = next(records, None)
                if record is None:
                    return
                connection, time, data = record
                message = self._reader.deserialize(data, connection.msgtype)
            except Exception as error:  # a damaged bag may raise anything
                raise self._read_error(error) from error
            topic = f"/{connection.topic.strip('/')}"
            try:
                content: object = convert_to_class(self.topics[topic], message)
            except BadMessage as error:
                raise AssetError(f"{self._name}: {topic}: {error}") from None
            yield ((time - self._origin) / NANOSECONDS, topic, shift_stamps(content, -self._origin))

    def close(self) -> None:
        """Close the files."""
        with suppress(Exception):  # a damaged file may raise anything
            self._reader.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()

    def _read_error(self, error: Exception) -> AssetError:
        message = " ".join(str(error).split())[:200] or type(error).__name__
        suffix = find_suffix(self._path)
        if self._path.suffix in MAGIC and suffix != self._path.suffix:
            name = self._path.suffix
            message = f"it is not a {name} file" if suffix is None else f"it is a {suffix} file"
        return AssetError(f"{self._name} cannot be read as a recording: {message}")


def find_suffix(path: Path) -> str | None:
    """Return the suffix that fits the first bytes of a file; None if it is not a recording."""
    try:
        with path.open("rb") as stream:
            head = stream.read(16)
    except OSError:
        return None
    return next((suffix for suffix, magic in MAGIC.items() if head.startswith(magic)), None)

"""Reads recordings: bags of ROS 1, rosbag2 folders, single ``.mcap`` and ``.db3`` files.

Messages are those of the bus, whatever version of ROS wrote them. Times are simulation times; those
of a recording by the wall clock count from its first message, stamps of headers too.
"""

from __future__ import annotations

from collections.abc import Iterator
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
"""Later than this is a time of the wall clock [ns]; no simulation is as long."""


MAGIC = {".bag": b"#ROSBAG V2.0", ".mcap": b"\x89MCAP0", ".db3": b"SQLite format 3"}
"""First bytes of recordings, by suffix."""


class BagReader:
    """A recording that is read once, message by message.

    Args:
        path: the recording.

    Raises:
        AssetError: it cannot be read, or holds no message.
    """

    def __init__(self, path: Path) -> None:
        self._path, self._name = path, path.name
        if not path.exists():
            raise AssetError(f"{path} is not there; expected a .bag, .mcap or .db3 file.")
        try:
            self._reader = AnyReader([path], default_typestore=get_typestore(Stores.ROS2_JAZZY))
            self._reader.open()
        except Exception as error:  # a damaged bag fails as it likes
            raise self._unreadable(error) from error
        self.topics: dict[str, type] = {}
        """Topic, with a leading slash -> class of its messages."""
        self.left_out: dict[str, str] = {}
        """Topic -> name of its type, of topics whose type is not known."""
        for connection in self._reader.connections:
            topic = f"/{connection.topic.strip('/')}"
            try:
                self.topics[topic] = message_class(connection.msgtype)
            except UnknownName:
                self.left_out[topic] = connection.msgtype
        if self._reader.message_count == 0:
            self.close()
            raise AssetError(f"{self._name} holds no message.")
        first = self._reader.start_time
        self._origin = first if first > WALL_TIME else 0
        self.duration = (self._reader.end_time - 1 - self._origin) / NANOSECONDS  # it is the end
        """Time of the last message [s]."""

    def messages(self) -> Iterator[tuple[float, str, Any]]:
        """Go through the messages by time: time [s], topic, message.

        Those of one time come in the order recorded, but of a bag of ROS 1 topic by topic.
        """
        known = [c for c in self._reader.connections if f"/{c.topic.strip('/')}" in self.topics]
        found = self._reader.messages(known)
        while True:
            try:
                one = next(found, None)
                if one is None:
                    return
                connection, time, data = one
                message = self._reader.deserialize(data, connection.msgtype)
            except Exception as error:  # a damaged bag fails as it likes
                raise self._unreadable(error) from error
            topic = f"/{connection.topic.strip('/')}"
            try:
                ours: object = convert_to_class(self.topics[topic], message)
            except BadMessage as error:
                raise AssetError(f"{self._name}: {topic}: {error}") from None
            yield (time - self._origin) / NANOSECONDS, topic, shift_stamps(ours, -self._origin)

    def close(self) -> None:
        """Close the files."""
        with suppress(Exception):  # of a damaged one
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

    def _unreadable(self, error: Exception) -> AssetError:
        message = " ".join(str(error).split())[:200] or type(error).__name__
        found = kind_of(self._path)
        if self._path.suffix in MAGIC and found != self._path.suffix:
            named = self._path.suffix
            message = f"it is no {named} file" if found is None else f"it is a {found} file"
        return AssetError(f"{self._name} cannot be read as a recording: {message}")


def kind_of(path: Path) -> str | None:
    """Return the suffix that a recording with these first bytes has; None if it is none."""
    try:
        with path.open("rb") as stream:
            begin = stream.read(16)
    except OSError:
        return None
    return next((suffix for suffix, magic in MAGIC.items() if begin.startswith(magic)), None)

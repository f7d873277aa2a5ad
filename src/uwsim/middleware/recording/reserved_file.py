"""A file whose space is reserved before anything depends on it.

A recording on a full disk should keep what is complete. An index at the end of the file needs space
that is gone by then. So the space of a message, and of the index, is allocated before the message
is accepted (``posix_fallocate``). Whatever was accepted fits. The file is cut to its content when
it is closed, so its bytes are the same. Systems without the call reserve nothing.
"""

from __future__ import annotations

import os
from typing import BinaryIO

STEP = 1 << 20
"""The number of bytes that are allocated at once; fewer, if the disk has no more [bytes]."""


class NoSpaceError(OSError):
    """An error of a message that was not accepted, as its space cannot be reserved."""


class ReservedFile:
    """A binary file that is written, with reserved space behind its end.

    Args:
        file: the file, of which this object becomes the owner.
        path: the path that the user knows, for messages.
    """

    def __init__(self, file: BinaryIO, path: os.PathLike[str]) -> None:
        self._file, self._path = file, path
        self.size = file.tell()
        """The size of the content [bytes]."""
        self._n_reserved = self.size

    def reserve(self, n_bytes: int) -> None:
        """Reserve space behind the content [bytes]; raise NoSpaceError if the disk has none."""
        new_size = self.size + n_bytes
        if new_size <= self._n_reserved or not hasattr(os, "posix_fallocate"):
            return
        try:
            try:
                self._allocate(new_size + STEP)
            except OSError:
                self._allocate(new_size)
        except OSError as error:
            raise NoSpaceError(error.errno, error.strerror, os.fspath(self._path)) from None

    def _allocate(self, size: int) -> None:
        os.posix_fallocate(self._file.fileno(), 0, size)
        self._n_reserved = size

    def write(self, data: bytes | bytearray | memoryview) -> int:
        """Write bytes, and return their number."""
        n_bytes = self._file.write(data)
        self.size = max(self.size, self._file.tell())
        return n_bytes

    def tell(self) -> int:
        """Return the position [bytes]."""
        return self._file.tell()

    def seek(self, position: int) -> int:
        """Move to a position [bytes], and return it."""
        return self._file.seek(position)

    def close(self) -> None:
        """Cut the file to its content, and close it."""
        if not self._file.closed:
            try:
                self._file.flush()
                self._file.truncate(self.size)
            finally:
                self._file.close()


class SpaceEstimate:
    """An upper bound of the bytes that a recording still has to write.

    Args:
        file: the file of the recording.
    """

    MARGIN = 1 << 16
    """The number of bytes for headers, and for the first message of a topic [bytes]."""
    MESSAGE = 96
    """The number of bytes of a message besides its content: its header, and its index [bytes]."""
    CHANNEL = 4096
    """The number of bytes of a topic besides its definition, which is stored twice [bytes]."""
    CHUNK = 256
    """The number of bytes in the index of a chunk besides its topics [bytes]."""
    CHUNK_CHANNEL = 32
    """The number of bytes of a topic in the index of a chunk [bytes]."""

    def __init__(self, file: ReservedFile) -> None:
        self._file = file
        self._n_channels = self._n_chunks = self._n_pending = self._n_definitions = 0
        self._size = file.size
        file.reserve(self.MARGIN)

    def add_channel(self, definition: str) -> None:
        """Count a topic with the definition of its type."""
        self._n_channels += 1
        self._n_definitions += self.CHANNEL + 2 * len(definition.encode())

    def reserve_message(self, n_bytes: int) -> None:
        """Reserve the space of a message with a content of ``n_bytes``; raise NoSpaceError."""
        if self._file.size != self._size:  # the last chunk is in the file
            self._size, self._n_pending = self._file.size, 0
            self._n_chunks += 1
        n_pending = self._n_pending + self.MESSAGE + n_bytes
        n_index = (self._n_chunks + 1) * (self.CHUNK + self.CHUNK_CHANNEL * self._n_channels)
        # data that cannot be compressed grows by less than a part in 128
        total = self.MARGIN + self._n_definitions + n_index + n_pending + n_pending // 128
        self._file.reserve(total)
        self._n_pending = n_pending

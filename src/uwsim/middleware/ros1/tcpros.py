"""Frames and connection headers of TCPROS.

A frame is its length as a little-endian uint32, then as many bytes. The first frame of each side
is the connection header: fields ``name=value``, each with its own length in front. A header with a
field ``error`` is a refusal.
"""

from __future__ import annotations

import select
import socket
import struct
import time
from collections.abc import Mapping
from contextlib import suppress

from ...errors import UwsimError
from .deadline import time_left

MAX_HEADER = 256 * 1024
"""The maximum length of a connection header [bytes]; for a point cloud it has 4 kB."""
MAX_MESSAGE = 64 * 2**20
"""The maximum length of a message [bytes]."""
CHUNK = 256 * 1024
"""The maximum number of bytes that are read at once."""
LENGTH = struct.Struct("<I")
"""The encoding of a length."""


class PeerError(UwsimError):
    """An error that a peer causes; its text is one line."""


def encode_header(fields: Mapping[str, str]) -> bytes:
    """Return a connection header as a frame."""
    pairs = [f"{name}={value}".encode() for name, value in fields.items()]
    body = b"".join(LENGTH.pack(len(pair)) + pair for pair in pairs)
    return LENGTH.pack(len(body)) + body


def decode_header(body: bytes) -> dict[str, str]:
    """Decode a connection header without its length; raise PeerError if it is invalid."""
    fields: dict[str, str] = {}
    offset = 0
    while offset < len(body):
        if offset + LENGTH.size > len(body):
            raise PeerError("its connection header is cut off")
        (length,) = LENGTH.unpack_from(body, offset)
        offset += LENGTH.size
        pair = body[offset : offset + length]
        if len(pair) < length or b"=" not in pair:
            raise PeerError("its connection header has an invalid field")
        name, _, value = pair.partition(b"=")
        fields[name.decode("utf-8", "replace")] = value.decode("utf-8", "replace")
        offset += length
    return fields


def node_of(header: Mapping[str, str]) -> str:
    """Return the name of the node at the other end of a connection, from its header."""
    return f"node {header.get('callerid', 'without a name')[:100]}"


def read_header(connection: socket.socket, limit_s: float | None = None) -> dict[str, str]:
    """Read a connection header, within ``limit_s`` if given.

    Raises:
        PeerError: there is no header, it is invalid, or it has a field ``error``.
    """
    end = None if limit_s is None else time.monotonic() + limit_s
    body = read_frame(connection, MAX_HEADER, end)
    if body is None:
        raise PeerError("it closed the connection without a header")
    fields = decode_header(body)
    if "error" in fields:
        raise PeerError(f"it refused the connection: {fields['error'][:300]}")
    return fields


def read_frame(
    connection: socket.socket, limit: int = MAX_MESSAGE, end: float | None = None
) -> bytes | None:
    """Read one frame without its length; return None if the peer has closed the connection.

    Args:
        connection: the connection to read from.
        limit: the maximum length of the frame [bytes].
        end: the deadline of the whole frame, on the monotonic clock [s]; None: the socket's timeout
            applies to each part.

    Raises:
        PeerError: the frame is cut off, too long, or does not come within the socket's timeout.
    """
    head = _read(connection, LENGTH.size, end)
    if not head:
        return None
    if len(head) < LENGTH.size:
        raise PeerError("it closed the connection in the middle of a length")
    (length,) = LENGTH.unpack(head)
    if length > limit:
        raise PeerError(f"it announces {length} bytes; at most {limit} are read")
    body = _read(connection, length, end)
    if len(body) < length:
        raise PeerError(f"it closed the connection after {len(body)} of {length} bytes")
    return body


def _read(connection: socket.socket, n: int, end: float | None) -> bytes:
    """Read ``n`` bytes, or fewer if the connection ends; memory grows with the bytes received."""
    data = bytearray()
    while len(data) < n:
        try:
            if end is not None:
                connection.settimeout(time_left(end))
            part = connection.recv(min(CHUNK, n - len(data)))
        except TimeoutError:
            raise PeerError("it sends nothing") from None
        except OSError as error:
            raise PeerError(f"the connection broke: {error.strerror or error}") from error
        if not part:
            break
        data += part
    return bytes(data)


def write(connection: socket.socket, data: bytes | memoryview) -> None:
    """Send bytes; raise PeerError if the peer does not read them within the socket's timeout."""
    try:
        connection.sendall(data)
    except TimeoutError:
        raise PeerError("it does not read its messages") from None
    except OSError as error:
        raise PeerError(f"the connection broke: {error.strerror or error}") from error


def add_length(data: bytes | memoryview) -> bytes:
    """Return bytes with their length in front."""
    return b"".join((LENGTH.pack(len(data)), data))


def has_left(connection: socket.socket) -> bool:
    """Return whether the peer has closed a connection on which it sends nothing."""
    try:
        poll = select.poll()  # select.select accepts no file descriptor above 1023
        poll.register(connection, select.POLLIN)
        return bool(poll.poll(0)) and connection.recv(1, socket.MSG_PEEK) == b""
    except (OSError, ValueError):
        return True


def open_connection(host: str, port: int, timeout: float) -> socket.socket:
    """Connect, without delay of small packets; raise PeerError if that fails."""
    try:
        connection = socket.create_connection((host, port), timeout)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    except (OSError, OverflowError, ValueError) as error:
        raise PeerError(f"{host}:{port} cannot be reached: {error}") from error
    return connection


def close(connection: socket.socket) -> None:
    """Close a connection, also while another thread waits for it."""
    with suppress(OSError):
        connection.shutdown(socket.SHUT_RDWR)
    connection.close()

"""Frames and headers of TCPROS."""

from __future__ import annotations

import fcntl
import resource
import socket
from collections.abc import Iterator

import pytest

from uwsim.middleware.ros1.tcpros import (
    MAX_MESSAGE,
    PeerError,
    add_length,
    decode_header,
    encode_header,
    has_left,
    open_connection,
    read_frame,
    read_header,
    write,
)

FIELDS = {"callerid": "/echo", "md5sum": "*", "topic": "/odom", "message_definition": "a=b\n=c"}


@pytest.fixture
def pair() -> Iterator[tuple[socket.socket, socket.socket]]:
    local_end, remote_end = socket.socketpair()
    local_end.settimeout(60.0)
    with local_end, remote_end:
        yield local_end, remote_end


def test_a_header_is_read_as_it_was_written(pair: tuple[socket.socket, socket.socket]) -> None:
    local_end, remote_end = pair
    remote_end.sendall(encode_header(FIELDS))
    assert read_header(local_end) == FIELDS


def test_a_header_of_rospy_is_read() -> None:
    body = b"\x12\x00\x00\x00callerid=/listener" + b"\x0d\x00\x00\x00topic=/a=b/c "
    assert decode_header(body) == {"callerid": "/listener", "topic": "/a=b/c "}


@pytest.mark.parametrize(
    ("data", "error"),
    [
        (b"", "without a header"),
        (b"\x01\x00", "in the middle of a length"),
        (b"\x09\x00\x00\x00abc", "after 3 of 9 bytes"),
        (b"\xff\xff\xff\xff", "announces 4294967295 bytes"),
        (b"GET / HTTP/1.1\r\n\r\n", "announces 542393671 bytes"),
        (add_length(b"\x01\x00"), "cut off"),
        (add_length(b"\x03\x00\x00\x00abc"), "has an invalid field"),
        (add_length(b"\xff\x00\x00\x00a=b"), "has an invalid field"),
        (encode_header({"error": "no such topic"}), "it refused the connection: no such topic"),
    ],
)
def test_garbage_is_one_clean_error(
    pair: tuple[socket.socket, socket.socket], data: bytes, error: str
) -> None:
    local_end, remote_end = pair
    remote_end.sendall(data)
    remote_end.shutdown(socket.SHUT_WR)
    with pytest.raises(PeerError, match=error):
        read_header(local_end)


def test_a_frame_is_read_and_the_end_is_none(pair: tuple[socket.socket, socket.socket]) -> None:
    local_end, remote_end = pair
    remote_end.sendall(add_length(b"abc") + add_length(b""))
    remote_end.shutdown(socket.SHUT_WR)
    assert [read_frame(local_end), read_frame(local_end), read_frame(local_end)] == [
        b"abc",
        b"",
        None,
    ]
    assert has_left(local_end)


def test_a_peer_is_still_there_when_more_than_a_thousand_files_are_open(
    pair: tuple[socket.socket, socket.socket],
) -> None:
    local_end, remote_end = pair
    soft_limit, hard_limit = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (hard_limit, hard_limit))
    try:
        with socket.socket(fileno=fcntl.fcntl(local_end, fcntl.F_DUPFD, 1024)) as high:
            assert not has_left(high)
            remote_end.shutdown(socket.SHUT_WR)
            assert has_left(high)
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, (soft_limit, hard_limit))


def test_a_long_frame_is_refused_before_it_is_read(
    pair: tuple[socket.socket, socket.socket],
) -> None:
    local_end, remote_end = pair
    remote_end.sendall((MAX_MESSAGE + 1).to_bytes(4, "little"))
    with pytest.raises(PeerError, match="at most"):
        read_frame(local_end)


def test_a_peer_that_does_not_read_is_an_error(pair: tuple[socket.socket, socket.socket]) -> None:
    local_end, _ = pair
    local_end.settimeout(0.05)
    with pytest.raises(PeerError, match="does not read"):
        write(local_end, bytes(64 * 2**20))


def test_nobody_there_is_one_clean_error() -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
    with pytest.raises(PeerError, match="cannot be reached"):
        open_connection("127.0.0.1", port, 60.0)

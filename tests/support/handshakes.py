"""Requests for a WebSocket, byte by byte, that no library sends."""

import socket


def request_of(request_lines: str) -> bytes:
    """Return a request that begins with these lines, without the last line end."""
    upgrade = "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
    key = "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
    return f"{request_lines}\r\nHost: 127.0.0.1\r\n{upgrade}{key}\r\n".encode("latin1")


def status_of(port: int, request_lines: str, timeout: float) -> str:
    """Send a request that begins with these lines; return the status of the response.

    Args:
        port: the port on this computer.
        request_lines: the first lines, without the last line end.
        timeout: the timeout of the connection [s].
    """
    with socket.create_connection(("127.0.0.1", port), timeout) as client:
        client.sendall(request_of(request_lines))
        return client.recv(100).decode().split()[1]

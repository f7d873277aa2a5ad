"""Streams of bytes over serial lines, by pyserial, and pseudo-terminals, which need no hardware."""

from __future__ import annotations

import importlib
import os
import select
import sys
from typing import Any

from ...errors import MissingExtra, UwsimError

MAX_RECEIVE = 65536
"""The greatest number of bytes that one call receives [bytes]."""
MAX_SEND_BUFFER = 65536
"""The greatest number of bytes that wait for a slow line [bytes]."""


class SerialStream:
    """A serial line with 8 data bits, no parity and 1 stop bit, without handshake.

    Args:
        path: the path of the device, such as ``/dev/ttyUSB0``.
        bit_rate: the bit rate [bit/s].
    """

    def __init__(self, path: str, bit_rate: int) -> None:
        try:
            serial: Any = importlib.import_module("serial")
        except ImportError:
            raise MissingExtra(
                f"serial:{path} needs pyserial, which is not installed. Install it with: "
                "pip install 'uwsim[serial]'; udpin, udpout, tcp, tcpin and pty do not need it."
            ) from None
        try:
            self._line: Any = serial.Serial(path, bit_rate, timeout=0, write_timeout=0)
        except (OSError, ValueError) as error:
            raise OSError(getattr(error, "errno", None) or 0, str(error)) from None

    @property
    def is_connected(self) -> bool:
        """True if the line is open; it does not show whether a device is at its other end."""
        return True

    def receive(self, timeout: float = 0.0) -> bytes:
        """Return bytes that have arrived; wait for the first one for ``timeout`` [s] at most."""
        try:
            if timeout > 0.0:
                select.select([self._line], [], [], timeout)
            data: bytes = self._line.read(MAX_RECEIVE)
        except (OSError, ValueError):  # the device is gone
            return b""
        return data

    def send(self, data: bytes) -> bool:
        """Send all of ``data`` or nothing; return False if the line is too slow, or is gone."""
        try:
            if not self._line.is_open or self._line.out_waiting + len(data) > MAX_SEND_BUFFER:
                return False
            return bool(self._line.write(data) == len(data))
        except OSError:
            return False

    def close(self) -> None:
        """Close the line."""
        self._line.close()


class PseudoTerminal:
    """A pseudo-terminal, whose other end is a serial line for a program on this computer.

    Args:
        link: the path of a symbolic link to the terminal, which is replaced; empty: no link.
    """

    def __init__(self, link: str = "") -> None:
        if not hasattr(os, "openpty"):
            raise UwsimError("pty: this operating system has no pseudo-terminals.")
        import tty

        self._link = link
        self._own_end, self._other_end = os.openpty()
        tty.setraw(self._other_end)
        os.set_blocking(self._own_end, False)
        self.path = os.ttyname(self._other_end)
        """The path of the terminal, which a program opens as a serial line."""
        self._n_sent = 0
        try:
            if link and os.path.islink(link):
                os.unlink(link)
            if link:
                os.symlink(self.path, link)
        except OSError:
            self._link = ""
            self.close()
            raise

    @property
    def is_connected(self) -> bool:
        """True if the line is open; it does not show whether a device is at its other end."""
        return True

    @property
    def has_reader(self) -> bool:
        """True if a program has read sent bytes, or the system does not show it."""
        try:
            import fcntl
            import termios

            waiting_bytes = fcntl.ioctl(self._other_end, termios.FIONREAD, b"\0" * 4)
        except (ImportError, AttributeError, OSError):
            return True
        return int.from_bytes(waiting_bytes, sys.byteorder) < self._n_sent

    def receive(self, timeout: float = 0.0) -> bytes:
        """Return bytes that have arrived; wait for the first one for ``timeout`` [s] at most."""
        try:
            if timeout > 0.0:
                select.select([self._own_end], [], [], timeout)
            return os.read(self._own_end, MAX_RECEIVE)
        except (OSError, ValueError):
            return b""

    def send(self, data: bytes) -> bool:
        """Send bytes; return False if no program reads them and the terminal's buffer is full."""
        try:
            n_bytes = os.write(self._own_end, data)
        except OSError:
            return False
        self._n_sent += n_bytes
        return n_bytes == len(data)

    def close(self) -> None:
        """Close both ends, and remove the link."""
        os.close(self._own_end)
        os.close(self._other_end)
        if self._link and os.path.islink(self._link):
            os.unlink(self._link)

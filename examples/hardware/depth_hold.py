"""The controller of a vehicle that reads three instruments, with the standard library alone.

It reads $ISDPT sentences of a depth sensor on a serial line, $PRDID sentences of a compass as
datagrams, and PD4 messages of a DVL by TCP. It answers each depth with a command to the thrusters,
which repeats the time of the last ping::

    python depth_hold.py depth-line thruster-line 2.0
"""

import os
import selectors
import socket
import struct
import sys
import time
from contextlib import suppress
from functools import reduce
from operator import xor

COMPASS, DVL = ("127.0.0.1", 9111), ("127.0.0.1", 9112)
GAIN, DAMPING = 0.6, 1.0  # [1/m], [s/m]
PING_SIZE, BAD_VELOCITY = 47, -32768


class Controller:
    """A spring on the depth, and a damper on the vertical speed over the bottom."""

    def __init__(self, target: float) -> None:
        self.target, self.depth, self.heading, self.descent_rate = target, 0.0, 0.0, 0.0
        self.ping_time, self.dvl_bytes, self.depth_bytes = "", b"", b""
        self.n_depths = self.n_headings = self.n_pings = 0

    def read_depths(self, data: bytes) -> bool:
        """Read the bytes of the depth sensor; return True if a sentence is complete."""
        *lines, self.depth_bytes = (self.depth_bytes + data).split(b"\n")
        for line in lines:
            if fields := split_sentence(line, b"ISDPT"):
                self.depth, self.n_depths = float(fields[1]), self.n_depths + 1
        return bool(lines)

    def read_headings(self, datagram: bytes) -> None:
        """Read the sentences of a datagram of the compass."""
        for line in datagram.splitlines():
            if fields := split_sentence(line, b"PRDID"):
                self.heading, self.n_headings = float(fields[3]), self.n_headings + 1

    def read_pings(self, data: bytes) -> None:
        """Read the bytes of the DVL: 47 for each ping, which begin with 7d 00."""
        self.dvl_bytes += data
        while (start := self.dvl_bytes.find(b"\x7d\x00")) >= 0:
            ping = self.dvl_bytes[start : start + PING_SIZE]
            if len(ping) < PING_SIZE:
                return
            is_valid = sum(ping[:-2]) & 0xFFFF == int.from_bytes(ping[-2:], "little")
            self.dvl_bytes = self.dvl_bytes[start + (PING_SIZE if is_valid else 1) :]
            (up,) = struct.unpack_from("<h", ping, 9)  # after starboard and forward [mm/s]
            if is_valid:
                self.n_pings += 1
                hour, minute, second, hundredth = ping[35:39]
                self.ping_time = f"{hour:02}{minute:02}{second:02}.{hundredth:02}"
                self.descent_rate = 0.0 if up == BAD_VELOCITY else -0.001 * up

    def format_commands(self) -> bytes:
        """Return a sentence with the commands of all thrusters, from -1 to 1."""
        command = GAIN * (self.target - self.depth) - DAMPING * self.descent_rate
        values = [0.0] * 4 + [min(max(command, -1.0), 1.0)] * 4
        body = ",".join(["PUWTC", self.ping_time, *(f"{value:.4f}" for value in values)]).encode()
        return b"$%s*%02X\r\n" % (body, reduce(xor, body))

    def describe(self) -> str:
        """Return a line for the user."""
        return (
            f"depth {self.depth:.2f} m, heading {self.heading:.1f} deg; read {self.n_depths} "
            f"depths, {self.n_headings} headings, {self.n_pings} pings"
        )


def split_sentence(line: bytes, address: bytes) -> list[bytes]:
    """Return the fields of a sentence; none if it is damaged or another one."""
    body, _, checksum = line.strip()[1:].partition(b"*")
    with suppress(ValueError):
        if body.startswith(address + b",") and int(checksum, 16) == reduce(xor, body):
            return body.split(b",")
    return []


def main(depth_path: str, thruster_path: str, target: float) -> None:
    """Hold a depth [m] until the lines are closed."""
    controller, report_time = Controller(target), time.monotonic()
    thruster_line = os.open(thruster_path, os.O_WRONLY | os.O_NOCTTY)
    depth_line = os.open(depth_path, os.O_RDONLY | os.O_NOCTTY)
    compass = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    compass.bind(COMPASS)
    with (
        compass,
        socket.create_connection(DVL) as dvl,
        selectors.DefaultSelector() as selector,
        suppress(OSError, KeyboardInterrupt),  # the simulation has ended
    ):
        for source in (depth_line, compass, dvl):
            selector.register(source, selectors.EVENT_READ)
        while True:
            for key, _ in selector.select():
                data = os.read(key.fd, 4096)
                if not data:
                    raise OSError("closed")
                if key.fileobj is compass:
                    controller.read_headings(data)
                elif key.fileobj is dvl:
                    controller.read_pings(data)
                elif controller.read_depths(data):
                    os.write(thruster_line, controller.format_commands())
            if time.monotonic() - report_time > 5.0:
                report_time = time.monotonic()
                print(controller.describe(), flush=True)
    print(controller.describe())


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], float(sys.argv[3]))

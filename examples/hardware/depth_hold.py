"""The controller of a vehicle on two serial lines, with the standard library alone.

It reads $ISDPT sentences of a depth sensor and answers each with a command to the thrusters::

    python depth_hold.py depth-line thruster-line 2.0
"""

import os
import sys
from contextlib import suppress
from functools import reduce
from operator import xor

GAIN, DAMPING = 0.6, 1.0  # [1/m], [s/m]


def read_depth(line: bytes) -> float:
    """Return the depth of a sentence [m]; raise ValueError if it is damaged."""
    body, checksum = line.strip()[1:].split(b"*")
    address, depth, *_ = body.split(b",")
    if address != b"ISDPT" or int(checksum, 16) != reduce(xor, body):
        raise ValueError(line)
    return float(depth)


def format_commands(values: list[float]) -> bytes:
    """Return a sentence with the commands of all thrusters, from -1 to 1."""
    body = ",".join(["PUWTC", "", *(f"{value:.4f}" for value in values)]).encode()
    return b"$%s*%02X\r\n" % (body, reduce(xor, body))


def main(depth_path: str, thruster_path: str, target: float) -> None:
    """Hold a depth [m] until the lines are closed."""
    thruster_line = os.open(thruster_path, os.O_WRONLY | os.O_NOCTTY)
    last_depth = None
    with (
        open(depth_path, "rb", buffering=0) as depth_line,
        suppress(OSError, KeyboardInterrupt),  # the simulation has ended
    ):
        while line := depth_line.readline():
            try:
                depth = read_depth(line)
            except ValueError:
                continue  # the first line may be incomplete
            rate = 0.0 if last_depth is None else (depth - last_depth) * 10.0  # at 10 Hz
            last_depth = depth
            command = min(max(GAIN * (target - depth) - DAMPING * rate, -1.0), 1.0)
            os.write(thruster_line, format_commands([0.0] * 4 + [command] * 4))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], float(sys.argv[3]))

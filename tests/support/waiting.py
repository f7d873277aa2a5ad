"""Wait for other threads and processes, and find free ports."""

from __future__ import annotations

import random
import socket
import time
from collections.abc import Callable

LIMIT = 200.0
"""The timeout of tests [s]."""


def wait_until(condition: Callable[[], object], *steps: Callable[[], object]) -> None:
    """Call the steps repeatedly until the condition holds."""
    end = time.monotonic() + LIMIT
    while not condition():
        for step in steps:
            step()
        if time.monotonic() > end:
            raise AssertionError("the condition did not hold before the timeout")
        time.sleep(0.002)


def free_port() -> int:
    """Return a free port outside the range of ephemeral ports.

    So no other process takes it meanwhile, and a client that connects early never connects to
    itself.
    """
    for port in random.SystemRandom().sample(range(10_000, 30_000), 100):
        try:
            socket.create_server(("127.0.0.1", port)).close()
        except OSError:
            continue
        return port
    raise RuntimeError("no free port")

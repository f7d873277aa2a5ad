"""Waiting for what other threads and processes do, without guessing how long it takes; ports."""

from __future__ import annotations

import random
import socket
import time
from collections.abc import Callable

LIMIT = 200.0
"""When a test gives up [s]; nothing is measured by it."""


def until(condition: Callable[[], object], *steps: Callable[[], object]) -> None:
    """Call the steps again and again until the condition holds."""
    end = time.monotonic() + LIMIT
    while not condition():
        for step in steps:
            step()
        if time.monotonic() > end:
            raise AssertionError("what was waited for did not happen in time")
        time.sleep(0.002)


def free_port() -> int:
    """Return a port that nobody listens on, outside the range from which the system gives ports.

    So nothing else takes it meanwhile, and who calls it before somebody listens never reaches
    itself.
    """
    for port in random.SystemRandom().sample(range(10_000, 30_000), 100):
        try:
            socket.create_server(("127.0.0.1", port)).close()
        except OSError:
            continue
        return port
    raise RuntimeError("no free port")

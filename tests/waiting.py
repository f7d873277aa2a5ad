"""Waiting for what other threads and processes do, without guessing how long it takes."""

from __future__ import annotations

import time
from collections.abc import Callable

LIMIT = 60.0
"""When a test gives up [s]; nothing is measured by it."""


def until(condition: Callable[[], object], *steps: Callable[[], object]) -> None:
    """Call the steps again and again until the condition holds."""
    end = time.monotonic() + LIMIT
    while not condition():
        for step in steps:
            step()
        if time.monotonic() > end:
            raise AssertionError("what was waited for did not happen within a minute")
        time.sleep(0.002)

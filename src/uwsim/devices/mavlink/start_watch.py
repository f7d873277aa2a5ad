"""The report that no autopilot has answered by MAVLink; it depends on the wall clock."""

from __future__ import annotations

import time

from ...base.terminal import report

MAX_START = 5.0
"""The wall time of a run without a heartbeat after which that is reported [s]."""


class StartWatch:
    """The watch over the first heartbeat of an autopilot; it affects messages only.

    Args:
        address: the address of the autopilot.
    """

    def __init__(self, address: str) -> None:
        self._address = address
        self._start_time: float | None = None  # of the first check [s of wall time]
        self._is_reported = False

    def check(self) -> None:
        """Report once that no heartbeat has come within `MAX_START` of the first check."""
        now = time.monotonic()
        if self._start_time is None:
            self._start_time = now
        if now - self._start_time > MAX_START and not self._is_reported:
            self._is_reported = True
            report(self.describe())

    def describe(self) -> str:
        """Return the sentence about an autopilot that has sent no heartbeat."""
        return (
            f"no MAVLink at {self._address}: is it SERIAL1 of this ArduPilot (TCP 5762, and 10 "
            "more for each -I), and free? <address> of <u:mavlink> sets another."
        )

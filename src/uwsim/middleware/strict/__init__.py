"""The strict clock of hardware in the loop: it counts what is late, and measures delays."""

from __future__ import annotations

from .delays import Delays
from .strict_clock import StreamReport, StrictClock, StrictReport

__all__ = ["Delays", "StreamReport", "StrictClock", "StrictReport"]

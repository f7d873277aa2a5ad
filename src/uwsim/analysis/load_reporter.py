"""Loading the report: a small module, so that a process can be started before it loads."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path


def load_reporter() -> Callable[[Path], object]:
    """Import and return the function that draws the report of a result directory."""
    from .report import write_report

    return write_report

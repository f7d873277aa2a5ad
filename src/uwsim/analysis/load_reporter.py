"""The import of the report in a small module, so that a process can start before the import."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path


def load_reporter() -> Callable[[Path], object]:
    """Import and return the function that writes the report of a result directory."""
    from .report import write_report

    return write_report

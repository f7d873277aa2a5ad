"""The import of the report, in a module that imports fast, so that a process can start first."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path


def load_reporter() -> Callable[[Path], object]:
    """Import and return the function that writes the report of a result; the import is slow."""
    from .report import write_report

    return write_report

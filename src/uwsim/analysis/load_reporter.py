"""The deferred import of the report writer.

This module is cheap to import, so a worker process can be started before the slow import.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path


def load_reporter() -> Callable[[Path], object]:
    """Import and return `write_report`; the import is slow."""
    from .report import write_report

    return write_report

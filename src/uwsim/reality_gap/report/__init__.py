"""The files, tables and plots of a measurement of the gap."""

from __future__ import annotations

from .terminal import print_gap
from .write import PAGE, WRITTEN_FILES, WRITTEN_FOLDERS, write_gap

__all__ = ["PAGE", "WRITTEN_FILES", "WRITTEN_FOLDERS", "print_gap", "write_gap"]

"""The files, tables and plots of an identification."""

from __future__ import annotations

from .terminal import print_tables
from .write import PAGE, WRITTEN_FILES, WRITTEN_FOLDERS, write_identification

__all__ = ["PAGE", "WRITTEN_FILES", "WRITTEN_FOLDERS", "print_tables", "write_identification"]

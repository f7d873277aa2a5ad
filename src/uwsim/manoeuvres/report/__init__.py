"""The report of manoeuvres: plots, tables, JSON and a page."""

from __future__ import annotations

from .write import WRITTEN_FILES, WRITTEN_FOLDERS, write_report

__all__ = ["WRITTEN_FILES", "WRITTEN_FOLDERS", "write_report"]

"""Report: one HTML file that says what was run, what was found, and how far to trust it."""

from __future__ import annotations

from .page import render, write_report

__all__ = ["render", "write_report"]

"""The report: one HTML file with configuration, results and caveats of a run."""

from __future__ import annotations

from .page import render, write_report

__all__ = ["render", "write_report"]

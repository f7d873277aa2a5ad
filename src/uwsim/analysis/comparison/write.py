"""The writing of the files of a comparison into its directory."""

from __future__ import annotations

import re
from pathlib import Path

from ...results.atomic_file import write_text
from .document import csv_text, json_text
from .model import Comparison
from .page import render
from .plots import draw_comparison

WRITTEN_FILES = re.compile(
    r"(comparison\.(json|csv|html)|plots/(curves|differences|success|times)\.(png|pdf))"
)
"""The paths of the files that uwsim writes into the directory of a comparison."""
WRITTEN_FOLDERS = ("plots",)
PAGE = "comparison.html"


def write_comparison(comparison: Comparison, directory: Path) -> Path:
    """Write the numbers, plots and page into ``directory``; return the path of the page."""
    directory.mkdir(parents=True, exist_ok=True)
    write_text(directory / "comparison.json", json_text(comparison))
    write_text(directory / "comparison.csv", csv_text(comparison))
    plots = draw_comparison(comparison, directory / "plots")
    write_text(directory / PAGE, render(comparison, plots))
    return directory / PAGE

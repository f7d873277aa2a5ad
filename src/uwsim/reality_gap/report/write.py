"""The writing of the files of a gap into its directory."""

from __future__ import annotations

import re
from pathlib import Path

from ...base.files.staging import stage_directory
from ...results.atomic_file import write_text
from ...results.directory import clear_directory
from ..gap import Gap
from .document import csv_text, json_text
from .page import render
from .plots import draw_plots

WRITTEN_FILES = re.compile(
    r"(gap\.json|windows\.csv|report\.html"
    r"|plots/(horizon|tracks|coefficients|spectrum)\.(png|pdf))"
)
"""The paths of the files that uwsim writes into the directory of a gap."""
WRITTEN_FOLDERS = ("plots",)
PAGE = "report.html"


def write_gap(gap: Gap, directory: Path, *, overwrite: bool = False) -> None:
    """Write the numbers, the errors of the windows, plots and the page.

    All files are written beside the directory first, so that an error leaves it as it was.

    Args:
        gap: the gap.
        directory: the directory.
        overwrite: whether to replace an earlier gap.

    Raises:
        BadSetting: the directory holds other files, or an earlier gap without `overwrite`.
    """
    with stage_directory(directory) as draft:
        plots = draw_plots(gap, draft / "plots")
        write_text(draft / "gap.json", json_text(gap))
        write_text(draft / "windows.csv", csv_text(gap))
        write_text(draft / PAGE, render(gap, plots))
        clear_directory(
            directory, overwrite=overwrite, pattern=WRITTEN_FILES, folders=WRITTEN_FOLDERS
        )

"""The writing of the files of an identification into its directory."""

from __future__ import annotations

import re
from pathlib import Path

from ...base.files.staging import stage_directory
from ...results.atomic_file import write_text
from ...results.directory import clear_directory
from ..hydrodynamics_file import write_hydrodynamics
from ..identify import Identification
from .document import json_text
from .page import render
from .plots import draw_plots

WRITTEN_FILES = re.compile(
    r"([\w.-]+_identified\.xml|identification\.json|report\.html|plots/[a-z-]+\.(png|pdf))"
)
"""The paths of the files that uwsim writes into the directory of an identification."""
WRITTEN_FOLDERS = ("plots",)
PAGE = "report.html"


def write_identification(
    result: Identification, directory: Path, *, overwrite: bool = False
) -> list[str]:
    """Write the hydrodynamics file, numbers, plots and page; return the names of the files.

    All files are written beside the directory first, so that an error leaves it as it was.

    Args:
        result: the identification.
        directory: the directory.
        overwrite: whether to replace an earlier identification.

    Raises:
        BadSetting: the directory holds other files, or an earlier identification without
            `overwrite`.
    """
    name = re.sub(r"[^\w.-]+", "_", result.model.hydrodynamics.name) + "_identified"
    with stage_directory(directory) as draft:
        plots = draw_plots(result, draft / "plots")
        write_text(draft / f"{name}.xml", write_hydrodynamics(result, name))
        write_text(draft / "identification.json", json_text(result))
        write_text(draft / PAGE, render(result, plots, f"{name}.xml"))
        clear_directory(
            directory, overwrite=overwrite, pattern=WRITTEN_FILES, folders=WRITTEN_FOLDERS
        )
    return [f"{name}.xml", "identification.json", PAGE]

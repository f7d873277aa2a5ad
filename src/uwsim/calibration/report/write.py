"""The writing of the files of a calibration into its directory."""

from __future__ import annotations

import re
from pathlib import Path

from ...base.files.staging import stage_directory
from ...optics import write_water
from ...results.atomic_file import write_text
from ...results.directory import clear_directory
from ..calibrate import Calibration
from ..readings_file import write_readings
from .document import json_text
from .page import render
from .plots import draw_plots

WRITTEN_FILES = re.compile(
    r"((.+\.)?water\.json|readings\.csv|calibration\.json|report\.html"
    r"|plots/.+-(fit|contrast)\.(png|pdf))"
)
"""The paths of the files that uwsim writes into the directory of a calibration."""
WRITTEN_FOLDERS = ("plots",)
PAGE = "report.html"


def write_calibration(
    calibration: Calibration, directory: Path, source: str, *, overwrite: bool = False
) -> list[Path]:
    """Write the waters, readings, numbers, plots and page; return the paths of the water files.

    A single water is ``water.json``; several have their name in front. All files are written beside
    the directory first, so that an error leaves it as it was.

    Args:
        calibration: the result.
        directory: the directory.
        source: the name of the set-up, for the page and the water files.
        overwrite: whether to replace an earlier calibration.

    Raises:
        BadSetting: the directory holds other files, or an earlier calibration without `overwrite`.
    """
    with stage_directory(directory) as draft:
        names = [path.name for path in _write_files(calibration, draft, source)]
        clear_directory(
            directory, overwrite=overwrite, pattern=WRITTEN_FILES, folders=WRITTEN_FOLDERS
        )
    return [directory / name for name in names]


def _write_files(calibration: Calibration, directory: Path, source: str) -> list[Path]:
    stems = _name_files([water.name for water in calibration.waters])
    water_files, plots = [], []
    for water, stem in zip(calibration.waters, stems, strict=True):
        plots.append(draw_plots(water, directory / "plots", stem))
        name = "water.json" if len(stems) == 1 else f"{stem}.water.json"
        text = write_water(water.make_water_file(f"uwsim calibrate, {source}"))
        write_text(directory / name, text)
        water_files.append(directory / name)
    write_text(directory / "readings.csv", write_readings(calibration.measurements.waters))
    write_text(directory / "calibration.json", json_text(calibration))
    write_text(directory / PAGE, render(calibration, plots, source))
    return water_files


def _name_files(names: list[str]) -> list[str]:
    """Return a name for files for each water: letters, digits, hyphens; each once."""
    stems: list[str] = []
    for name in names:
        stem = re.sub(r"[^A-Za-z0-9]+", "-", name).strip("-").lower()[:60] or "water"
        number, candidate = 1, stem
        while candidate in stems:
            number += 1
            candidate = f"{stem}-{number}"
        stems.append(candidate)
    return stems

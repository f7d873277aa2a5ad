"""Plots of results: columns over levels, measures over time, tracks from above."""

from __future__ import annotations

from .curves import (
    algorithm_of,
    curves_of,
    label_of,
    level_text,
    levels_text,
    repeats_of,
    written_unit,
)
from .drawing import CONTROL_ALGORITHM, MAX_INSIDE, is_fog_swept
from .level_plots import (
    OVERVIEW_NAME,
    compare_plot,
    draw_plots,
    small_multiples,
    value_plot,
)
from .panels import choose_evenly
from .run_plots import RunPlot, draw_run_plots
from .save import save_pdf, save_plot
from .style import (
    GREY,
    INK,
    LEVEL_WORDS,
    MARKERS,
    PALETTE,
    SIZE,
    escape,
    level_label,
    level_word,
    styled_figure,
    write_note,
)
from .success_overview import OverviewRow, success_overview

__all__ = [
    "CONTROL_ALGORITHM",
    "GREY",
    "INK",
    "LEVEL_WORDS",
    "MARKERS",
    "MAX_INSIDE",
    "OVERVIEW_NAME",
    "PALETTE",
    "SIZE",
    "OverviewRow",
    "RunPlot",
    "algorithm_of",
    "choose_evenly",
    "compare_plot",
    "curves_of",
    "draw_plots",
    "draw_run_plots",
    "escape",
    "is_fog_swept",
    "label_of",
    "level_label",
    "level_text",
    "level_word",
    "levels_text",
    "repeats_of",
    "save_pdf",
    "save_plot",
    "small_multiples",
    "styled_figure",
    "success_overview",
    "value_plot",
    "write_note",
    "written_unit",
]

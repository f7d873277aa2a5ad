"""Plots of results."""

from __future__ import annotations

from .curves import (
    Curve,
    algorithm_of,
    curves_of,
    label_of,
    level_text,
    repeats_of,
    written_unit,
)
from .drawing import CONTROL, MAX_INSIDE, is_fog_swept
from .of_a_run import RunPlot, draw_run_plots
from .over_levels import (
    OVERVIEW,
    compare_plot,
    draw_plots,
    small_multiples,
    value_plot,
)
from .save import save_pdf, save_plot
from .style import (
    DPI,
    FAINT,
    INK,
    LEVEL_WORDS,
    MARKERS,
    PALETTE,
    SIZE,
    level_label,
    plain,
    styled_figure,
    write_note,
)

__all__ = [
    "CONTROL",
    "DPI",
    "FAINT",
    "INK",
    "LEVEL_WORDS",
    "MARKERS",
    "MAX_INSIDE",
    "OVERVIEW",
    "PALETTE",
    "SIZE",
    "Curve",
    "RunPlot",
    "algorithm_of",
    "compare_plot",
    "curves_of",
    "draw_plots",
    "draw_run_plots",
    "is_fog_swept",
    "label_of",
    "level_label",
    "level_text",
    "plain",
    "repeats_of",
    "save_pdf",
    "save_plot",
    "small_multiples",
    "styled_figure",
    "value_plot",
    "write_note",
    "written_unit",
]

"""Writing plots: PNG for pages, PDF for papers; the same bytes every time."""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ...results.atomic_file import atomic_write
from .style import DPI, any_letter


def save_plot(figure: Figure, path: Path) -> Path:
    """Write a plot as PNG, 200 dots an inch, without a date or a program's name in it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    FigureCanvasAgg(figure)
    engine, dpi = figure.get_layout_engine(), figure.dpi
    with any_letter(), atomic_write(path) as draft:
        if engine is not None:
            figure.set_dpi(DPI)
            engine.execute(figure)
            figure.set_layout_engine(None)  # else `savefig` draws the figure twice
        figure.savefig(draft, dpi=DPI, format="png", metadata={"Software": None})
    figure.set_dpi(dpi)
    figure.set_layout_engine(engine)
    return path


def save_pdf(figure: Figure, path: Path) -> Path:
    """Write a plot as PDF for a paper: letters as letters, without a date or a program's name."""
    with mpl.rc_context({"pdf.fonttype": 42}), any_letter(), atomic_write(path) as draft:
        figure.savefig(
            draft, format="pdf", metadata={"CreationDate": None, "Producer": None, "Creator": None}
        )
    return path

"""The files of plots: PNG for pages, PDF for papers; the same plot gives the same bytes."""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ...results.atomic_file import atomic_write
from .style import DPI, ignore_missing_glyphs


def save_plot(figure: Figure, path: Path) -> Path:
    """Write a plot as PNG with `DPI` dots per inch, without the date and the name of a program."""
    path.parent.mkdir(parents=True, exist_ok=True)
    FigureCanvasAgg(figure)
    engine, dpi = figure.get_layout_engine(), figure.dpi
    with ignore_missing_glyphs(), atomic_write(path) as draft:
        if engine is not None:
            figure.set_dpi(DPI)
            engine.execute(figure)
            figure.set_layout_engine(None)  # with an engine, `savefig` draws the figure twice
        figure.savefig(draft, dpi=DPI, format="png", metadata={"Software": None})
    figure.set_dpi(dpi)
    figure.set_layout_engine(engine)
    return path


def save_pdf(figure: Figure, path: Path) -> Path:
    """Write a plot as PDF whose text can be searched, without date and name of a program."""
    settings = mpl.rc_context({"pdf.fonttype": 42})
    with settings, ignore_missing_glyphs(), atomic_write(path) as draft:
        figure.savefig(
            draft, format="pdf", metadata={"CreationDate": None, "Producer": None, "Creator": None}
        )
    return path

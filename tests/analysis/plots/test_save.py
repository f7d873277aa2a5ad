"""Saving a plot draws it once, with the bytes of Matplotlib's own layout."""

from __future__ import annotations

from pathlib import Path

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg, RendererAgg
from matplotlib.figure import Figure

from uwsim.analysis.plots.save import save_plot
from uwsim.analysis.plots.style import DPI, styled_figure


def a_plot() -> Figure:
    """Make a plot with a legend and labels."""
    with styled_figure() as figure:
        axes = figure.subplots()
        axes.plot([0.0, 1.0, 2.0], [3.0, 1.0, 2.0], label="esm")
        axes.set_xlabel("fog density [1/m]")
        axes.legend()
    return figure


def test_a_saved_plot_has_the_bytes_of_matplotlib_and_keeps_its_layout(tmp_path: Path) -> None:
    figure, plain = a_plot(), a_plot()
    engine, dpi = figure.get_layout_engine(), figure.dpi
    FigureCanvasAgg(plain)
    plain.savefig(tmp_path / "plain.png", dpi=DPI, metadata={"Software": None})
    saved = save_plot(figure, tmp_path / "saved.png")
    assert saved.read_bytes() == (tmp_path / "plain.png").read_bytes()
    assert (figure.get_layout_engine(), figure.dpi) == (engine, dpi)


def test_a_plot_is_drawn_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    drawn = []
    draw = Figure.draw

    def record(self: Figure, renderer: RendererAgg) -> None:
        drawn.append(self)
        draw(self, renderer)

    monkeypatch.setattr(Figure, "draw", record)
    save_plot(a_plot(), tmp_path / "plot.png")
    assert len(drawn) == 1

"""The style of plots: colour-blind safe colours, sizes, names, footnotes."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from ...results.result import Column
from .curves import written_unit

PALETTE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#7A5C00")
"""Okabe and Ito's colour-blind safe colours, in an order that prints well."""

MARKERS = ("o", "s", "^", "D", "v", "P", "X")
INK, FAINT = "#222222", "#777777"
DPI = 200
SIZE = (5.0, 3.1)  # [inch]
MAX_NAME_LENGTH = 36
"""Letters of a name before it is cut."""

LEVEL_WORDS = {
    "armPosition": "arm position",
    "attenuationLength": "attenuation length",
    "current": "current",
    "fog": "fog density",
    "iteration": "iteration",
    "light": "light rate",
    "noise": "camera noise",
    "none": "",
    "visibilityRange": "visibility range",
}
"""Swept parameter -> its label on an axis."""

STYLE: Any = {
    "font.family": "DejaVu Sans",
    "font.size": 8.5,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.6,
    "xtick.color": INK,
    "ytick.color": INK,
    "lines.linewidth": 1.4,
    "lines.markersize": 3.6,
    "legend.frameon": False,
    "legend.fontsize": 7.5,
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "svg.hashsalt": "uwsim",
}


@contextmanager
def styled_figure(size: tuple[float, float] = SIZE) -> Iterator[Figure]:
    """Give an empty figure of ``size`` [inch] in the house style."""
    with mpl.rc_context(STYLE):
        yield Figure(figsize=size, layout=ConstrainedLayoutEngine(rect=(0, 0.03, 1, 0.97)))


def write_note(figure: Figure, *lines: str) -> None:
    """Write small lines below a plot, the axes making room for them."""
    written = [line for line in lines if line]
    height = (0.02 + 0.085 * len(written)) / float(figure.get_figheight())
    figure.set_layout_engine(ConstrainedLayoutEngine(rect=(0, height, 1, 1 - height)))
    text = "\n".join(map(plain, written))
    figure.text(0.995, 0.004, text, ha="right", va="bottom", fontsize=5.5, color=FAINT)


@contextmanager
def any_letter() -> Iterator[None]:
    """Let names have letters that the font has not: they are drawn as boxes, without a warning."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", r"Glyph \d+ .* missing from", UserWarning)
        yield


def plain(text: str) -> str:
    """Return a name as matplotlib shows it: a dollar in it is a dollar, not mathematics."""
    return re.sub(r"(?<!\\)\$", r"\\$", text)


def cut(name: str, longest: int = MAX_NAME_LENGTH) -> str:
    """Leave the middle of a very long name out."""
    if len(name) <= longest:
        return name
    half = longest // 2
    return f"{name[:half]}…{name[-half + 1 :]}"


def level_label(column: Column) -> str:
    """Return what the axis of a level is called: ``fog density [m⁻¹]``."""
    word = LEVEL_WORDS.get(column.name, column.name)
    return f"{word} [{written_unit(column.unit)}]" if column.unit else word

"""The style of plots: colours that colour-blind readers can distinguish, sizes, names, notes."""

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
"""The colours of Okabe and Ito, which colour-blind readers can distinguish."""

MARKERS = ("o", "s", "^", "D", "v", "P", "X")
INK, GREY = "#222222", "#777777"
DPI = 200
SIZE = (5.0, 3.1)  # [inch]
MAX_NAME_LENGTH = 36
"""The number of characters above which a name is shortened."""

LEVEL_WORDS = {
    "armPosition": "arm position",
    "attenuationLength": "attenuation length",
    "attenuationLengths": "attenuation lengths to the target",
    "beamAttenuation": "beam attenuation",
    "current": "current",
    "fog": "fog density",
    "iteration": "iteration",
    "light": "light rate",
    "noise": "camera noise",
    "none": "",
    "turbidity": "turbidity",
    "visibilityRange": "visibility range",
    "waterScale": "scale of the water",
    "waveHeight": "significant wave height",
}
"""The words for a swept parameter in the label of an axis."""

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
    "mathtext.default": "it",
}


@contextmanager
def styled_figure(size: tuple[float, float] = SIZE) -> Iterator[Figure]:
    """Yield an empty figure of ``size`` [inch] in the style of uwsim."""
    with mpl.rc_context(STYLE):
        yield Figure(figsize=size, layout=ConstrainedLayoutEngine(rect=(0, 0.03, 1, 0.97)))


def write_note(figure: Figure, *lines: str) -> None:
    """Write small lines below a plot, and move its axes up."""
    note_lines = [line for line in lines if line]
    height = (0.02 + 0.085 * len(note_lines)) / float(figure.get_figheight())
    figure.set_layout_engine(ConstrainedLayoutEngine(rect=(0, height, 1, 1 - height)))
    text = "\n".join(map(escape, note_lines))
    figure.text(0.995, 0.004, text, ha="right", va="bottom", fontsize=5.5, color=GREY)


@contextmanager
def ignore_missing_glyphs() -> Iterator[None]:
    """Suppress the warnings about characters that the font lacks, which are drawn as boxes."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", r"Glyph \d+ .* missing from", UserWarning)
        yield


def escape(text: str) -> str:
    """Return a text with escaped dollar signs, so that matplotlib does not read mathematics."""
    return re.sub(r"(?<!\\)\$", r"\\$", text)


def shorten_name(name: str, max_length: int = MAX_NAME_LENGTH) -> str:
    """Return a name without the middle of a very long one."""
    if len(name) <= max_length:
        return name
    half = max_length // 2
    return f"{name[:half]}…{name[-half + 1 :]}"


def level_word(column: Column) -> str:
    """Return the words for a swept parameter; empty for the parameter ``none``."""
    if column.name == "noise" and (column.unit or "").startswith("dB"):
        return "noise level of the water"
    return LEVEL_WORDS.get(column.name, column.name)


def level_label(column: Column) -> str:
    """Return the label of the axis of a level: ``fog density [m⁻¹]``."""
    label = level_word(column)
    return f"{label} [{written_unit(column.unit)}]" if column.unit else label

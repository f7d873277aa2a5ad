"""The plots of an identification: coefficients, errors over the horizon, a window, correlations."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...analysis.plots import GREY, INK, PALETTE, save_pdf, save_plot, styled_figure
from ...base.geometry import Array
from ..identify import Identification
from ..parameters import AXES
from ..validation import QUANTITIES, measured_columns

FIRST_COLOUR, FITTED_COLOUR = PALETTE[1], PALETTE[0]
"""The colours of the first guess and of identified coefficients."""
N_BINS = 25
"""The number of points of a curve over the horizon."""
MAX_CORRELATIONS = 40
"""The greatest number of coefficients in the plot of correlations."""
SCALES = {
    "position": (100.0, "position [cm]"),
    "attitude": (180.0 / np.pi, "attitude [°]"),
    "velocity": (100.0, "velocity [cm/s]"),
    "angular velocity": (180.0 / np.pi, "angular velocity [°/s]"),
}
"""The factor and the label of each quantity in plots."""


def draw_plots(result: Identification, directory: Path) -> list[Path]:
    """Draw the plots as PNG and PDF; return the paths of the PNGs."""
    figures = {"coefficients": _draw_coefficients(result), "horizon": _draw_horizon(result)}
    if np.isfinite(result.windows.samples[:, :, 7:]).any():
        figures["window"] = _draw_window(result)
    if 2 <= len(result.parameters) <= MAX_CORRELATIONS:
        figures["correlations"] = _draw_correlations(result)
    paths = []
    for name, figure in figures.items():
        paths.append(save_plot(figure, directory / f"{name}.png"))
        save_pdf(figure, directory / f"{name}.pdf")
    return paths


def _draw_coefficients(result: Identification) -> Figure:
    """Draw each coefficient relative to its first guess, with its interval."""
    estimates = result.uncertainty.estimates
    with styled_figure((6.4, 1.0 + 0.21 * len(estimates))) as figure:
        axes = figure.subplots()
        for row, estimate in enumerate(estimates):
            guess, error = estimate.parameter.first_guess, estimate.parameter.plausible_error
            scale, shift = (guess, 0.0) if guess > 0.0 else (error, 1.0)
            value, low, high = (
                number / scale + shift for number in (estimate.value, estimate.low, estimate.high)
            )
            colour = FITTED_COLOUR if estimate.is_determined else GREY
            axes.plot([low, high], [row, row], color=colour, linewidth=2.0, solid_capstyle="butt")
            marker = "o" if estimate.is_determined else "x"
            axes.plot([value], [row], color=colour, marker=marker, markersize=4.5)
        axes.axvline(1.0, color=FIRST_COLOUR, linewidth=1.0, label="first guess")
        axes.set_yticks(range(len(estimates)), [_label(e.parameter.name) for e in estimates])
        axes.set_ylim(len(estimates) - 0.4, -0.6)
        axes.set_xlabel("identified / first guess, with 95 % interval")
        axes.grid(visible=False, axis="y")
        axes.legend(loc="best")
    return figure


def _label(name: str) -> str:
    return name.replace("_", " ").replace("[", ", ").replace("]", "")


def _draw_horizon(result: Identification) -> Figure:
    """Draw the error of held-out windows over the time since their start."""
    windows = result.windows
    times = (windows.index + windows.fraction) * windows.settings.step
    has_sample = np.asarray(np.isfinite(windows.samples).any(axis=2))
    edges = np.linspace(0.0, windows.settings.length, N_BINS + 1)
    quantities = {
        name: channels
        for name, (_, channels) in QUANTITIES.items()
        if measured_columns(windows, channels)
    }
    n_rows = -(-len(quantities) // 2)
    with styled_figure((7.4, 2.1 * n_rows)) as figure:
        panels = figure.subplots(n_rows, 2, sharex=True, squeeze=False)
        for axes in panels.ravel()[len(quantities) :]:
            axes.set_visible(False)
        for axes, (name, channels) in zip(panels.ravel(), quantities.items(), strict=False):
            factor, label = SCALES[name]
            for errors, colour, text in (
                (result.first_errors, FIRST_COLOUR, "first guess"),
                (result.held_out_errors, FITTED_COLOUR, "identified, on held-out windows"),
            ):
                curve = _average(errors[:, :, channels], times, has_sample, edges)
                middle = 0.5 * (edges[:-1] + edges[1:])
                axes.plot(middle, factor * curve, color=colour, label=text)
            axes.set_ylabel(label)
            axes.set_ylim(bottom=0.0)
        for axes in panels[-1]:
            axes.set_xlabel("time since the start of a window [s]")
        panels[0, 0].legend(loc="upper left")
    return figure


def _average(errors: Array, times: Array, has_sample: npt.NDArray[np.bool_], edges: Array) -> Array:
    """Return the root mean square error in each interval of time, (bins,)."""
    squares = (errors * errors).sum(axis=2)
    curve = np.full(len(edges) - 1, np.nan)
    for k in range(len(curve)):
        is_inside = has_sample & (times >= edges[k]) & (times <= edges[k + 1])
        if is_inside.any():
            curve[k] = np.sqrt(squares[is_inside].mean())
    return curve


def _draw_window(result: Identification) -> Figure:
    """Draw the velocities of the window with the greatest improvement."""
    windows = result.windows
    gain = (result.first_errors[:, :, 6:] ** 2 - result.held_out_errors[:, :, 6:] ** 2).sum((1, 2))
    row = int(np.argmax(gain))
    velocities = windows.samples[row, :, 7:]
    has_values = np.isfinite(velocities).any(axis=1)
    times = (windows.times[row] + (windows.index + windows.fraction)[row] * windows.settings.step)[
        has_values
    ]
    axes_with_data = np.flatnonzero(np.isfinite(velocities).any(axis=0)).tolist()
    n_columns = min(len(axes_with_data), 3)
    n_rows = -(-len(axes_with_data) // n_columns)
    with styled_figure((2.47 * n_columns, 0.6 + 1.9 * n_rows)) as figure:
        panels = figure.subplots(n_rows, n_columns, sharex=True, squeeze=False)
        for axes in panels.ravel()[len(axes_with_data) :]:
            axes.set_visible(False)
        for axis, axes in zip(axes_with_data, panels.ravel(), strict=False):
            factor = 1.0 if axis < 3 else 180.0 / np.pi
            unit = "m/s" if axis < 3 else "°/s"
            values = factor * velocities[has_values, axis]
            first_curve = values - factor * result.first_errors[row, has_values, 6 + axis]
            fitted_curve = values - factor * result.held_out_errors[row, has_values, 6 + axis]
            axes.plot(times, values, color=INK, linestyle="", marker=".", label="measured")
            axes.plot(times, first_curve, color=FIRST_COLOUR, label="first guess")
            axes.plot(times, fitted_curve, color=FITTED_COLOUR, label="identified")
            axes.set_ylabel(f"{AXES[axis]}{' rate' if axis >= 3 else ''} [{unit}]")
        for axes in panels[-1]:
            axes.set_xlabel("time of the log [s]")
        _add_legend(figure, panels[0, 0])
    return figure


def _add_legend(figure: Figure, axes: Axes) -> None:
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=3)


def _draw_correlations(result: Identification) -> Figure:
    """Draw the correlations of the coefficients as a matrix."""
    names = [_label(parameter.name) for parameter in result.parameters]
    size = 2.4 + 0.17 * len(names)
    with styled_figure((size + 0.9, size)) as figure:
        axes = figure.subplots()
        image = axes.imshow(result.uncertainty.correlations, cmap="RdBu_r", vmin=-1.0, vmax=1.0)
        axes.set_xticks(range(len(names)), names, rotation=90)
        axes.set_yticks(range(len(names)), names)
        axes.grid(visible=False)
        _mark_strong(axes, result.uncertainty.correlations)
        figure.colorbar(image, ax=axes, label="correlation", shrink=0.8)
    return figure


def _mark_strong(axes: Axes, correlations: Array) -> None:
    """Mark correlations above 0.9 with a dot."""
    rows, columns = np.nonzero(np.abs(correlations - np.eye(len(correlations))) > 0.9)
    axes.plot(columns, rows, color="white", linestyle="", marker=".", markersize=3)

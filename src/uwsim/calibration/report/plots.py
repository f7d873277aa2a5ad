"""The plots of a calibration: the fit of each reading, and contrast over the range."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...analysis.plots import GREY, MARKERS, PALETTE, save_pdf, save_plot, styled_figure
from ...optics import Medium
from ...optics.visibility import compute_transfer
from ..calibrated_water import CalibratedWater, ChannelResult
from ..forward_model import make_phase_function
from ..quantities import CONTRAST_FREQUENCIES
from ..readings import LedReading

COLOURS = {"red": "#D55E00", "green": "#009E73", "blue": "#0072B2"}
"""The colours of channels with these names."""
SIZE = (7.4, 3.2)
N_RANGES = 80
RANGE_FACTOR = 6.0
"""The greatest range of the plot of contrast, in attenuation lengths of the clearest channel."""


def draw_plots(water: CalibratedWater, directory: Path, stem: str) -> list[Path]:
    """Draw the plots of a water as PNG and PDF; return the paths of the PNGs."""
    paths = []
    for name, figure in (("fit", _draw_fit(water)), ("contrast", _draw_contrast(water))):
        paths.append(save_plot(figure, directory / f"{stem}-{name}.png"))
        save_pdf(figure, directory / f"{stem}-{name}.pdf")
    return paths


def _draw_fit(water: CalibratedWater) -> Figure:
    with styled_figure(SIZE) as figure:
        left, middle, right = figure.subplots(1, 3)
        for index, result in enumerate(water.channels):
            colour = _choose_colour(result, index)
            _draw_readings(left, result, colour, index, is_led=True)
            _draw_readings(middle, result, colour, index, is_led=False)
            _draw_residuals(right, result, colour, index)
        for axes in (left, middle):
            _mark_sizes(axes)
        left.set_xlabel("half-angle of the disc [°]")
        left.set_ylabel("loss −ln(S / S₀)")
        middle.set_xlabel("side of a square [cm]")
        right.set_xlabel("reading")
        right.set_ylabel("residual [standard deviations]")
        right.axhline(0.0, color=GREY, linewidth=0.8)
        for axes, title in ((left, "LEDs"), (middle, "board"), (right, "residuals")):
            axes.set_title(title, fontsize=9)
        legend_axes = next((axes for axes in (left, middle) if axes.lines), left)
        if legend_axes.lines:
            legend_axes.legend(frameon=False, fontsize=7)
    return figure


def _mark_sizes(axes: Axes) -> None:
    """Set a logarithmic scale with a tick at each size that was drawn."""
    sizes = sorted({float(x) for line in axes.lines for x in np.asarray(line.get_xdata())})
    if not sizes:
        return
    axes.set_xscale("log")
    axes.set_xticks(sizes, [f"{size:.3g}" for size in sizes])
    axes.minorticks_off()


def _draw_readings(
    axes: Axes, result: ChannelResult, colour: str, index: int, *, is_led: bool
) -> None:
    estimate = result.estimate
    groups: dict[tuple[str, float], list[int]] = {}
    for number, reading in enumerate(estimate.readings):
        if isinstance(reading, LedReading) is is_led:
            groups.setdefault((reading.source, round(reading.distance, 1)), []).append(number)
    for group_index, numbers in enumerate(groups.values()):
        sizes = np.array([_find_size(result, number) for number in numbers])
        order = np.argsort(sizes)
        rows = np.array(numbers)[order]
        axes.plot(sizes[order], estimate.fitted_losses[rows], color=colour, linewidth=1.0)
        axes.errorbar(
            sizes[order],
            estimate.measured_losses[rows],
            yerr=estimate.errors[rows],
            color=colour,
            linestyle="",
            marker=MARKERS[index % len(MARKERS)],
            markersize=4,
            label=estimate.channel if group_index == 0 else None,
        )


def _draw_residuals(axes: Axes, result: ChannelResult, colour: str, index: int) -> None:
    estimate = result.estimate
    residuals = (estimate.measured_losses - estimate.fitted_losses) / estimate.errors
    axes.plot(
        np.arange(1, len(residuals) + 1),
        residuals,
        color=colour,
        linestyle="",
        marker=MARKERS[index % len(MARKERS)],
        markersize=4,
    )


def _draw_contrast(water: CalibratedWater) -> Figure:
    least_attenuation = min(result.estimate.water.beam_attenuation for result in water.channels)
    ranges = np.linspace(0.0, min(RANGE_FACTOR / max(least_attenuation, 1e-3), 100.0), N_RANGES)
    with styled_figure(SIZE) as figure:
        panels = figure.subplots(1, len(water.channels), sharey=True, squeeze=False)[0]
        for axes, result in zip(panels, water.channels, strict=True):
            estimate = result.estimate
            medium = Medium(
                absorption=(estimate.water.absorption,),
                scattering=(estimate.water.scattering,),
                phase_function=make_phase_function(estimate.water.shape),
            )
            rows: list[tuple[float | None, str]] = [(None, "sharpest detail")]
            rows += [(scale, f"{scale:g} cycles/rad") for scale in CONTRAST_FREQUENCIES]
            for index, (scale, label) in enumerate(rows):
                contrast = compute_transfer(medium, ranges, scale)[:, 0]
                axes.plot(ranges, contrast, color=PALETTE[index], label=label)
            axes.set_yscale("log")
            axes.set_ylim(0.01, 1.1)
            axes.set_xlabel("range [m]")
            axes.set_title(estimate.channel, fontsize=9)
        panels[0].set_ylabel("contrast left")
        panels[0].legend(frameon=False, fontsize=7)
    return figure


def _find_size(result: ChannelResult, number: int) -> float:
    reading = result.estimate.readings[number]
    if isinstance(reading, LedReading):
        return math.degrees(reading.half_angle)
    return float(getattr(reading, "side", 0.0)) * 100.0


def _choose_colour(result: ChannelResult, index: int) -> str:
    return COLOURS.get(result.estimate.channel, PALETTE[index % len(PALETTE)])

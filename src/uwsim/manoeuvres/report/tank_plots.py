"""The plots of the tank experiments: resistance, bollard pull, free decay."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure

from ...analysis.plots import GREY, INK, PALETTE, styled_figure
from ..tank import AXES, TankResults

N_POINTS = 60


def draw_tows(tank: TankResults) -> Figure:
    """Draw the force of the tows over the steady speed, with the fit, along each axis."""
    with styled_figure((7.4, 4.4)) as figure:
        panels = figure.subplots(2, 2).ravel()
        for axes, tow in zip(panels, tank.tows, strict=False):
            resistance = tow.resistance
            speeds = np.linspace(0.0, 1.05 * float(resistance.speeds.max()), N_POINTS)
            fit = resistance.linear * speeds + resistance.quadratic * speeds**2
            axes.plot(
                speeds, fit, color=PALETTE[0],
                label=_fit_text(resistance.linear, resistance.quadratic, tow.axis),
            )  # fmt: skip
            axes.plot(resistance.speeds, resistance.forces, "o", color=INK, markersize=4)
            is_rotation = tow.axis > 2
            axes.set_xlabel(f"{AXES[tow.axis]} {'rate [°/s]' if is_rotation else 'speed [m/s]'}")
            if is_rotation:
                axes.xaxis.set_major_formatter(lambda value, _: f"{math.degrees(value):.0f}")
                degrees = _round_steps(math.degrees(float(resistance.speeds.max())))
                axes.set_xticks(np.radians(degrees).tolist())
            axes.set_ylabel("moment [N m]" if is_rotation else "force [N]")
            axes.set_xlim(left=0.0)
            axes.set_ylim(bottom=0.0)
            axes.legend(frameon=False, fontsize=7.5, loc="upper left", handlelength=1.2)
    return figure


def _fit_text(linear: float, quadratic: float, axis: int) -> str:
    symbol = "r" if axis > 2 else "v"
    terms = []
    if linear > 1e-3 * quadratic:
        terms.append(f"{linear:.3g} {symbol}")
    if quadratic > 0.0:
        terms.append(f"{quadratic:.4g} {symbol}²")
    return " + ".join(terms)


def _round_steps(end: float) -> list[float]:
    """Return about five round values from 0 to a greatest one."""
    step = 10.0 ** math.floor(math.log10(end / 4.0))
    step *= next(factor for factor in (1.0, 2.0, 5.0, 10.0) if factor * step >= end / 5.0)
    return [k * step for k in range(int(1.05 * end / step) + 1)]


def draw_tank(tank: TankResults) -> Figure:
    """Draw the bollard pull over the command, and the free decays in roll and pitch."""
    with styled_figure((7.4, 2.9)) as figure:
        pull, *panels = figure.subplots(1, 3)
        pull.axhline(0.0, color=GREY, linewidth=0.6)
        pull.axvline(0.0, color=GREY, linewidth=0.6)
        pull.plot(tank.commands, tank.pulls, "o-", color=PALETTE[0], markersize=3)
        pull.set_xlabel("command [1]")
        pull.set_ylabel("pull ahead [N]")
        pull.set_title("bollard pull", fontsize=9)
        for axes, record in zip(panels, tank.decays, strict=True):
            axes.axhline(0.0, color=GREY, linewidth=0.6)
            decay = record.decay
            end = 12.0 if decay is None else min(6.0 * decay.period, float(record.times[-1]))
            is_shown = record.times <= end
            axes.plot(record.times[is_shown], np.degrees(record.angles[is_shown]), color=PALETTE[0])
            axes.set_xlabel("time [s]")
            axes.set_ylabel(f"{AXES[record.axis]} [°]")
            text = "no swing" if decay is None else f"T = {decay.period:.2f} s"
            axes.set_title(f"free decay, {text}", fontsize=9)
    return figure

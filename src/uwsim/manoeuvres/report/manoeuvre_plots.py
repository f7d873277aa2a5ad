"""The plots of standard manoeuvres: tracks, headings and rudder over time, the spiral's curve."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...analysis.plots import GREY, INK, PALETTE, styled_figure
from ...base.geometry import Array
from ...benchmark.metrics.manoeuvres import ManoeuvreTrack, TurningCircle, ZigZag
from ..trials import TrialResults

STARBOARD, PORT = PALETTE[2], PALETTE[1]
"""The colours of starboard, green, and of port, red."""
TRACK_SIZE = (6.4, 4.2)
WIDE_SIZE = (7.4, 3.4)
MIN_WIDTH = 3.0
"""The tactical diameter from which on hulls and dimension lines are drawn [L]."""
N_HULLS = 9
"""The number of hulls that are drawn along a track."""
BEAM_RATIO = 0.16
"""The beam of a drawn hull, in lengths [1]."""


def draw_turning_circles(results: TrialResults) -> Figure:
    """Draw the tracks of both turning circles in lengths, with advance, transfer and diameter."""
    starboard, length = results.turns[0], results.turn_runs[0].track.length
    width = (starboard.tactical_diameter or length) / length
    is_wide = width > MIN_WIDTH
    with styled_figure(TRACK_SIZE) as figure:
        axes = figure.subplots()
        for run, turn, colour in zip(
            results.turn_runs, results.turns, (STARBOARD, PORT), strict=True
        ):
            track = run.track
            advances, transfers = _course_in_lengths(track)
            side = "starboard" if turn.yaw_rate > 0.0 else "port"
            axes.plot(
                transfers, advances, color=colour, linewidth=1.2,
                label=f"rudder {abs(math.degrees(turn.rudder)):.1f}° to {side}",
            )  # fmt: skip
            if is_wide:
                _draw_hulls(axes, track, colour)
        _draw_approach(axes, 0.2 * width)
        if is_wide:
            _draw_turn_dimensions(axes, starboard, length)
        else:
            _write_turn_numbers(axes, starboard, length)
        axes.set_aspect("equal", adjustable="datalim")
        axes.set_xlabel("transfer to starboard [L]")
        axes.set_ylabel("advance [L]")
        axes.legend(frameon=False, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)
    return figure


def draw_zigzags(results: TrialResults) -> Figure:
    """Draw heading and rudder over time of both zig-zags, with the overshoots."""
    with styled_figure(WIDE_SIZE) as figure:
        panels = figure.subplots(1, 2, sharey=True)
        for axes, run, zigzag, name in zip(
            panels, results.zigzag_runs, results.zigzags, ("10°/10°", "20°/20°"), strict=True
        ):
            _draw_zigzag(axes, run.track, zigzag)
            rudder = math.degrees(zigzag.rudder)
            actual = f"{rudder:.3g}°/{math.degrees(zigzag.heading):.3g}°"
            text = name if actual == name else f"{name}, rudder at its limit of {rudder:.1f}°"
            axes.set_title(f"zig-zag {text}", fontsize=9)
            axes.set_xlabel("time [s]")
        panels[0].set_ylabel("angle [°], positive to starboard")
        panels[0].legend(frameon=False, fontsize=7.5, loc="lower left", ncols=2)
        low, high = panels[0].get_ylim()
        panels[0].set_ylim(low - 0.2 * (high - low), high + 0.08 * (high - low))
    return figure


def draw_spiral(results: TrialResults) -> Figure:
    """Draw the yaw rate over the rudder angle, of the direct and the reverse spiral."""
    spiral = results.spiral
    rudders = np.degrees([point.rudder for point in spiral.points])
    rates = np.degrees([point.yaw_rate for point in spiral.points])
    middle = int(rudders.argmin()) + 1
    with styled_figure((5.6, 3.9)) as figure:
        axes = figure.subplots()
        axes.axhline(0.0, color=GREY, linewidth=0.6)
        axes.axvline(0.0, color=GREY, linewidth=0.6)
        if spiral.reverse_points:
            axes.plot(
                np.degrees([point.rudder for point in spiral.reverse_points]),
                np.degrees([point.yaw_rate for point in spiral.reverse_points]),
                color=INK, linestyle=(0, (4, 2)), linewidth=1.0, marker="D", markersize=3,
                label="reverse spiral",
            )  # fmt: skip
        axes.plot(
            rudders[:middle], rates[:middle], color=STARBOARD, marker="<", markersize=4,
            linewidth=1.2, label="direct spiral, rudder towards port",
        )  # fmt: skip
        axes.plot(
            rudders[middle - 1 :], rates[middle - 1 :], color=PORT, marker=">", markersize=4,
            linewidth=1.2, label="direct spiral, rudder towards starboard",
        )  # fmt: skip
        axes.set_xlabel("rudder angle δ [°], positive to starboard")
        axes.set_ylabel("steady yaw rate r [°/s]")
        axes.legend(frameon=False, fontsize=7.5, loc="upper left")
        low, high = axes.get_ylim()
        axes.set_ylim(low, high + 0.25 * (high - low))
        if spiral.loop_width:
            text = (
                f"loop {math.degrees(spiral.loop_width):.1f}° wide "
                f"(± {math.degrees(spiral.resolution):.1f}°),\n"
                f"{math.degrees(spiral.loop_height or 0.0):.1f} °/s high"
            )
            axes.annotate(
                text, (0.97, 0.05), xycoords="axes fraction", ha="right", va="bottom", fontsize=8
            )
    return figure


def draw_stop(results: TrialResults) -> Figure:
    """Draw the speed over time in the crash stop, and the yaw rates of the pull-outs."""
    with styled_figure(WIDE_SIZE) as figure:
        left, right = figure.subplots(1, 2)
        track = results.stop_run.track
        begin = max(0, track.start - int(0.15 * (len(track.times) - track.start)))
        left.plot(track.times[begin:], track.surge[begin:], color=PALETTE[0])
        left.axhline(0.0, color=GREY, linewidth=0.6)
        left.axvline(0.0, color=GREY, linewidth=0.6, linestyle=(0, (4, 2)))
        left.set_xlabel("time from the order full astern [s]")
        left.set_ylabel("speed ahead [m/s]")
        left.set_title("crash stop", fontsize=9)
        reach, time = results.stop.track_reach, results.stop.time
        if reach is not None and time is not None:
            left.plot([time], [0.0], "o", color=PALETTE[1], markersize=5)
            left.annotate(
                f"stops after {time:.3g} s\nand {reach / track.length:.2g} L",
                (0.97, 0.95), xycoords="axes fraction", ha="right", va="top", fontsize=8,
            )  # fmt: skip
        names = ("after a turn to starboard", "after a turn to port")
        for run, colour, name in zip(results.pull_out_runs, (STARBOARD, PORT), names, strict=True):
            is_shown = run.track.times >= -0.3 * run.track.times[-1]
            right.plot(
                run.track.times[is_shown], np.degrees(run.track.yaw_rates[is_shown]), color=colour,
                label=name,
            )  # fmt: skip
        right.axhline(0.0, color=GREY, linewidth=0.6)
        right.axvline(0.0, color=GREY, linewidth=0.6, linestyle=(0, (4, 2)))
        right.set_xlabel("time from the order rudder neutral [s]")
        right.set_ylabel("yaw rate [°/s]")
        right.set_title("pull-out", fontsize=9)
        right.legend(frameon=False, fontsize=7.5, loc="upper right")
        low, high = right.get_ylim()
        right.set_ylim(low, high + 0.25 * (high - low))
    return figure


def _course_in_lengths(track: ManoeuvreTrack) -> tuple[Array, Array]:
    """Return the positions along and to starboard of the original course [L]."""
    course = track.course / track.length
    return course[:, 0], course[:, 1]


def _draw_approach(axes: Axes, distance: float) -> None:
    axes.plot([0.0, 0.0], [-distance, 0.0], color=INK, linewidth=1.0)
    axes.plot([0.0], [0.0], "o", color=INK, markersize=4)
    axes.annotate(
        "rudder ordered", (0.0, 0.0), xytext=(6, -10), textcoords="offset points", fontsize=7.5
    )


def _draw_hulls(axes: Axes, track: ManoeuvreTrack, colour: str) -> None:
    """Draw outlines of the hull along the first circle, one length long."""
    advances, transfers = _course_in_lengths(track)
    heading_change = track.heading_change
    first_circle = np.flatnonzero(np.abs(heading_change) <= 2.0 * math.pi)
    outline = 0.5 * np.array([[1.0, 0.0], [0.6, 1.0], [-1.0, 1.0], [-1.0, -1.0], [0.6, -1.0]])
    outline[:, 1] *= BEAM_RATIO
    for k in np.linspace(0, len(first_circle) - 1, N_HULLS).astype(int)[1:-1]:
        i = int(first_circle[k])
        c, s = math.cos(heading_change[i]), math.sin(heading_change[i])
        x = advances[i] + outline[:, 0] * c - outline[:, 1] * s
        y = transfers[i] + outline[:, 0] * s + outline[:, 1] * c
        axes.fill(y, x, facecolor="white", edgecolor=colour, linewidth=0.8, zorder=3)


def _draw_turn_dimensions(axes: Axes, turn: TurningCircle, length: float) -> None:
    """Draw advance, transfer and tactical diameter of the turn to starboard as dimension lines."""
    if turn.advance is None or turn.tactical_diameter is None or turn.transfer is None:
        return
    advance, transfer = turn.advance / length, turn.transfer / length
    diameter = turn.tactical_diameter / length
    arrow = {"arrowstyle": "<->", "color": INK, "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0}
    corner = (0.0, advance)
    for begin, end, text, place, offset, ha in (
        ((0.0, 0.0), corner, f"advance {advance:.2f} L", corner, (-3, 2), "right"),
        (corner, (transfer, advance), f"transfer {transfer:.2f} L", corner, (4, 3), "left"),
        (
            (0.0, 0.0), (diameter, 0.0), f"tactical diameter {diameter:.2f} L",
            (0.5 * diameter, 0.0), (0, 3), "center",
        ),
    ):  # fmt: skip
        axes.annotate("", begin, end, arrowprops=arrow)
        axes.annotate(
            text, place, xytext=offset, textcoords="offset points", fontsize=7.5, ha=ha,
            va="bottom", zorder=4,
            bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 0.8},
        )  # fmt: skip


def _write_turn_numbers(axes: Axes, turn: TurningCircle, length: float) -> None:
    """Write advance, transfer and tactical diameter into a corner, for a turn on the spot."""
    names = ("advance", "transfer", "tactical_diameter")
    values = [(name.replace("_", " "), getattr(turn, name)) for name in names]
    text = "\n".join(
        f"{name} {value / length:.2f} L" for name, value in values if value is not None
    )
    axes.annotate(text, (0.98, 0.03), xycoords="axes fraction", ha="right", va="bottom", fontsize=8)


def _draw_zigzag(axes: Axes, track: ManoeuvreTrack, zigzag: ZigZag) -> None:
    times = track.run_times
    axes.axhline(0.0, color=GREY, linewidth=0.6)
    axes.plot(
        times, np.degrees(track.heading_change), color=PALETTE[0], label="change of heading ψ"
    )
    axes.step(
        times, np.degrees(track.rudders[track.start :]), where="post", color=PALETTE[1],
        linewidth=1.1, label="rudder δ",
    )  # fmt: skip
    heading = math.degrees(zigzag.heading)
    for level in (-heading, heading):
        axes.axhline(level, color=GREY, linewidth=0.6, linestyle=(0, (4, 2)))
    arrow = {"arrowstyle": "<->", "color": INK, "linewidth": 0.7, "shrinkA": 0, "shrinkB": 0}
    for overshoot in zigzag.overshoots[:3]:
        peak, side = math.degrees(overshoot.peak), math.copysign(1.0, overshoot.peak)
        axes.annotate(
            "", (overshoot.peak_time, side * heading), (overshoot.peak_time, peak),
            arrowprops=arrow,
        )  # fmt: skip
        axes.annotate(
            f"{math.degrees(overshoot.angle):.1f}°",
            (overshoot.peak_time, peak),
            xytext=(0, 3 * side),
            textcoords="offset points",
            ha="center",
            va="bottom" if side > 0 else "top",
            fontsize=7.5,
        )

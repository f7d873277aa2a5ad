"""The tracks of vehicles and loose objects, seen from above.

Each panel is a level with all seeds. The axes are x and y of the world frame W, with equal scales.
A circle marks the start of a vehicle's track in the level, a cross its end.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ...errors import ResultError
from ...results.journal import recorded_trials, track_path
from ...results.motion.motion_track import MotionTrack, load_track
from ...results.result import Result
from .panels import choose_evenly, choose_panels
from .style import INK, PALETTE, escape, shorten_name, styled_figure, write_note
from .time_plots import level_title

Array = npt.NDArray[np.float64]
Level = tuple[float, ...]

MAX_TRIALS = 120
"""The greatest number of trials that are read; of more trials, evenly chosen ones."""
MAX_POINTS = 600
"""The greatest number of points of a line."""
MIN_MOTION = 0.02
"""The minimum extent of the motion of a vehicle for which tracks are drawn [m]."""
OBJECT_MARKER = "s"


@dataclass(frozen=True, kw_only=True, eq=False)
class Track:
    """The path of a body in one level, from above."""

    body: str
    """The name of the vehicle or object."""
    is_vehicle: bool
    """True if the body is a vehicle."""
    points: Array
    """The positions x and y in the world frame W, (n, 2) [m]."""


def read_tracks(result: Result, directory: Path) -> dict[Level, list[Track]]:
    """Return the tracks of each level from the motion of the trials; damaged files are omitted."""
    trials = choose_evenly(recorded_trials(directory), MAX_TRIALS)
    names = [column.name for column in result.columns_of_kind("level")]
    tracks: dict[Level, list[Track]] = {}
    for index in trials:
        try:
            track = load_track(track_path(directory, index))
        except ResultError:
            continue
        for level in track.levels:
            if set(level.values) == set(names):
                key = tuple(level.values[name] for name in names)
                frames = _frames(track, level.start_time, level.duration)
                tracks.setdefault(key, []).extend(_tracks(track, frames))
    return dict(sorted(tracks.items()))


def track_plot(result: Result, tracks: Mapping[Level, Sequence[Track]]) -> Figure | None:
    """Draw the tracks of each level; None if no vehicle moves."""
    vehicle_tracks = [t for group in tracks.values() for t in group if t.is_vehicle]
    if not any(_extent(track) >= MIN_MOTION for track in vehicle_tracks):
        return None
    panels = choose_panels(tracks, is_square=True)
    shown_tracks = [track for level in panels.levels for track in tracks[level]]
    colours = _colours(track.body for track in shown_tracks)
    with styled_figure(panels.size) as figure:
        grid = panels.axes(figure, sharex=False, sharey=False)
        limits = _limits(shown_tracks)
        for axes, level in zip(grid, panels.levels, strict=True):
            for track in tracks[level]:
                _draw(axes, track, colours[track.body], len(tracks[level]))
            axes.set_aspect("equal")
            axes.set(xlim=limits[0], ylim=limits[1])
            axes.set_title(escape(level_title(result, level)), fontsize=8, loc="left", color=INK)
        handles = list(_legend(shown_tracks, colours))
        figure.legend(handles=handles, loc="outside upper right", ncols=4, fontsize=7.5)
        n_seeds = len({row[0] for row in result.rows}) if result.columns_of_kind("run") else 1
        seeds = f"; {n_seeds} seeds in each panel" if n_seeds > 1 else ""
        write_note(figure, f"from above, world frame (z up){seeds}", panels.note)
        panels.label(grid, "x [m]", "y [m]")
    return figure


def _frames(track: MotionTrack, start_time: float, duration: float) -> slice:
    first_frame = max(0, round(start_time * track.rate))
    return slice(first_frame, max(first_frame + 1, round((start_time + duration) * track.rate) + 1))


def _tracks(track: MotionTrack, frames: slice) -> Iterator[Track]:
    """Yield the path of the first link of each vehicle, and of each object."""
    vehicles: set[str] = set()
    for index, name in enumerate(track.bodies):
        vehicle, slash, _ = name.partition("/")
        if vehicle in vehicles:
            continue
        vehicles |= {vehicle} if slash else set()
        points = track.poses[frames, index, :2]
        points = points[np.isfinite(points).all(axis=1)]
        step = max(1, len(points) // MAX_POINTS)
        if len(points):
            points = np.concatenate([points[::step], points[-1:]])
            yield Track(body=vehicle, is_vehicle=bool(slash), points=points)


def _extent(track: Track) -> float:
    """Return the longer side of the box around a track [m]."""
    return float(np.ptp(track.points, axis=0).max())


def _limits(tracks: Sequence[Track]) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the limits of x and y [m]: a square around vehicles' tracks and nearby objects."""
    vehicles = np.concatenate([track.points for track in tracks if track.is_vehicle])
    middle = 0.5 * (vehicles.min(axis=0) + vehicles.max(axis=0))
    reach = max(float(np.ptp(vehicles, axis=0).max()), 0.5)
    near = [t.points for t in tracks if np.abs(t.points - middle).max() < 3.0 * reach]
    points = np.concatenate([vehicles, *near])
    low, high = points.min(axis=0), points.max(axis=0)
    middle, half = 0.5 * (low + high), 0.55 * float((high - low).max()) + 0.02
    x, y = ((float(c - half), float(c + half)) for c in middle)
    return x, y


def _draw(axes: Axes, track: Track, colour: str, n_tracks: int) -> None:
    x, y = track.points[:, 0], track.points[:, 1]
    alpha = 0.9 if n_tracks <= 4 else 0.55
    axes.plot(x, y, color=colour, linewidth=1.0, alpha=alpha, zorder=3 if track.is_vehicle else 2.5)
    begin, end = ("o", "x") if track.is_vehicle else (OBJECT_MARKER, "+")
    axes.plot(x[:1], y[:1], begin, color=colour, markerfacecolor="white", markersize=4, zorder=4)
    if _extent(track) >= MIN_MOTION:
        axes.plot(x[-1:], y[-1:], end, color=colour, markersize=5, mew=1.3, zorder=4)


def _colours(bodies: Iterable[str]) -> dict[str, str]:
    names = dict.fromkeys(bodies)
    return {name: PALETTE[i % len(PALETTE)] for i, name in enumerate(names)}


def _legend(tracks: Sequence[Track], colours: Mapping[str, str]) -> Iterator[Line2D]:
    """Yield the entries of the legend: each body, and the markers of begin and end."""
    kinds = {track.body: track.is_vehicle for track in tracks}
    for name, is_vehicle in kinds.items():
        yield Line2D(
            [], [], color=colours[name], marker="" if is_vehicle else OBJECT_MARKER, markersize=4,
            markerfacecolor="white", label=escape(shorten_name(name, 24)),
        )  # fmt: skip
    yield Line2D([], [], color=INK, linestyle="", marker="o", markerfacecolor="white",
                 markersize=4, label="begin")  # fmt: skip
    yield Line2D([], [], color=INK, linestyle="", marker="x", markersize=5, label="end")

"""Plots of what happens within levels: measures over time with quantiles, tracks from above."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.support.synthetic_results import one_level_result, visibility_result
from uwsim.analysis.plots import INK, draw_run_plots
from uwsim.analysis.plots.one_level import one_level_plot
from uwsim.analysis.plots.panels import MAX_PANELS, choose_panels
from uwsim.analysis.plots.time_plots import samples_of, time_plot
from uwsim.analysis.plots.track_plot import read_tracks, track_plot
from uwsim.analysis.report import render
from uwsim.results.log import Log, save_log
from uwsim.results.motion.motion_track import TrackLevel, quantise, steps_of, track_bytes
from uwsim.results.result import Result

LEVELS = (0.0, 0.05, 1.2)


def log_of(seeds: tuple[int, ...], *, levels: tuple[float, ...] = LEVELS) -> Log:
    """Samples every 0.5 s for 2 s, levels one after the other: seed + time in the level."""
    several = len(seeds) > 1
    header = ("repeat", "seed") if several else ()
    samples = [
        (*((repeat, seed) if several else ()), fog, 2.0 * i + t, seed + t, 0.0)
        for repeat, seed in enumerate(seeds)
        for i, fog in enumerate(levels)
        for t in (0.0, 0.5, 1.0, 1.5)
    ]
    names = (*header, "fog [1/m]", "time [s]", "total [px]", "x [px]")
    return Log(measure="corners", header=names, samples=tuple(samples))


def test_samples_are_gathered_by_level_and_seed_with_the_time_in_the_level() -> None:
    found = samples_of(visibility_result(seeds=(1, 2, 5)), log_of((1, 2, 5)))
    assert list(found) == [(fog,) for fog in LEVELS]
    for each in found.values():
        np.testing.assert_allclose(each.times, [0.0, 0.5, 1.0, 1.5])
        np.testing.assert_allclose(each.values, np.add.outer([1, 2, 5], [0.0, 0.5, 1.0, 1.5]))


def test_the_line_is_the_median_of_the_seeds_and_the_bands_are_quantiles() -> None:
    seeds = (1, 2, 3, 4, 90)
    figure = time_plot(visibility_result(seeds=seeds), log_of(seeds))
    assert figure is not None
    assert [axes.get_title(loc="left") for axes in figure.axes] == [
        "fog 0 m⁻¹",
        "fog 0.05 m⁻¹",
        "fog 1.2 m⁻¹",
    ]
    axes = figure.axes[0]
    median = axes.lines[0].get_ydata()
    np.testing.assert_allclose(median, [3.0, 3.5, 4.0, 4.5])
    outer, inner = (band.get_paths()[0].vertices[:, 1] for band in axes.collections[:2])
    assert inner.min() == pytest.approx(2.0)
    assert outer.max() == pytest.approx(1.5 + np.quantile(seeds, 0.95))


@pytest.mark.parametrize(("seeds", "lines"), [((4,), 1), ((4, 5), 3), ((1, 2, 3, 4), 5)])
def test_few_seeds_are_a_line_each_and_have_no_bands(seeds: tuple[int, ...], lines: int) -> None:
    figure = time_plot(visibility_result(seeds=seeds), log_of(seeds))
    assert figure is not None
    drawn = [line for line in figure.axes[0].lines if len(line.get_xdata()) == 4]
    assert len(drawn) == lines
    assert not figure.axes[0].collections


def test_a_seed_that_ends_early_leaves_the_others() -> None:
    log = log_of((1, 2))
    cut = replace(log, samples=tuple(s for s in log.samples if s[1] == 1 or s[3] % 2.0 < 0.75))
    (found, *_) = samples_of(visibility_result(seeds=(1, 2)), cut).values()
    assert np.isnan(found.values[1, 2:]).all()
    figure = time_plot(visibility_result(seeds=(1, 2)), cut)
    assert figure is not None
    np.testing.assert_allclose(figure.axes[0].lines[-2].get_ydata(), [1.5, 2.0, 2.0, 2.5])


def test_a_log_without_any_value_or_of_another_benchmark_has_no_plot() -> None:
    log = log_of((1,))
    empty = replace(log, samples=tuple((*s[:2], None, None) for s in log.samples))
    assert time_plot(visibility_result(), empty) is None
    assert time_plot(one_level_result(), log) is None
    assert time_plot(visibility_result(), Log(measure="corners", header=("time [s]",))) is None


def test_a_log_of_zeros_has_no_plot() -> None:
    log = log_of((1, 2))
    zeros = tuple((*sample[:-2], 0.0, 0.0) for sample in log.samples)
    assert time_plot(visibility_result(seeds=(1, 2)), replace(log, samples=zeros)) is None
    once = ((*zeros[0][:-2], 1.0, 0.0), *zeros[1:])
    assert time_plot(visibility_result(seeds=(1, 2)), replace(log, samples=once)) is not None


def test_of_many_levels_some_are_chosen_with_the_first_and_the_last() -> None:
    shown = choose_panels([(float(i),) for i in range(27)])
    assert len(shown.levels) == MAX_PANELS
    assert (shown.levels[0], shown.levels[-1]) == ((0.0,), (26.0,))
    assert shown.note == "6 of 27 levels, evenly chosen"
    assert choose_panels([(1.0,)]).note == ""


def write_track(directory: Path, index: int, way: np.ndarray, fog: float = 0.0) -> None:
    """A trial of 2 s, of which the last is a level: a vehicle with an arm, and an object."""
    names = ("rov/base", "rov/arm", "box")
    frames = len(way)
    poses = np.zeros((frames, len(names), 7))
    poses[..., 3] = 1.0
    poses[:, 0, :2] = way
    poses[:, 1, :2] = way + 0.3
    poses[:, 2, :2] = (0.5, 0.25)
    table = quantise(poses.reshape(frames, -1), steps_of(len(names), ()))
    level = TrackLevel(values={"fog": fog}, start_time=1.0, duration=1.0, status="ok")
    path = directory / "units" / f"{index:05d}.motion"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(track_bytes(names, (), table, [level], rate=10.0))


def line(length: float) -> np.ndarray:
    """21 frames; 0.5 s beyond the begin at x = 1 ... and y rising."""
    way = np.zeros((21, 2))
    way[:10, 0] = -5.0  # before the level
    way[10:, 0] = 1.0
    way[10:, 1] = np.linspace(0.0, length, 11)
    return way


def test_a_track_is_that_of_the_vehicle_within_the_level_and_objects_stand_in_it(
    tmp_path: Path,
) -> None:
    result = visibility_result(seeds=(1, 2))
    for index, length in enumerate((0.8, 1.2)):
        write_track(tmp_path, index, line(length))
    tracks = read_tracks(result, tmp_path)
    assert list(tracks) == [(0.0,)]
    vehicles = [track for track in tracks[0.0,] if track.is_vehicle]
    assert [track.body for track in tracks[0.0,]] == ["rov", "box", "rov", "box"]
    np.testing.assert_allclose(vehicles[0].points[0], [1.0, 0.0], atol=1e-3)
    np.testing.assert_allclose(vehicles[1].points[-1], [1.0, 1.2], atol=1e-3)
    figure = track_plot(result, tracks)
    assert figure is not None
    (axes,) = figure.axes
    assert axes.get_aspect() == 1.0
    assert np.ptp(axes.get_xlim()) == pytest.approx(np.ptp(axes.get_ylim()))
    assert axes.get_ylim()[0] < 0.0
    assert axes.get_ylim()[1] > 1.2
    assert [text.get_text() for text in figure.legends[0].get_texts()] == [
        "rov",
        "box",
        "begin",
        "end",
    ]


def test_a_vehicle_at_rest_and_a_damaged_track_have_no_plot(tmp_path: Path) -> None:
    write_track(tmp_path, 0, line(0.001))
    (tmp_path / "units" / "00001.motion").write_bytes(b"not a track")
    assert track_plot(visibility_result(), read_tracks(visibility_result(), tmp_path)) is None


def saved(directory: Path, seeds: tuple[int, ...]) -> Result:
    result = visibility_result(seeds=seeds)
    save_log(log_of(seeds), directory)
    write_track(directory, 0, line(1.0))
    return result


def test_plots_of_a_run_have_captions_and_the_same_bytes_every_time(tmp_path: Path) -> None:
    result = saved(tmp_path, (1, 2, 3, 4, 5, 6))
    plots = draw_run_plots(result, tmp_path, tmp_path / "a")
    assert [plot.path.name for plot in plots] == ["corners-over-time.png", "track.png"]
    assert plots[0].measure == "corners"
    assert "median of 6 seeds" in plots[0].caption
    again = draw_run_plots(result, tmp_path, tmp_path / "b")
    for one, other in zip(plots, again, strict=True):
        assert one.path.read_bytes() == other.path.read_bytes()


def of_one_level(seeds: tuple[int, ...]) -> Result:
    """The first level of a sweep, over several seeds."""
    result = visibility_result(seeds=seeds)
    level = result.index("fog")
    rows = tuple(row for row in result.rows if row[level] == 0.0)
    return replace(result, rows=rows, missing_values=())


@pytest.mark.parametrize(("n", "has_box"), [(2, False), (6, True)])
def test_one_level_is_a_row_for_each_column_with_a_point_for_each_repeat(
    n: int, has_box: bool
) -> None:
    result = of_one_level(tuple(range(1, n + 1)))
    figure = one_level_plot(result)
    assert figure is not None
    names = [axes.get_ylabel() for axes in figure.axes]
    assert names == ["total [px]", "corners [px]", "centroid [px]"]
    for axes, column in zip(figure.axes, ("total", "corners", "centroid"), strict=True):
        points = next(line for line in axes.lines if line.get_alpha() == 0.55)
        assert sorted(points.get_xdata()) == pytest.approx(sorted(result.numbers(column)))
        assert any(line.get_color() == INK for line in axes.lines) == has_box


def test_a_report_of_one_level_has_no_curves_but_its_repeats(tmp_path: Path) -> None:
    result = of_one_level((1, 2, 3))
    plots = draw_run_plots(result, tmp_path, tmp_path / "plots")
    assert [plot.path.name for plot in plots] == ["repeats.png"]
    curve = tmp_path / "total.png"
    curve.write_bytes(plots[0].path.read_bytes())
    page = render(result, tmp_path, plots=[curve], run_plots=plots)
    assert "<h2>Curves</h2>" not in page
    assert "The repeats; dots: repeats" in page
    whole = visibility_result(seeds=(1, 2))
    assert not draw_run_plots(whole, tmp_path, tmp_path / "plots")
    assert "<h2>Curves</h2>" in render(whole, tmp_path, plots=[curve])

"""Synthetic floors have the statistics that they were asked for, and statistics are right."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from uwsim.bathymetry.chart_statistics import compute_statistics
from uwsim.bathymetry.height_grid import HeightGrid
from uwsim.bathymetry.picture import draw_chart, shaded_relief
from uwsim.bathymetry.synthetic import SyntheticFloor, make_floor, rough_surface
from uwsim.errors import BadSetting, UwsimError

FLOOR = SyntheticFloor(width=400.0, height=300.0, spacing=1.0, roughness=0.7, seed=5)


def grid_of(floor: SyntheticFloor) -> HeightGrid:
    chart = make_floor(floor)
    return HeightGrid(west=chart.x, south=chart.y, spacing=chart.step_x, heights=chart.heights)


@pytest.mark.parametrize("exponent", [2.0, 3.25, 4.0])
def test_a_floor_has_the_exponent_and_the_rms_that_were_asked_for(exponent: float) -> None:
    floor = replace(FLOOR, exponent=exponent, corner=2000.0)
    surface = rough_surface(floor)
    assert surface.shape == (301, 401)
    assert math.sqrt(float((surface**2).mean())) == pytest.approx(0.7)
    found = compute_statistics(grid_of(floor)).exponent
    assert found == pytest.approx(exponent, abs=0.2)


def test_a_seed_makes_the_same_floor_and_another_seed_another() -> None:
    first, same = make_floor(FLOOR), make_floor(FLOOR)
    np.testing.assert_array_equal(first.heights, same.heights)
    other = make_floor(replace(FLOOR, seed=6))
    assert abs(np.corrcoef(first.heights.ravel(), other.heights.ravel())[0, 1]) < 0.5
    assert (first.x, first.y) == (-200.0, -150.0)


def test_channels_are_below_and_rocks_above_the_floor() -> None:
    flat = replace(FLOOR, roughness=0.0, depth=20.0)
    np.testing.assert_array_equal(make_floor(flat).heights, np.float32(-20.0))
    channels = make_floor(replace(flat, channels=2, channel_depth=3.0)).heights
    assert channels.max() == pytest.approx(-20.0, abs=1e-2)
    assert -26.1 < channels.min() < -22.9
    rocks = make_floor(replace(flat, rocks=10.0, rock_size=8.0)).heights
    assert rocks.min() == -20.0
    assert 0.6 * 2.0 * 0.8 < rocks.max() + 20.0 < 2 * 0.6 * 8.0
    assert 0.01 < (rocks > -20.0).mean() < 0.1  # 120 rocks of some 15 m2 on 12 hectares


def test_a_plane_and_a_sine_have_the_statistics_of_their_formulas() -> None:
    x, y = np.arange(200.0), np.arange(160.0)
    plane = (3.0 + 0.3 * x[None] - 0.4 * y[:, None]).astype(np.float32)
    statistics = compute_statistics(HeightGrid(west=0, south=0, spacing=1.0, heights=plane))
    assert statistics.mean_slope == pytest.approx(math.degrees(math.atan(0.5)), abs=1e-4)
    assert statistics.rms_slope == pytest.approx(statistics.mean_slope, abs=1e-3)
    assert statistics.rms_height < 1e-4
    x = np.arange(201.0)  # whole periods of differences
    sine = np.tile(2.0 * np.sin(2.0 * math.pi * x / 50.0), (160, 1)).astype(np.float32)
    statistics = compute_statistics(HeightGrid(west=0, south=0, spacing=1.0, heights=sine))
    slope = math.sqrt(0.5) * 2.0 * 2.0 * math.sin(math.pi / 50.0)  # of differences
    assert statistics.rms_slope == pytest.approx(math.degrees(math.atan(slope)), rel=1e-5)
    assert (statistics.least_height, statistics.greatest_height) == pytest.approx((-2, 2), abs=0.01)


def test_a_slope_towards_the_light_is_bright() -> None:
    x = np.arange(9.0)
    to_west, to_east = np.tile(0.5 * x, (9, 1)), np.tile(-0.5 * x, (9, 1))
    assert shaded_relief(to_west, 1.0)[4, 4] > shaded_relief(0.0 * to_west, 1.0)[4, 4]
    assert shaded_relief(to_east, 1.0)[4, 4] < shaded_relief(0.0 * to_east, 1.0)[4, 4]


def test_a_picture_has_the_heights_of_the_chart() -> None:
    axes = draw_chart(grid_of(replace(FLOOR, width=60.0, height=40.0)), "bay").axes[0]
    assert axes.get_xlim() == (-30.0, 30.0)
    assert axes.get_title() == "bay"


def test_a_floor_that_is_too_large_is_refused_before_it_is_made() -> None:
    with pytest.raises(UwsimError, match="expected 40000000 at most"):
        make_floor(replace(FLOOR, spacing=0.01))
    with pytest.raises(BadSetting, match="rocks; expected 1000000 at most"):
        make_floor(replace(FLOOR, rocks=1e9))

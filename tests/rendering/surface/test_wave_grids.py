from __future__ import annotations

import math

import numpy as np

from tests.rendering.surface.seas import make_waves
from uwsim.rendering.surface.ripples import draw_ripples
from uwsim.rendering.surface.wave_grids import GRAVITY, compute_grid, read_components


def test_a_grid_has_the_elevation_and_the_slopes_of_the_waves_that_move_bodies() -> None:
    waves, time, spacing, n = make_waves(0.5), 12.3, 0.2, 64
    c = read_components(waves, 1.0)
    columns = (c.amplitude, c.omega, c.kx, c.ky, c.phase)
    grid = compute_grid(columns, (3.0, -5.0), spacing, time, n)
    x, y = np.meshgrid(3.0 + spacing * np.arange(n), -5.0 + spacing * np.arange(n))
    points = np.stack([x.ravel(), y.ravel(), 0.0 * x.ravel()], axis=1)
    motion = waves.motion(points, time)
    np.testing.assert_allclose(grid[..., 0].ravel(), motion.elevation, atol=1e-6)
    np.testing.assert_allclose(grid[..., 1:3].reshape(-1, 2), motion.slope, atol=1e-6)
    step = 1e-3
    before, after = (waves.elevation(points, time + s) for s in (-step, step))
    fall = -(before - 2.0 * motion.elevation + after) / step**2 / GRAVITY
    np.testing.assert_allclose(grid[..., 3].ravel(), fall, atol=1e-4)


def test_ripples_have_slopes_of_variance_one_and_fit_into_their_tile() -> None:
    ripples = draw_ripples(np.random.Generator(np.random.Philox(1)), 0.3)
    columns = (ripples.amplitude, ripples.omega, ripples.kx, ripples.ky, ripples.phase)
    tile = compute_grid(columns, (0.0, 0.0), 5.3 / 128, 2.0, 128)
    variance = float(tile[..., 1].var() + tile[..., 2].var())
    assert abs(variance - 2.0) < 0.1
    shifted = compute_grid(columns, (5.3, -10.6), 5.3 / 128, 2.0, 128)
    np.testing.assert_allclose(shifted, tile, atol=1e-4)


def test_components_have_the_variance_of_slopes_of_their_sum() -> None:
    c = read_components(make_waves(1.0), 0.5)
    expected = 0.25 * float(((c.amplitude * np.hypot(c.kx, c.ky)) ** 2).sum())
    assert math.isclose(c.compute_slope_variance(), expected, rel_tol=1e-12)

"""Noise in space: fields that are continuous over a surface, wherever its texture is cut."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from uwsim.base import rng

Values = npt.NDArray[Any]
"""One value for each point, (...)."""
Points = npt.NDArray[Any]
"""Points (..., 3) [m]."""
SIDE = 32
"""The side of the periodic grid of random numbers."""
SHIFT = (11.3, 5.7, 23.9)
"""The shift of the grid from one octave to the next, which hides its axes [cells]."""


def noise3(
    name: str, points: Points, cell: float, *, octaves: int = 5, gain: float = 0.5
) -> Values:
    """Return smooth noise at points, of about zero mean and unit deviation.

    Args:
        name: the name of the random stream.
        points: the points, (..., 3) [m].
        cell: the side of the cells of the coarsest octave [m].
        octaves: the number of octaves, each with cells half as large as the one before.
        gain: the weight of each octave relative to the one before.
    """
    grid = rng.stream(0, f"assets/{name}").standard_normal((SIDE,) * 3, dtype=np.float32)
    total = np.zeros(points.shape[:-1], dtype=np.float32)
    weight, square_sum = 1.0, 0.0
    for octave in range(octaves):
        scale = np.float32(2.0**octave / cell)
        shift = np.array(SHIFT, dtype=np.float32) * np.float32(octave)
        total += np.float32(weight) * _interpolate(grid, points * scale + shift)
        square_sum += weight * weight
        weight *= gain
    return total * np.float32(1.55 / square_sum**0.5)


def ridges3(
    name: str, points: Points, cell: float, *, octaves: int = 4, gain: float = 0.5
) -> Values:
    """Return ridged noise, 0..1: 1 along curved surfaces, as of cracks and crests."""
    total = np.zeros(points.shape[:-1], dtype=np.float32)
    weight, weight_sum = 1.0, 0.0
    for octave in range(octaves):
        layer = noise3(f"{name}/{octave}", points, cell / 2.0**octave, octaves=1)
        total += np.float32(weight) * np.clip(1.0 - 1.4 * np.abs(layer), 0.0, 1.0)
        weight_sum += weight
        weight *= gain
    return total / np.float32(weight_sum)


def cells3(name: str, points: Points, cell: float, *, period: int = SIDE) -> tuple[Values, Values]:
    """Return the distance to the nearest of random points, in cells, and its random number, 0..1.

    There is one random point in each cube of a grid, which repeats after ``period`` cubes.
    """
    stream = rng.stream(0, f"assets/{name}")
    offsets = stream.random((SIDE, SIDE, SIDE, 3), dtype=np.float32)
    shades = stream.random((SIDE, SIDE, SIDE), dtype=np.float32)
    grid_points = points / np.float32(cell)
    base = np.floor(grid_points).astype(np.int32)
    least_square = np.full(points.shape[:-1], 9.0, dtype=np.float32)
    shade = np.zeros_like(least_square)
    corners = [base[..., k].copy() for k in range(3)]
    places = [offsets[..., k].ravel() for k in range(3)]
    for shift in np.ndindex(3, 3, 3):
        cube = [corners[k] + np.int32(shift[k] - 1) for k in range(3)]
        x, y, z = (cube[k] % period for k in range(3))
        index = (x * SIDE + y) * SIDE + z
        square = np.float32(0.0)
        for k in range(3):
            difference = cube[k] + places[k].take(index) - grid_points[..., k]
            square = square + difference * difference
        is_nearer = square < least_square
        least_square = np.where(is_nearer, square, least_square)
        shade = np.where(is_nearer, shades.ravel().take(index), shade)
    return np.sqrt(least_square), shade


def _interpolate(grid: Values, points: Points) -> Values:
    """Interpolate a periodic grid at points in units of its cells, smoothly."""
    base = np.floor(points)
    t = points - base
    t = t * t * (np.float32(3.0) - np.float32(2.0) * t)
    low = base.astype(np.int32) % SIDE
    high = (low + 1) % SIDE
    # Indices into the flat grid: three indices for each value take several times as long.
    (x0, y0, z0), (x1, y1, z1) = (
        [corner[..., axis] * stride for axis, stride in enumerate((SIDE * SIDE, SIDE, 1))]
        for corner in (low, high)
    )
    tx, ty, tz = (t[..., axis].copy() for axis in range(3))
    values = grid.ravel()

    def interpolate_edge(y: npt.NDArray[np.int32], z: npt.NDArray[np.int32]) -> Values:
        row = y + z
        first = values.take(x0 + row)
        edge: Values = first + (values.take(x1 + row) - first) * tx
        return edge

    near, far = interpolate_edge(y0, z0), interpolate_edge(y0, z1)
    near = near + (interpolate_edge(y1, z0) - near) * ty
    far = far + (interpolate_edge(y1, z1) - far) * ty
    result: Values = near + (far - near) * tz
    return result

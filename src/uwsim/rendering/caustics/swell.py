r"""The long waves of a scene in caustics: they shift and stretch the pattern of the short ones.

A ray from :math:`x` drifts by :math:`d\,(u(0) + M s(x))`, where :math:`s` is the sum of the slopes
of short and of long waves. The map of the short ones (`caustic_map`) is known. The long ones are
nearly even over a ray's drift, so that the gain at :math:`p`, relative to a level surface, is

.. math::
    G(p) = G_{short}(p - d\, w(p))\; \det\left(1 - d\, \nabla w(p)\right), \quad w = M s_{long}

This is a change of variables, so the mean light stays. It is the exact gain to the first order in
:math:`d\, \nabla w`, which is :math:`d\, k^2 a / 4` for a wave of the amplitude :math:`a`.

The waves longer than 2 m are known on a grid around the camera. Shorter ones join the ripples of
the tile, each with the nearest wave vector of its lattice. Waves shorter than 12.5 cm are left out.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.jit import njit
from ...base.numerics.linear import product
from ...base.numerics.memory import view_doubles
from ...waves import Waves
from ...waves import kernel as k
from .wave_tile import MAX_WAVE_LENGTH, MIN_WAVE_LENGTH, TILE_EDGE, TileWaves

N_POINTS = 40
"""The number of grid points along an edge."""
SPACING = 0.75
"""The distance of grid points [m]."""

FloatGrid = npt.NDArray[np.float32]


def read_columns(waves: Waves) -> Array:
    """Return the columns of the components in W, of unit scale (`waves.kernel`)."""
    record = waves.record[0]
    n = int(record["n"])
    columns: Array = view_doubles(int(record["columns"]), k.N_COLUMNS * n).reshape(k.N_COLUMNS, n)
    return columns


def find_short_waves(waves: Waves) -> TileWaves:
    """Return the components that a tile can have, with the nearest wave vectors of its lattice.

    The slopes of each remain: the amplitude is scaled by the ratio of the wave numbers.
    """
    columns = read_columns(waves)
    lengths = 2.0 * math.pi / columns[k.K]
    short_columns = columns[:, (lengths < MAX_WAVE_LENGTH) & (lengths >= MIN_WAVE_LENGTH)]
    unit = 2.0 * math.pi / TILE_EDGE
    i = np.rint(short_columns[k.KX] / unit).astype(np.int64)
    j = np.rint(short_columns[k.KY] / unit).astype(np.int64)
    return TileWaves(
        columns=i,
        rows=j,
        amplitude=short_columns[k.AMPLITUDE] * short_columns[k.K] / (unit * np.sqrt(i**2 + j**2)),
        angular_frequency=short_columns[k.OMEGA].copy(),
        phase=short_columns[k.PHASE].copy(),
    )


def compute_swell(
    waves: Waves, slope_matrix: Array, corner: tuple[float, float], time: float, scale: float
) -> FloatGrid:
    """Compute the drift by long waves and its derivatives on a grid.

    Args:
        waves: the waves of the scene.
        slope_matrix: the matrix M, (2, 2).
        corner: the first grid point in W [m].
        time: the simulation time [s].
        scale: the factor on all amplitudes.

    Returns:
        The drift w along x and y, and trace and determinant of its derivative, (rows y, columns x,
        4) [1, 1, 1/m, 1/m2].
    """
    columns = read_columns(waves)
    long_columns = columns[:, 2.0 * math.pi / columns[k.K] >= MAX_WAVE_LENGTH]
    phases = (
        long_columns[k.PHASE]
        + long_columns[k.KX] * corner[0]
        + long_columns[k.KY] * corner[1]
        - long_columns[k.OMEGA] * time
    )
    fields = np.zeros((5, N_POINTS, N_POINTS), np.float32)
    _add_waves(
        fields, scale * long_columns[k.AMPLITUDE], long_columns[k.KX], long_columns[k.KY], phases
    )
    m = slope_matrix
    slopes, (xx, xy, yy) = fields[:2], fields[2:]
    trace = m[0, 0] * xx + (m[0, 1] + m[1, 0]) * xy + m[1, 1] * yy
    determinant = (m[0, 0] * m[1, 1] - m[0, 1] * m[1, 0]) * (xx * yy - xy * xy)
    drift = product(slopes.reshape(2, -1).T.astype(np.float64), m.T)
    swell = np.empty((N_POINTS, N_POINTS, 4), np.float32)
    swell[..., :2] = drift.reshape(N_POINTS, N_POINTS, 2)
    swell[..., 2], swell[..., 3] = trace, determinant
    return swell


@njit
def _add_waves(
    fields: Any, amplitudes: Array, numbers_x: Array, numbers_y: Array, phases: Array
) -> None:
    """Add the slopes along x and y, and the second derivatives xx, xy, yy of waves on the grid."""
    n = fields.shape[1]
    cosines, sines = np.empty(n, np.float32), np.empty(n, np.float32)
    for wave in range(len(phases)):
        a, kx, ky = amplitudes[wave], numbers_x[wave], numbers_y[wave]
        slope_x, slope_y = np.float32(-a * kx), np.float32(-a * ky)
        xx, xy, yy = (
            np.float32(-a * kx * kx),
            np.float32(-a * kx * ky),
            np.float32(-a * ky * ky),
        )
        for column in range(n):
            cosines[column] = math.cos(kx * SPACING * column)
            sines[column] = math.sin(kx * SPACING * column)
        for row in range(n):
            angle = phases[wave] + ky * SPACING * row
            c, s = np.float32(math.cos(angle)), np.float32(math.sin(angle))
            row_fields = fields[:, row]
            for column in range(n):
                cosine = c * cosines[column] - s * sines[column]
                sine = s * cosines[column] + c * sines[column]
                row_fields[0, column] += slope_x * sine
                row_fields[1, column] += slope_y * sine
                row_fields[2, column] += xx * cosine
                row_fields[3, column] += xy * cosine
                row_fields[4, column] += yy * cosine

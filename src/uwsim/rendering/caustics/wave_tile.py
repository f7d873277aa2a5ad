r"""A square tile of a moving water surface that repeats without a seam, and its slopes.

The surface is the sum of waves whose wave vectors are those of a lattice,
:math:`k = 2 \pi (i, j) / L` with the edge :math:`L` of the tile:

.. math:: \eta = \sum a \cos(k \cdot x - \omega t + \varphi)

The slopes along x and y at the nodes of a grid are the real and the imaginary part of one inverse
Fourier transform. The tile begins at the origin of W, and its axes are those of W.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.jit import njit

TILE_EDGE = 8.0
"""The edge of the tile [m]."""
N_NODES = 256
"""The number of nodes along an edge."""
NODE_SPACING = TILE_EDGE / N_NODES
"""The distance of nodes [m]."""
MAX_WAVE_LENGTH = 2.0
"""The longest wave of the tile [m]; a quarter of its edge, so that directions are diverse."""
MIN_WAVE_LENGTH = 4.0 * NODE_SPACING
"""The shortest wave of the tile [m]."""

ComplexGrid = npt.NDArray[np.complex64]


@dataclass(frozen=True, kw_only=True, eq=False)
class TileWaves:
    """The waves of a tile; arrays are (n,)."""

    columns: npt.NDArray[np.int64]
    """The number i of waves along x in the tile, which may be negative."""
    rows: npt.NDArray[np.int64]
    """The number j of waves along y."""
    amplitude: Array
    """The amplitudes [m]."""
    angular_frequency: Array
    """The angular frequencies [rad/s]."""
    phase: Array
    """The phases at the origin of W at time 0 [rad]."""

    @property
    def mean_square_slope(self) -> float:
        """The variance of the slopes along x and y together [1]."""
        numbers = (2.0 * math.pi / TILE_EDGE) ** 2 * (self.columns**2 + self.rows**2)
        return 0.5 * float(np.sum(self.amplitude**2 * numbers))

    def join(self, other: TileWaves) -> TileWaves:
        """Return these waves and others."""
        return TileWaves(
            columns=np.concatenate([self.columns, other.columns]),
            rows=np.concatenate([self.rows, other.rows]),
            amplitude=np.concatenate([self.amplitude, other.amplitude]),
            angular_frequency=np.concatenate([self.angular_frequency, other.angular_frequency]),
            phase=np.concatenate([self.phase, other.phase]),
        )

    def scale(self, factor: float) -> TileWaves:
        """Return waves with the amplitudes times a factor."""
        return TileWaves(
            columns=self.columns,
            rows=self.rows,
            amplitude=factor * self.amplitude,
            angular_frequency=self.angular_frequency,
            phase=self.phase,
        )

    def compute_slopes(self, time: float, slopes: ComplexGrid) -> None:
        """Compute the slopes at the nodes: along x + i along y [1].

        Args:
            time: the simulation time [s].
            slopes: the array of the slopes, (rows y, columns x).
        """
        slopes[:] = 0.0
        _fill_spectrum(
            slopes,
            self.columns,
            self.rows,
            self.amplitude * (math.pi * N_NODES**2 / TILE_EDGE),
            self.phase - self.angular_frequency * time,
        )
        fft: Any = np.fft  # its types know no single precision
        fft.ifft(slopes, axis=0, out=slopes)
        fft.ifft(slopes, axis=1, out=slopes)


@njit
def _fill_spectrum(
    spectrum: ComplexGrid,
    columns: npt.NDArray[np.int64],
    rows: npt.NDArray[np.int64],
    half_slopes: Array,
    phases: Array,
) -> None:
    """Add waves to the spectrum of slope along x + i slope along y.

    With A = a exp(i phase), the wave adds (i kx - ky) A / 2 at k and (-i kx + ky) A* / 2 at -k.
    """
    n = len(spectrum)
    for wave in range(len(phases)):
        i, j = columns[wave], rows[wave]
        real_part = half_slopes[wave] * math.cos(phases[wave])
        imaginary_part = half_slopes[wave] * math.sin(phases[wave])
        spectrum[j % n, i % n] += complex(
            -i * imaginary_part - j * real_part, i * real_part - j * imaginary_part
        )
        spectrum[-j % n, -i % n] += complex(
            -i * imaginary_part + j * real_part, -i * real_part - j * imaginary_part
        )

"""Echoes of rays in bins of range, compiled."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ...numerics.jit import njit

Array = npt.NDArray[np.float64]
Singles = npt.NDArray[np.float32]
Whole = npt.NDArray[np.int32]
GRAZING = 0.02
"""Least cosine of an angle of incidence that counts: 88.9 degrees."""


@njit
def add_echoes(
    power: Singles,
    hits: tuple[Array, Array, Whole],
    directions: Array,
    rows: Array,
    materials: Array,
    bins: tuple[float, float, float],
) -> None:
    r"""Add the power of the echo of each ray to the bins of range that it covers.

    A ray of the solid angle :math:`d\Omega` that meets a surface at the range r and the angle
    :math:`\theta` to its normal covers :math:`r^2 d\Omega / \cos\theta` of it, and sends back

    .. math:: w\, \sigma(\theta)\, \frac{10^{-2 \alpha r / 10}}{r^2 \cos\theta} ,

    w of its row. It covers the ranges from half way to the ray below it to half way to the one
    above, where these are on the same surface; elsewhere no more than a bin.

    Args:
        power: of each bin and azimuth, (bins, n), added to [Pa2].
        hits: distance (n k,), normal in the sonar's frame (n k, 3), surface (n k,); of k rows of
            each azimuth one after the other.
        directions: in the sonar's frame, (n k, 3).
        rows: weights of the rows, (k,) [Pa2 m2].
        materials: of each surface glint, sharpness of the glint and diffuse part, (m, 3).
        bins: least range, size of a bin [m], absorption there and back [1/m, neper of power].
    """
    distance, normal, surface = hits
    first, size, loss = bins
    n_rows = len(rows)
    for i in range(power.shape[1]):
        for row in range(n_rows):
            k = i * n_rows + row
            r = distance[k]
            if r == np.inf:
                continue
            cosine = max(_facing(normal, directions, k, k), GRAZING)
            below = _half_way(hits, directions, k, k - 1 if row > 0 else -1, size, cosine)
            above = _half_way(hits, directions, k, k + 1 if row + 1 < n_rows else -1, size, cosine)
            square = cosine * cosine
            glint, sharpness, diffuse = materials[surface[k]]
            sigma = glint * math.exp(-sharpness * (1.0 / square - 1.0)) / (square * square)
            sigma += diffuse * square
            echo = rows[row] * sigma * math.exp(-loss * r) / (r * r * cosine)
            near, far = (min(below, above) - first) / size, (max(below, above) - first) / size
            _spread(power, i, echo, near, far)


@njit
def _facing(normal: Array, directions: Array, k: int, ray: int) -> float:
    """Cosine of the angle between the normal at hit k and a ray."""
    against: float = (
        normal[k, 0] * directions[ray, 0]
        + normal[k, 1] * directions[ray, 1]
        + normal[k, 2] * directions[ray, 2]
    )
    return -against


@njit
def _half_way(
    hits: tuple[Array, Array, Whole],
    directions: Array,
    k: int,
    other: int,
    size: float,
    cosine: float,
) -> float:
    """Range at which what belongs to a ray ends, towards another; -1: there is none [m]."""
    distance, normal, surface = hits
    r: float = distance[k]
    if other < 0:
        return r
    facing = _facing(normal, directions, k, other)
    if facing <= GRAZING:
        return r
    expected: float = r * cosine / facing - r  # if the other were on the same plane
    if surface[other] == surface[k]:
        gap: float = distance[other] - r
        if abs(gap - expected) <= max(size, 0.5 * abs(expected)):
            return r + 0.5 * gap
    return r + min(max(0.5 * expected, -size), size)


@njit
def _spread(power: Singles, i: int, echo: float, near: float, far: float) -> None:
    """Share the power of an echo between the bins it covers, by how much of each."""
    n_bins = power.shape[0]
    if far <= 0.0 or near >= n_bins:
        return
    begin, end = math.floor(near), math.floor(far)
    if begin == end:
        power[begin, i] += np.float32(echo)
        return
    density = echo / (far - near)
    for bin in range(max(begin, 0), min(end, n_bins - 1) + 1):
        covered = min(far, bin + 1.0) - max(near, float(bin))
        power[bin, i] += np.float32(density * covered)


@njit
def received(
    power: Singles,
    patterns: Singles,
    noise: float,
    random: npt.NDArray[np.uint16],
    speckle: Singles,
) -> Singles:
    """Amplitudes of the beams, (bins, beams) [Pa].

    Args:
        power: of each bin and ray azimuth, (bins, m) [Pa2].
        patterns: of the beams over neighbouring rays, (s, t): there are s beams from ray to ray,
            and beam ``s q + p`` hears the rays q to q + t - 1 by the pattern p.
        noise: mean power of what is received without any echo [Pa2].
        random: a number for each bin and beam, (bins, beams).
        speckle: amplitude by random number, (65536,).
    """
    n_bins, n_beams = random.shape
    n_phases, n_taps = patterns.shape
    amplitude = np.empty((n_bins, n_beams), dtype=np.float32)
    heard = np.empty(n_beams, dtype=np.float32)
    floor = np.float32(noise)
    for bin in range(n_bins):
        for phase in range(n_phases):
            n = (n_beams - phase + n_phases - 1) // n_phases
            for k in range(n):
                heard[k] = floor
            for tap in range(n_taps):
                weight = patterns[phase, tap]
                for k in range(n):
                    heard[k] += weight * power[bin, k + tap]
            for k in range(n):
                heard[k] = math.sqrt(heard[k])
            for k in range(n):
                beam = phase + k * n_phases
                amplitude[bin, beam] = heard[k] * speckle[random[bin, beam]]
    return amplitude

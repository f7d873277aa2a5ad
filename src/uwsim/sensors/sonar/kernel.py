"""The echoes of rays in range bins, in compiled code."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ...base.numerics.jit import njit
from ...rays import Hits

Array = npt.NDArray[np.float64]
Singles = npt.NDArray[np.float32]
Integers = npt.NDArray[np.int32]
BLOCK = 8
"""The number of azimuths whose rays are adjacent in memory: neighbours are cast together
(`uwsim.rays`)."""
LINES = 16
"""The number of bins that are read from all azimuths together: a line of the processor's cache."""
MIN_COSINE = 0.02
"""The least cosine of an angle of incidence that counts: 88.9 degrees."""

MAX_TILT = 0.9
"""The largest relative change of the density of power over one ray's surface."""


@njit
def add_echoes(
    power: Singles,
    hits: Hits,
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
    above, where these are on the same surface, and likewise from side to side; elsewhere no more
    than a bin.

    Args:
        power: of each bin and azimuth, (bins, n), an azimuth's bins one after the other; added to
            [Pa2].
        hits: distance (n k,), normal in the sonar's frame (n k, 3), surface (n k,); `BLOCK`
            azimuths side by side, k rows of them one above the other, then the next azimuths.
        directions: in the sonar's frame, (n k, 3).
        rows: weight of each row [Pa2 m2], and the share by which the pattern rises from its middle
            to its upper end, (k, 2).
        materials: of each surface glint, sharpness of the glint and diffuse part, (m, 3).
        bins: least range, size of a bin [m], absorption there and back [1/m, neper of power].
    """
    distance, normal, surface = hits
    start, size, loss = bins
    n_rows, n_azimuths = len(rows), power.shape[1]
    reach = start + size * len(power)
    for k in range(len(distance)):
        r = distance[k]
        if r == np.inf:
            continue
        block = k // (BLOCK * n_rows) * BLOCK
        width = min(BLOCK, n_azimuths - block)
        row, column = divmod(k - block * n_rows, width)
        cosine = max(facing_cosine(normal, directions, k, k), MIN_COSINE)
        lower = upper = left = right = 0.0
        hit = (k, r, cosine)
        if row > 0:
            lower = _range_to_neighbour(hit, k - width, hits, directions, reach, size)
        if row + 1 < n_rows:
            upper = _range_to_neighbour(hit, k + width, hits, directions, reach, size)
        if column > 0:
            left = _range_to_neighbour(hit, k - 1, hits, directions, reach, size)
        if column + 1 < width:
            right = _range_to_neighbour(hit, k + 1, hits, directions, reach, size)
        if column == 0:
            left = -right
        elif column + 1 == width:
            right = -left
        sigma, steepness = backscatter(materials[surface[k]], cosine)
        echo = rows[row, 0] * sigma * math.exp(-loss * r) / (r * r * cosine)
        near = (r + min(lower, upper) + min(left, right) - start) / size
        far = (r + max(lower, upper) + max(left, right) - start) / size
        tilt = -0.5 * (far - near) * size * ((3.0 + steepness) / r + loss)
        tilt += rows[row, 1] if upper > lower else -rows[row, 1]
        spread_echo(power[:, block + column], echo, near, far, tilt)


@njit
def backscatter(material: Array, cosine: float) -> tuple[float, float]:
    """Return the backscattering cross section of a square metre (`uwsim.acoustics.material`) [1].

    Returns it and its steepness, the derivative of its logarithm by that of the cosine.

    Args:
        material: glint, sharpness of the glint and diffuse part, (3,).
        cosine: of the angle of incidence.
    """
    square = cosine * cosine
    glint = material[0] * math.exp(-material[1] * (1.0 / square - 1.0)) / (square * square)
    diffuse = material[2] * square
    sigma = glint + diffuse
    slope = glint * (2.0 * material[1] / square - 4.0) + 2.0 * diffuse
    return sigma, slope / max(sigma, 1e-300)


@njit
def facing_cosine(normal: Array, directions: Array, k: int, ray: int) -> float:
    """Return the cosine of the angle between the normal at hit k and a ray."""
    product: float = (
        normal[k, 0] * directions[ray, 0]
        + normal[k, 1] * directions[ray, 1]
        + normal[k, 2] * directions[ray, 2]
    )
    return -product


@njit
def _range_to_neighbour(
    hit: tuple[int, float, float],
    other: int,
    hits: Hits,
    directions: Array,
    reach: float,
    size: float,
) -> float:
    """Return the range from a hit to the end of its ray's surface, towards another ray [m].

    Args:
        hit: its number k, distance [m] and cosine of the angle of incidence.
        other: number of the other ray.
        hits: of all rays.
        directions: of all rays, (n k, 3).
        reach: end of the last bin; a surface is taken to go on as a plane beyond it [m].
        size: of a bin [m].
    """
    k, r, cosine = hit
    distance, normal, surface = hits
    other_cosine = facing_cosine(normal, directions, k, other)
    if other_cosine <= MIN_COSINE:
        return 0.0
    expected = r * cosine / other_cosine - r  # if the other were on the same plane
    if surface[other] < 0 and r + expected > reach:
        return 0.5 * expected
    gap = distance[other] - r
    if surface[other] == surface[k] and abs(gap - expected) <= max(size, 0.5 * abs(expected)):
        half: float = 0.5 * gap
        return half
    return min(max(0.5 * expected, -size), size)


@njit
def spread_echo(power: Singles, echo: float, near: float, far: float, tilt: float) -> None:
    """Distribute the power of an echo over the bins that it covers.

    Args:
        power: of the bins, (n,); added to [Pa2].
        echo: power of the echo [Pa2].
        near: begin of what it covers [bins].
        far: end of what it covers [bins].
        tilt: how much of its mean the density of power rises from the middle to ``far``; no more
            than `MAX_TILT` either way.
    """
    n_bins = len(power)
    if far <= 0.0 or near >= n_bins:
        return
    begin, end = math.floor(near), math.floor(far)
    if begin == end:
        power[begin] += np.float32(echo)
        return
    density = echo / (far - near)
    rise = 2.0 * density * min(max(tilt, -MAX_TILT), MAX_TILT) / (far - near)  # by bin
    density -= rise * 0.5 * (near + far)  # at bin 0
    if begin >= 0:
        part = begin + 1.0 - near
        power[begin] += np.float32((density + rise * (near + 0.5 * part)) * part)
    for bin in range(max(begin + 1, 0), min(end, n_bins)):
        power[bin] += np.float32(density + rise * (bin + 0.5))
    if end < n_bins:
        part = far - end
        power[end] += np.float32((density + rise * (end + 0.5 * part)) * part)


@njit
def compute_amplitudes(
    power: Singles,
    small_targets: Singles,
    patterns: Singles,
    stride: int,
    noise: float,
    integers: npt.NDArray[np.uint16],
    speckle: Singles,
) -> Singles:
    """Return the amplitudes of the beams, (bins, beams) [Pa].

    Args:
        power: of each bin and column of rays, (bins, m), a column's bins one after the other [Pa2].
        small_targets: what the beams receive from small targets, (bins, beams); or (0, 0) [Pa2].
        patterns: of the beams over neighbouring columns, (s, t): beam ``s q + p`` receives the
            columns ``stride q`` to ``stride q + t - 1`` by the pattern p.
        stride: columns from a beam to the next of the same pattern.
        noise: mean power of what is received without any echo [Pa2].
        integers: a number for each bin and beam, (bins, beams).
        speckle: amplitude by random number, (65536,).
    """
    n_bins, n_beams = integers.shape
    n_phases, n_taps = patterns.shape
    amplitude = np.empty((n_bins, n_beams), dtype=np.float32)
    beam_power = np.empty(n_beams, dtype=np.float32)
    lines = np.empty((LINES, power.shape[1]), dtype=np.float32)
    floor = np.float32(noise)
    has_small = small_targets.size > 0
    for bin in range(n_bins):
        if bin % LINES == 0:
            for k in range(power.shape[1]):
                for place in range(min(LINES, n_bins - bin)):
                    lines[place, k] = power[bin + place, k]
        for phase in range(n_phases):
            n = (n_beams - phase + n_phases - 1) // n_phases
            for k in range(n):
                beam_power[k] = floor
            for tap in range(n_taps):
                _add_column(beam_power, n, patterns[phase, tap], lines[bin % LINES, tap:], stride)
            if has_small:
                for k in range(n):
                    beam_power[k] += small_targets[bin, phase + k * n_phases]
            for k in range(n):
                beam_power[k] = math.sqrt(beam_power[k])
            for k in range(n):
                beam = phase + k * n_phases
                amplitude[bin, beam] = beam_power[k] * speckle[integers[bin, beam]]
    return amplitude


@njit
def _add_column(
    beam_power: Singles, n: int, weight: np.float32, columns: Singles, stride: int
) -> None:
    """Add the weighted power of one column to that of each of n beams."""
    if stride == 1:
        for k in range(n):
            beam_power[k] += weight * columns[k]
    else:
        for k in range(n):
            beam_power[k] += weight * columns[k * stride]

"""The power of echoes in range bins, and the amplitudes of beams, in compiled code."""

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
"""The number of azimuths whose rays are adjacent in memory, because neighbouring rays are cast
together (`uwsim.rays`)."""
LINES = 16
"""The number of bins that are read from all azimuths together: one line of the processor's
cache."""
MIN_COSINE = 0.02
"""The minimum cosine of an angle of incidence (88.9 degrees); smaller ones are replaced by it."""

MAX_TILT = 0.9
"""The largest relative change of the power per range bin from the middle to the end of an echo."""


@njit
def add_echoes(
    power: Singles,
    hits: Hits,
    directions: Array,
    rows: Array,
    materials: Array,
    bins: tuple[float, float, float],
) -> None:
    r"""Add the power of the echo of each ray to the range bins that the echo covers.

    A ray of the solid angle :math:`d\Omega` that meets a surface at the range r and the angle
    :math:`\theta` to the normal covers the area :math:`r^2 d\Omega / \cos\theta`. The power of its
    echo is

    .. math:: w\, \sigma(\theta)\, \frac{10^{-2 \alpha r / 10}}{r^2 \cos\theta} ,

    where w is the weight of the ray's row, :math:`\sigma` the backscattering cross section per area
    and :math:`\alpha` the absorption. The echo covers the ranges from half way to the hit of the
    ray below to half way to the hit of the ray above, where these are on the same surface, and
    likewise from side to side; elsewhere no more than a bin.

    Args:
        power: the power in each bin and azimuth, to which echoes are added, (bins, n) [Pa2]; the
            bins of an azimuth are adjacent in memory.
        hits: the distance (n k,), normal in the sonar's frame (n k, 3) and surface (n k,) of the
            hit of each ray: `BLOCK` azimuths side by side, their k rows one above the other, then
            the next azimuths.
        directions: the directions of the rays in the sonar's frame, (n k, 3).
        rows: the weight of each row [Pa2 m2], and the fraction by which the pattern rises from the
            middle of the row to its upper end, (k, 2).
        materials: the glint, sharpness of the glint and diffuse part of each surface, (m, 3).
        bins: the minimum range [m], the size of a bin [m], and the two-way absorption [1/m, neper
            of power].
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
    """Return the backscattering cross section per area (`uwsim.acoustics.material`) [1].

    Also return the derivative of its logarithm with respect to the logarithm of the cosine.

    Args:
        material: the glint, sharpness of the glint and diffuse part, (3,).
        cosine: the cosine of the angle of incidence.
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
    """Return the range from a hit to the end of the surface that its ray covers [m].

    Args:
        hit: the number k of the ray, its distance [m] and the cosine of the angle of incidence.
        other: the number of the neighbouring ray, towards which the end is.
        hits: the hits of all rays.
        directions: the directions of all rays, (n k, 3).
        reach: the end of the last bin, beyond which surfaces are assumed to continue as planes [m].
        size: the size of a bin [m].
    """
    k, r, cosine = hit
    distance, normal, surface = hits
    other_cosine = facing_cosine(normal, directions, k, other)
    if other_cosine <= MIN_COSINE:
        return 0.0
    expected = r * cosine / other_cosine - r  # if the neighbour hit the same plane
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
        power: the power in each bin, to which the echo is added, (n,) [Pa2].
        echo: the power of the echo [Pa2].
        near: the start of the echo [bins].
        far: the end of the echo [bins].
        tilt: the rise of the power per bin from the middle of the echo to ``far``, relative to the
            mean; limited to `MAX_TILT` either way.
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
        power: the power in each bin and column of rays, (bins, m) [Pa2]; the bins of a column are
            adjacent in memory.
        small_targets: the power from small targets, (bins, beams) [Pa2]; (0, 0) without any.
        patterns: the patterns of the beams over neighbouring columns, (s, t): beam ``s q + p``
            receives the columns ``stride q`` to ``stride q + t - 1`` by the pattern p.
        stride: the number of columns from a beam to the next beam with the same pattern.
        noise: the mean power of the noise [Pa2].
        integers: a random integer from 0 to 65535 for each bin and beam, (bins, beams).
        speckle: the relative amplitude for each random integer, (65536,).
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
                for offset in range(min(LINES, n_bins - bin)):
                    lines[offset, k] = power[bin + offset, k]
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
    """Add a weighted column to each of n beams; the columns of two beams are a stride apart."""
    if stride == 1:
        for k in range(n):
            beam_power[k] += weight * columns[k]
    else:
        for k in range(n):
            beam_power[k] += weight * columns[k * stride]

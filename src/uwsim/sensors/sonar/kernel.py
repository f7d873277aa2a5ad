"""Echoes of rays in bins of range, compiled."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ...numerics.jit import njit

Array = npt.NDArray[np.float64]
Singles = npt.NDArray[np.float32]
Whole = npt.NDArray[np.int32]
BLOCK = 8
"""Azimuths whose rays are side by side: rays that are neighbours go together (`uwsim.rays`)."""
LINES = 16
"""Bins that are taken from all azimuths in one go: those of a line of the processor's cache."""
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
        power: of each bin and azimuth, (bins, n), an azimuth's bins one after the other; added to
            [Pa2].
        hits: distance (n k,), normal in the sonar's frame (n k, 3), surface (n k,); `BLOCK`
            azimuths side by side, k rows of them one above the other, then the next azimuths.
        directions: in the sonar's frame, (n k, 3).
        rows: weights of the rows, (k,) [Pa2 m2].
        materials: of each surface glint, sharpness of the glint and diffuse part, (m, 3).
        bins: least range, size of a bin [m], absorption there and back [1/m, neper of power].
    """
    distance, normal, surface = hits
    first, size, loss = bins
    n_rows, n_azimuths = len(rows), power.shape[1]
    for k in range(len(distance)):
        r = distance[k]
        if r == np.inf:
            continue
        block = k // (BLOCK * n_rows) * BLOCK
        width = min(BLOCK, n_azimuths - block)
        row, beside = divmod(k - block * n_rows, width)
        cosine = max(_facing(normal, directions, k, k), GRAZING)
        below = above = r
        if row > 0:
            facing = _facing(normal, directions, k, k - width)
            below += _half_way(r * cosine, facing, r, _gap(distance, surface, k, k - width), size)
        if row + 1 < n_rows:
            facing = _facing(normal, directions, k, k + width)
            above += _half_way(r * cosine, facing, r, _gap(distance, surface, k, k + width), size)
        square = cosine * cosine
        material = surface[k]
        glint = math.exp(-materials[material, 1] * (1.0 / square - 1.0))
        sigma = materials[material, 0] * glint / (square * square)
        sigma += materials[material, 2] * square
        echo = rows[row] * sigma * math.exp(-loss * r) / (r * r * cosine)
        near, far = (min(below, above) - first) / size, (max(below, above) - first) / size
        _spread(power[:, block + beside], echo, near, far)


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
def _gap(distance: Array, surface: Whole, k: int, other: int) -> float:
    """How much farther another hit is than hit k; infinite on another surface [m]."""
    gap: float = distance[other] - distance[k]
    return gap if surface[other] == surface[k] else np.inf


@njit
def _half_way(height: float, facing: float, r: float, gap: float, size: float) -> float:
    """How much farther than the hit of a ray ends what belongs to it, towards another ray [m].

    Args:
        height: of the sonar over the plane of the hit [m].
        facing: cosine of the angle between the normal of that plane and the other ray.
        r: distance of the hit [m].
        gap: how much farther the other hit is; infinite on another surface [m].
        size: of a bin [m].
    """
    if facing <= GRAZING:
        return 0.0
    expected = height / facing - r  # if the other were on the same plane
    if abs(gap - expected) <= max(size, 0.5 * abs(expected)):
        return 0.5 * gap
    return min(max(0.5 * expected, -size), size)


@njit
def _spread(power: Singles, echo: float, near: float, far: float) -> None:
    """Share the power of an echo between the bins (n,) it covers, by how much of each."""
    n_bins = len(power)
    if far <= 0.0 or near >= n_bins:
        return
    begin, end = math.floor(near), math.floor(far)
    if begin == end:
        power[begin] += np.float32(echo)
        return
    density = echo / (far - near)
    if begin >= 0:
        power[begin] += np.float32(density * (begin + 1.0 - near))
    whole = np.float32(density)
    for bin in range(max(begin + 1, 0), min(end, n_bins)):
        power[bin] += whole
    if end < n_bins:
        power[end] += np.float32(density * (far - end))


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
        power: of each bin and ray azimuth, (bins, m), an azimuth's bins one after the other [Pa2].
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
    some = np.empty((LINES, power.shape[1]), dtype=np.float32)
    floor = np.float32(noise)
    for bin in range(n_bins):
        if bin % LINES == 0:
            for k in range(power.shape[1]):
                for place in range(min(LINES, n_bins - bin)):
                    some[place, k] = power[bin + place, k]
        for phase in range(n_phases):
            n = (n_beams - phase + n_phases - 1) // n_phases
            for k in range(n):
                heard[k] = floor
            for tap in range(n_taps):
                weight = patterns[phase, tap]
                for k in range(n):
                    heard[k] += weight * some[bin % LINES, k + tap]
            for k in range(n):
                heard[k] = math.sqrt(heard[k])
            for k in range(n):
                beam = phase + k * n_phases
                amplitude[bin, beam] = heard[k] * speckle[random[bin, beam]]
    return amplitude

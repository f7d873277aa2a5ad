"""A Monte-Carlo tracer of daylight in a plane-parallel ocean: the reference of daylight fields.

The water is homogeneous and deep, its surface level. Light enters at one angle with the irradiance
1 just below the surface. Paths have exponential lengths and lose the share 1 - b/c of their weight
in each collision; the surface reflects light from below as Fresnel has it. What crosses a depth is
counted there, so that irradiances have no weighting of their own. The radiance towards the zenith
is the sum of what each collision scatters there, dimmed by the water above it. The phase function
is a table (`path_tracer`); no formula of `uwsim` is used.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from tests.optics.path_tracer import (
    LOG_MIN_ANGLE,
    LOG_PI,
    N_ANGLES,
    N_SHARES,
    FloatArray,
    PhaseTables,
)
from uwsim.base.numerics.jit import njit

REFRACTIVE_INDEX = 1.34
MIN_WEIGHT = 1e-3
"""The weight below which a path survives with a chance of 10 %."""
MAX_COLLISIONS = 3000


@dataclass(frozen=True)
class OceanLight:
    """Light at each depth, in units of the irradiance just below the surface, (n,)."""

    downward: FloatArray
    """The downward irradiance."""
    upward: FloatArray
    """The upward irradiance."""
    nadir: FloatArray
    """The radiance that a camera sees straight below, times pi."""
    beam: FloatArray
    """The downward irradiance within 20 degrees of the refracted sun."""


def trace_ocean(
    tables: PhaseTables,
    *,
    attenuation: float,
    albedo: float,
    cosine: float,
    depths: FloatArray,
    n_paths: int,
    seed: int,
) -> OceanLight:
    """Trace the light of the sun.

    Args:
        tables: the phase function.
        attenuation: the beam attenuation c [1/m].
        albedo: the single-scattering albedo b/c.
        cosine: the cosine of the refracted sun's angle from the zenith.
        depths: the depths [m], rising, (n,).
        n_paths: the number of paths.
        seed: the seed.
    """
    sums = _trace(
        np.random.default_rng(seed),
        tables.angles,
        tables.log_density,
        attenuation * depths,
        albedo,
        cosine,
        n_paths,
    )
    downward, upward, nadir, beam = sums / n_paths
    return OceanLight(downward, upward, math.pi * nadir, beam)


@njit
def _reflect(cosine: float) -> float:
    """Return Fresnel's reflectance of the surface from below."""
    sine = REFRACTIVE_INDEX * math.sqrt(max(1.0 - cosine * cosine, 0.0))
    if sine >= 1.0:
        return 1.0
    air = math.sqrt(1.0 - sine * sine)
    s = (REFRACTIVE_INDEX * cosine - air) / (REFRACTIVE_INDEX * cosine + air)
    p = (cosine - REFRACTIVE_INDEX * air) / (cosine + REFRACTIVE_INDEX * air)
    return 0.5 * (s * s + p * p)


@njit
def _interpolate_density(table: FloatArray, angle: float) -> float:
    """Return the phase function at an angle [1/sr]."""
    x = (math.log(max(angle, 1e-7)) - LOG_MIN_ANGLE) / (LOG_PI - LOG_MIN_ANGLE) * (N_ANGLES - 1)
    k = min(int(x), N_ANGLES - 2)
    return math.exp(table[k] + (x - k) * (table[k + 1] - table[k]))


@njit
def _trace(
    generator: np.random.Generator,
    angles: FloatArray,
    log_density: FloatArray,
    depths: FloatArray,
    albedo: float,
    cosine: float,
    n_paths: int,
) -> FloatArray:
    """Return the sums of downward, upward, nadir and beam, at optical depths, (4, n)."""
    n = len(depths)
    sums = np.zeros((4, n))
    sine = math.sqrt(1.0 - cosine * cosine)
    limit = math.cos(math.radians(20.0))
    for _ in range(n_paths):
        z, x, y, w = 0.0, sine, 0.0, -cosine  # optical depth; direction, z upwards
        weight = 1.0
        for _ in range(MAX_COLLISIONS):
            path = -math.log(1.0 - generator.random())
            target = z - w * path
            while True:
                for k in range(n):
                    if z < depths[k] <= target:
                        sums[0, k] += weight
                        if -w * cosine + x * sine > limit:
                            sums[3, k] += weight
                    elif target <= depths[k] < z:
                        sums[1, k] += weight
                if target >= 0.0:
                    break
                if generator.random() >= _reflect(w):
                    weight = 0.0
                    break
                z, target, w = 0.0, -target, -w
            z = target
            if weight == 0.0:
                break
            weight *= albedo
            density = _interpolate_density(log_density, math.acos(min(max(w, -1.0), 1.0)))
            for k in range(n):
                if z > depths[k]:
                    sums[2, k] += weight * density * math.exp(depths[k] - z)
            if weight < MIN_WEIGHT:
                if generator.random() > 0.1:
                    break
                weight *= 10.0
            share = generator.random() * (N_SHARES - 1)
            i = min(int(share), N_SHARES - 2)
            theta = angles[i] + (share - i) * (angles[i + 1] - angles[i])
            phi = 2.0 * math.pi * generator.random()
            a, b = math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi)
            c = math.cos(theta)
            horizontal = math.sqrt(max(1.0 - w * w, 0.0))
            if horizontal < 1e-6:
                x, y, w = a, b, c if w > 0.0 else -c
            else:
                x, y, w = (
                    a * x * w / horizontal - b * y / horizontal + c * x,
                    a * y * w / horizontal + b * x / horizontal + c * y,
                    -a * horizontal + c * w,
                )
    return sums

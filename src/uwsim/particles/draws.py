r"""The random numbers of particles: hashes of a key and of the indices of a cell or a bubble.

A number follows from the key alone, by the finaliser of G. L. Steele, D. Lea and C. H. Flood, "Fast
splittable pseudorandom number generators", *OOPSLA* (2014), so that no state is stored.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.jit import njit
from .population import Kind

MAX_COUNT = 64
"""The largest number of particles in a cell."""
FADE_SHARE = 0.25
"""The share of the greatest range over which particles fade."""
MAX_ELONGATION = 2.0
"""The largest length of a floc along each axis, in its diameters [1]."""
MIN_SHARE = 0.02
"""The least random number of a floc's brightness, whose distribution is exponential."""
FLOC = int(Kind.FLOC)
LENS_CLEARANCE = 0.08
"""The distance within which no particles are drawn: the housing of the camera [m]."""

UInt64 = np.uint64
INCREMENT = np.uint64(0x9E3779B97F4A7C15)
FACTOR_1, FACTOR_2 = np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB)
AXIS_1, AXIS_2, AXIS_3 = (
    np.uint64(0xD6E8FEB86659FD93),
    np.uint64(0xA0761D6478BD642F),
    np.uint64(0xE7037ED1A0B428DB),
)

PARTICLE = np.dtype(
    [
        ("place", np.float32, 3),  # in the camera's frame (OpenGL axes) [m]
        ("radius", np.float32),  # [m]
        ("extent", np.float32, 3),  # its motion during the exposure and its own length [m]
        ("weight", np.float32),  # of its fading [1]
        ("reflectance", np.float32),  # [1]
        ("kind", np.float32),  # a value of `Kind`
    ]
)
"""A particle in a view, as the renderer reads it."""


@njit
def mix(value: UInt64) -> UInt64:
    """Return the hash of 64 bits."""
    value = (value ^ (value >> np.uint64(30))) * FACTOR_1
    value = (value ^ (value >> np.uint64(27))) * FACTOR_2
    return value ^ (value >> np.uint64(31))


@njit
def hash_cell(key: UInt64, i: int, j: int, k: int) -> UInt64:
    """Return the hash of a cell."""
    value = mix(key + np.uint64(i) * AXIS_1)
    value = mix(value + np.uint64(j) * AXIS_2)
    return mix(value + np.uint64(k) * AXIS_3)


@njit
def uniform(value: UInt64, number: int) -> float:
    """Return a number of a hash's sequence, 0 to 1."""
    word = mix(value + np.uint64(number + 1) * INCREMENT) >> np.uint64(11)
    return float(word) * 1.1102230246251565e-16


@njit
def draw_uniforms(key: UInt64, number: int, n: int) -> Array:
    """Return n numbers from 0 to 1 of the element of a sequence, (n,)."""
    value, numbers = mix(key + np.uint64(number) * AXIS_1), np.empty(n)
    for i in range(n):
        numbers[i] = uniform(value, i)
    return numbers


@njit
def draw_count(number: float, zero_share: float, mean: float) -> int:
    """Draw from Poisson's distribution by inversion.

    Args:
        number: a number from 0 to 1.
        zero_share: exp(-mean).
        mean: the mean.
    """
    count, share, total = 0, zero_share, zero_share
    while number > total and count < MAX_COUNT:
        count += 1
        share *= mean / count
        total += share
    return count


@njit
def draw_diameter(number: float, sizes: Array) -> float:
    """Draw a diameter from the power law of a class [m]."""
    low, high, power = sizes[0], sizes[1], sizes[2]
    ratio = math.pow(high / low, power)
    diameter: float = low * math.pow(1.0 + number * (ratio - 1.0), 1.0 / power)
    return diameter


@njit
def add_particle(
    place: tuple[float, float, float],
    diameter: float,
    weight: float,
    limits: tuple[Array, Array, Array, float],
    value: UInt64,
    particle: npt.NDArray[np.void],
) -> bool:
    """Write a particle at a place in the camera's frame; return False if it is not in view.

    Args:
        place: the place in the camera's frame [m].
        diameter: the diameter [m].
        weight: the share of its image that is drawn [1].
        limits: the numbers of the class, the motions during the exposure of `find_motions`, the
            slopes of the image's edges, and the greatest range of the view [m].
        value: the hash of the particle, for its shape.
        particle: the record to write, (1,).
    """
    x, y, z = place
    sizes, motions, slopes, reach = limits
    # a particle that moves through the image during the exposure is in view, too
    motion_x = motions[0, 0] - (motions[1, 1] * z - motions[1, 2] * y)
    motion_y = motions[0, 1] - (motions[1, 2] * x - motions[1, 0] * z)
    motion_z = motions[0, 2] - (motions[1, 0] * y - motions[1, 1] * x)
    margin = diameter + 0.02 * -z + 0.5 * (abs(motion_x) + abs(motion_y) + abs(motion_z))
    if -z < LENS_CLEARANCE:
        return False
    if x < slopes[0] * -z - margin or x > slopes[1] * -z + margin:
        return False
    if y < slopes[2] * -z - margin or y > slopes[3] * -z + margin:
        return False
    share = math.sqrt(x * x + y * y + z * z) / min(reach, sizes[5] * diameter)
    if share >= 1.0:
        return False
    fade = min((1.0 - share) / FADE_SHARE, 1.0)
    p = particle[0]
    p.place[0], p.place[1], p.place[2] = x, y, z
    p.radius, p.weight = 0.5 * diameter, weight * fade
    p.kind = sizes[4]
    length_x, length_y, length_z, factor = 0.0, 0.0, 0.0, 1.0
    if sizes[4] == FLOC:
        factor = -math.log(max(uniform(value, 0), MIN_SHARE))
        length = diameter * MAX_ELONGATION * uniform(value, 1)
        length_x = length * (2.0 * uniform(value, 2) - 1.0)
        length_y = length * (2.0 * uniform(value, 3) - 1.0)
        length_z = length * (2.0 * uniform(value, 4) - 1.0)
    p.reflectance = sizes[3] * factor
    p.extent[0], p.extent[1], p.extent[2] = (
        motion_x + length_x,
        motion_y + length_y,
        motion_z + length_z,
    )
    return True

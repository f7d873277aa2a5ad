"""The bubbles that rise from a source, in a camera's view.

Bubble k leaves the source at the time k / rate. Its path follows from its number by a hash.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.jit import njit
from .draws import (
    AXIS_1,
    PARTICLE,
    UInt64,
    add_particle,
    draw_diameter,
    mix,
    uniform,
)
from .lattice import MAX_PARTICLES
from .population import SizeClass
from .view import Drift, View, find_bounds, find_motions, find_reach, list_sizes

WOBBLE, WOBBLE_RATE = 0.02, 9.0
"""The amplitude [m] and the angular frequency [rad/s] of a bubble's path."""
PLUME_SLOPE = 0.1
"""The growth of a plume's radius with height [1]."""
RANGE_FACTOR = 4.0
"""The ratio of the range in which the bubbles of a source are drawn to that of other particles."""


def find_plume(
    size_class: SizeClass, source: Array, view: View, drift: Drift
) -> npt.NDArray[np.void]:
    """Find the bubbles of a class that rise from a source, in a view.

    Args:
        size_class: the class; its concentration is the number of bubbles per second.
        source: the place of the source in W, (3,) [m].
        view: the camera.
        drift: the displacement of the water.

    Returns:
        The bubbles, records of `PARTICLE`, (n,).
    """
    rise = view.surface_height - float(source[2])
    rate, speed = size_class.concentration, size_class.rise_speed
    if rate <= 0.0 or rise <= 0.0:
        return np.zeros(0, PARTICLE)
    last_bubble = math.floor(rate * drift.time)
    first_bubble = max(math.ceil(rate * (drift.time - rise / speed)), 0)
    first_bubble = max(first_bubble, last_bubble - MAX_PARTICLES + 1)
    lens = view.intrinsics
    reach = min(view.max_range * RANGE_FACTOR, find_reach(size_class.max_diameter, view), lens.far)
    _, slopes = find_bounds(view, reach)
    particles = np.zeros(MAX_PARTICLES, PARTICLE)
    n = fill_plume(
        (np.uint64(size_class.key), first_bubble, last_bubble, rate, drift.time),
        (view.world_from_camera.position, view.world_from_camera.rotation, slopes, reach),
        (source, np.array(drift.velocity), speed),
        list_sizes(size_class, view),
        find_motions(size_class, view, drift),
        particles,
    )
    return particles[:n]


@njit
def fill_plume(
    emission: tuple[UInt64, int, int, float, float],
    camera: tuple[Array, Array, Array, float],
    path: tuple[Array, Array, float],
    sizes: Array,
    motions: Array,
    particles: npt.NDArray[np.void],
) -> int:
    """Find the bubbles of a source in a view, and return their number.

    Args:
        emission: the key, the numbers of the first and the last bubble, their rate [1/s], the time.
        camera: the place in W (3,) [m], the rotation (3, 3), the slopes of the image's edges (4,),
            the range [m].
        path: the place of the source in W (3,) [m], the velocity of the water in W (3,) [m/s], the
            rise speed [m/s].
        sizes: the least and the greatest diameter [m], and so on, of `list_sizes`.
        motions: the motions during the exposure, of `find_motions`.
        particles: the records to write, (`MAX_PARTICLES`,).
    """
    key, first_bubble, last_bubble, rate, time = emission
    eye, rotation, slopes, reach = camera
    source, velocity, speed = path
    limits = sizes, motions, slopes, reach
    n = 0
    for bubble in range(first_bubble, last_bubble + 1):
        value = mix(key + np.uint64(bubble) * AXIS_1)
        age = time - bubble / rate
        height = speed * age
        angle = 2.0 * math.pi * uniform(value, 0)
        radius = PLUME_SLOPE * height * math.sqrt(uniform(value, 1))
        phase = 2.0 * math.pi * uniform(value, 2) + WOBBLE_RATE * age
        wobble = WOBBLE * min(10.0 * height, 1.0)
        px = source[0] + velocity[0] * age + radius * math.cos(angle) + wobble * math.cos(phase)
        py = source[1] + velocity[1] * age + radius * math.sin(angle) + wobble * math.sin(phase)
        pz = source[2] + velocity[2] * age + height
        px, py, pz = px - eye[0], py - eye[1], pz - eye[2]
        x = rotation[0, 0] * px + rotation[1, 0] * py + rotation[2, 0] * pz
        y = rotation[0, 1] * px + rotation[1, 1] * py + rotation[2, 1] * pz
        z = rotation[0, 2] * px + rotation[1, 2] * py + rotation[2, 2] * pz
        diameter = draw_diameter(uniform(value, 3), sizes)
        if add_particle((x, y, z), diameter, 1.0, limits, value, particles[n : n + 1]):
            n += 1
            if n == len(particles):
                return n
    return n

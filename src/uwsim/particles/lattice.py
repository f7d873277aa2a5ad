r"""The particles in a camera's view, as a function of seed, displacement and pose alone.

The water is divided into cubic cells that move with a class of particles. What a cell contains
follows from the key of the class and the indices of the cell by a hash (`draws`): the number, from
Poisson's distribution, and the places and diameters. So the water is unlimited, two cameras see
the same particles, and nothing is stored.

A particle is drawn up to the range at which it has `MIN_WIDTH` pixels, and fades over the last
quarter of it. Not drawn, farther particles belong to the scattering of the water.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.jit import njit
from .draws import (
    LENS_CLEARANCE,
    MAX_COUNT,
    PARTICLE,
    UInt64,
    add_particle,
    draw_count,
    draw_diameter,
    hash_cell,
    uniform,
)
from .population import SizeClass
from .view import Drift, View, find_bounds, find_motions, find_reach, list_sizes

MEAN_COUNT = 3.0
"""The mean number of particles in a cell."""
MIN_EDGE, MAX_EDGE = 0.02, 4.0
"""The limits of the edge of a cell [m]."""
MAX_PARTICLES = 20_000
"""The largest number of particles of a class in a view; one with more is shortened."""
MAX_CELLS = 4_000_000
"""The largest number of cells of a view that is searched; a longer view is shortened to it."""


def find_particles(size_class: SizeClass, view: View, drift: Drift) -> npt.NDArray[np.void]:
    """Find the particles of a class in a view.

    Returns:
        The particles, records of `PARTICLE`, (n,).
    """
    if size_class.concentration <= 0.0:
        return np.zeros(0, PARTICLE)
    lens = view.intrinsics
    reach = min(view.max_range, find_reach(size_class.max_diameter, view), lens.far)
    edge = min(max(math.pow(MEAN_COUNT / size_class.concentration, 1.0 / 3.0), MIN_EDGE), MAX_EDGE)
    mean_count = min(size_class.concentration * edge**3, 0.5 * MAX_COUNT)
    rotation = view.world_from_camera.rotation
    displacement = np.array(drift.displacement)
    displacement[2] += size_class.rise_speed * drift.time
    eye = view.world_from_camera.position - displacement
    bounds, slopes = find_bounds(view, reach)
    lower = np.floor((eye + bounds[0]) / edge).astype(np.int64)
    upper = np.floor((eye + bounds[1]) / edge).astype(np.int64)
    if float(np.prod((upper - lower + 1).astype(np.float64))) > MAX_CELLS:
        return find_particles(size_class, _shorten(view, 0.7 * reach), drift)
    motions = find_motions(size_class, view, drift)
    depth = view.surface_height - float(view.world_from_camera.position[2])
    depths = np.array([depth, size_class.depth_scale])
    particles = np.zeros(MAX_PARTICLES, PARTICLE)
    n = fill_view(
        (np.uint64(size_class.key), lower, upper, edge, mean_count),
        (eye, rotation, slopes, reach),
        list_sizes(size_class, view),
        depths,
        motions,
        particles,
    )
    if n == MAX_PARTICLES:
        return find_particles(
            size_class, _shorten(view, _limit_reach(size_class, slopes, reach)), drift
        )
    return particles[:n]


def _limit_reach(size_class: SizeClass, slopes: Array, reach: float) -> float:
    """Return a range within which a view has fewer than `MAX_PARTICLES` of a class [m]."""
    solid_angle = (slopes[1] - slopes[0] + 0.05) * (slopes[3] - slopes[2] + 0.05)
    volume = 0.9 * MAX_PARTICLES / size_class.concentration
    return min(float((3.0 * volume / solid_angle) ** (1.0 / 3.0)), 0.7 * reach)


def _shorten(view: View, max_range: float) -> View:
    return View(
        world_from_camera=view.world_from_camera,
        intrinsics=view.intrinsics,
        surface_height=view.surface_height,
        max_range=max_range,
        exposure_time=view.exposure_time,
        velocity=view.velocity,
        angular_velocity=view.angular_velocity,
    )


@njit
def fill_view(
    cells: tuple[UInt64, npt.NDArray[np.int64], npt.NDArray[np.int64], float, float],
    camera: tuple[Array, Array, Array, float],
    sizes: Array,
    depths: Array,
    motions: Array,
    particles: npt.NDArray[np.void],
) -> int:
    """Find the particles in a view, and return their number.

    Args:
        cells: the key, the lowest and the highest indices (3,), the edge [m], the mean count.
        camera: the place in the moving frame (3,) [m], the rotation (3, 3), the slopes of the
            image's edges (4,), the range [m].
        sizes: the least and the greatest diameter [m], and so on, of `list_sizes`.
        depths: the depth of the camera, and the depth over which numbers fall to 1/e [m].
        motions: the motions during the exposure, of `find_motions`.
        particles: the records to write, (`MAX_PARTICLES`,).
    """
    key, lower, upper, edge, mean_count = cells
    eye, rotation, slopes, reach = camera
    limits = sizes, motions, slopes, reach
    zero_share = math.exp(-mean_count)
    cell_radius = 0.8660254037844387 * edge + sizes[1]
    normals = np.empty(4)  # the lengths of the normals of the view's sides
    for side in range(4):
        normals[side] = math.sqrt(1.0 + slopes[side] * slopes[side])
    n = 0
    for i in range(lower[0], upper[0] + 1):
        dx = (i + 0.5) * edge - eye[0]
        for j in range(lower[1], upper[1] + 1):
            dy = (j + 0.5) * edge - eye[1]
            for k in range(lower[2], upper[2] + 1):
                dz = (k + 0.5) * edge - eye[2]
                back = rotation[0, 2] * dx + rotation[1, 2] * dy + rotation[2, 2] * dz
                if back > cell_radius:
                    continue
                if dx * dx + dy * dy + dz * dz > (reach + cell_radius) ** 2:
                    continue
                right = rotation[0, 0] * dx + rotation[1, 0] * dy + rotation[2, 0] * dz
                up = rotation[0, 1] * dx + rotation[1, 1] * dy + rotation[2, 1] * dz
                if slopes[0] * -back - right > cell_radius * normals[0]:
                    continue
                if right - slopes[1] * -back > cell_radius * normals[1]:
                    continue
                if slopes[2] * -back - up > cell_radius * normals[2]:
                    continue
                if up - slopes[3] * -back > cell_radius * normals[3]:
                    continue
                value = hash_cell(key, i, j, k)
                for number in range(draw_count(uniform(value, 0), zero_share, mean_count)):
                    first = 1 + 5 * number
                    px = (i + uniform(value, first)) * edge - eye[0]
                    py = (j + uniform(value, first + 1)) * edge - eye[1]
                    pz = (k + uniform(value, first + 2)) * edge - eye[2]
                    z = rotation[0, 2] * px + rotation[1, 2] * py + rotation[2, 2] * pz
                    if -z < LENS_CLEARANCE:
                        continue
                    depth = depths[0] - pz
                    if depth < 0.0:
                        continue
                    weight = 1.0
                    if depths[1] < 1e30:
                        share = math.exp(-depth / depths[1]) - uniform(value, first + 4)
                        if share <= 0.0:
                            continue
                        weight = min(share / 0.05, 1.0)
                    x = rotation[0, 0] * px + rotation[1, 0] * py + rotation[2, 0] * pz
                    y = rotation[0, 1] * px + rotation[1, 1] * py + rotation[2, 1] * pz
                    diameter = draw_diameter(uniform(value, first + 3), sizes)
                    if add_particle(
                        (x, y, z), diameter, weight, limits,
                        hash_cell(value, number, 0, 0), particles[n : n + 1],
                    ):  # fmt: skip
                        n += 1
                        if n == len(particles):
                            return n
    return n

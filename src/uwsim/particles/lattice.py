r"""The particles in a camera's view, as a function of seed, displacement and pose alone.

The water is divided into cubic cells that move with a class of particles. What a cell contains
follows from the key of the class and the indices of the cell by a hash (the finaliser of G. L.
Steele, D. Lea and C. H. Flood, "Fast splittable pseudorandom number generators", *OOPSLA* 2014):
the number, from Poisson's distribution, and the places and diameters. So the water is unlimited,
two cameras see the same particles, and nothing is stored.

A particle is drawn up to the range at which it has `MIN_WIDTH` pixels, and fades over the last
quarter of it. Not drawn, farther particles belong to the scattering of the water.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Intrinsics, Pose
from ..base.numerics.jit import njit
from ..base.numerics.linear import rotate_back
from .population import Kind, SizeClass

MEAN_COUNT = 3.0
"""The mean number of particles in a cell."""
MIN_EDGE, MAX_EDGE = 0.02, 4.0
"""The limits of the edge of a cell [m]."""
MAX_COUNT = 64
"""The largest number of particles in a cell."""
MIN_WIDTH = 0.4
"""The width of the smallest image of a particle that is drawn [px]."""
FADE_SHARE = 0.25
"""The share of the greatest range over which particles fade."""
MAX_PARTICLES = 20_000
"""The largest number of particles in a view; the excess is not drawn."""
MAX_CELLS = 4_000_000
"""The largest number of cells of a view that is searched; a longer view is shortened to it."""
WOBBLE, WOBBLE_RATE = 0.02, 9.0
"""The amplitude [m] and the angular frequency [rad/s] of a bubble's path."""
PLUME_SLOPE = 0.1
"""The growth of a plume's radius with height [1]."""
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


@dataclass(frozen=True, kw_only=True)
class View:
    """The camera for which particles are found."""

    world_from_camera: Pose
    """The pose of the camera; OpenGL axes."""
    intrinsics: Intrinsics
    """The pinhole of the camera."""
    surface_height: float
    """The height z of the water's surface in W [m]."""
    max_range: float
    """The range beyond which no particle is drawn [m]."""
    exposure_time: float = 0.0
    """The time during which a particle moves in the image [s]."""
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The velocity of the camera in W [m/s]."""
    angular_velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The angular velocity of the camera in W [rad/s]."""


@dataclass(frozen=True, kw_only=True)
class Drift:
    """The displacement of the water since the start."""

    displacement: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The displacement by currents and waves in W [m]."""
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The velocity in W [m/s]."""
    time: float = 0.0
    """The time, for particles that sink and rise [s]."""


def find_particles(size_class: SizeClass, view: View, drift: Drift) -> npt.NDArray[np.void]:
    """Find the particles of a class in a view.

    Returns:
        The particles, records of `PARTICLE`, (n,).
    """
    if size_class.concentration <= 0.0:
        return np.zeros(0, PARTICLE)
    lens = view.intrinsics
    reach = min(view.max_range, _find_reach(size_class.max_diameter, view), lens.far)
    edge = min(
        max(math.pow(MEAN_COUNT / size_class.concentration, 1.0 / 3.0), MIN_EDGE), MAX_EDGE
    )
    mean_count = min(size_class.concentration * edge**3, 0.5 * MAX_COUNT)
    rotation = view.world_from_camera.rotation
    displacement = np.array(drift.displacement)
    displacement[2] += size_class.rise_speed * drift.time
    eye = view.world_from_camera.position - displacement
    bounds, slopes = _find_bounds(view, reach)
    lower = np.floor((eye + bounds[0]) / edge).astype(np.int64)
    upper = np.floor((eye + bounds[1]) / edge).astype(np.int64)
    if float(np.prod((upper - lower + 1).astype(np.float64))) > MAX_CELLS:
        return find_particles(size_class, _shorten(view, 0.7 * reach), drift)
    motions = _find_motions(size_class, view, drift)
    sizes = np.array(
        [
            size_class.min_diameter,
            size_class.max_diameter,
            1.0 - size_class.slope,
            size_class.reflectance,
            float(size_class.kind),
        ]
    )
    depth = view.surface_height - float(view.world_from_camera.position[2])
    depths = np.array([depth, size_class.depth_scale])
    particles = np.zeros(MAX_PARTICLES, PARTICLE)
    n = fill_view(
        (np.uint64(size_class.key), lower, upper, edge, mean_count),
        (eye, rotation, slopes, reach),
        sizes,
        depths,
        motions,
        particles,
    )
    return particles[:n]


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
    last = math.floor(rate * drift.time)
    first = max(math.ceil(rate * (drift.time - rise / speed)), 0)
    first = max(first, last - MAX_PARTICLES + 1)
    lens = view.intrinsics
    reach = min(view.max_range * 4.0, _find_reach(size_class.max_diameter, view), lens.far)
    _, slopes = _find_bounds(view, reach)
    sizes = np.array(
        [
            size_class.min_diameter,
            size_class.max_diameter,
            1.0 - size_class.slope,
            size_class.reflectance,
            float(size_class.kind),
        ]
    )
    particles = np.zeros(MAX_PARTICLES, PARTICLE)
    n = fill_plume(
        (np.uint64(size_class.key), first, last, rate, drift.time),
        (view.world_from_camera.position, view.world_from_camera.rotation, slopes, reach),
        (source, np.array(drift.velocity), speed),
        sizes,
        _find_motions(size_class, view, drift),
        particles,
    )
    return particles[:n]


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


def _find_reach(diameter: float, view: View) -> float:
    """Return the range at which a particle has `MIN_WIDTH` pixels [m]."""
    lens = view.intrinsics
    return diameter * math.sqrt(lens.fx * lens.fy) / MIN_WIDTH


def _find_bounds(view: View, reach: float) -> tuple[Array, Array]:
    """Return the box around the view relative to the camera in W, (2, 3) [m], and the slopes.

    The slopes x / -z and y / -z of the image's edges are left, right, lower and upper, (4,).
    """
    lens, rotation = view.intrinsics, view.world_from_camera.rotation
    top, bottom = (lens.cy + 0.5) / lens.fy, (lens.cy + 0.5 - lens.height) / lens.fy
    skew = abs(lens.skew) / lens.fx * max(abs(top), abs(bottom))
    left = -(lens.cx + 0.5) / lens.fx - skew
    right = (lens.width - 0.5 - lens.cx) / lens.fx + skew
    slopes = np.array([left, right, bottom, top])
    corners = np.zeros((5, 3))
    for index, (x, y) in enumerate(((left, bottom), (left, top), (right, bottom), (right, top))):
        length = math.sqrt(1.0 + x * x + y * y)
        for axis in range(3):
            corners[index + 1, axis] = (
                reach * (rotation[axis, 0] * x + rotation[axis, 1] * y - rotation[axis, 2]) / length
            )
    # the spherical end of the view bulges beyond its corners, at most as far as the axes reach
    ends = [-reach * rotation[:, 2]]
    for axis in range(3):
        for sign in (-1.0, 1.0):
            local = sign * rotation[axis]  # the axis of W in the camera's frame
            if local[2] < 0.0:
                x, y = local[0] / -local[2], local[1] / -local[2]
                if left <= x <= right and bottom <= y <= top:
                    end = np.zeros(3)
                    end[axis] = sign * reach
                    ends.append(end)
    for x, y in ((left, 0.0), (right, 0.0), (0.0, bottom), (0.0, top)):
        length = math.sqrt(1.0 + x * x + y * y)
        direction = rotation[:, 0] * x + rotation[:, 1] * y - rotation[:, 2]
        ends.append(reach * direction / length)
    points = np.concatenate([corners, np.array(ends)])
    margin = 0.02 * reach  # of edges whose farthest point is between the points above
    box = np.stack([points.min(axis=0) - margin, points.max(axis=0) + margin])
    return box, slopes


def _find_motions(size_class: SizeClass, view: View, drift: Drift) -> Array:
    """Return the motion during the exposure as rows in the camera's frame, (2, 3).

    The displacement of the particles relative to the camera's place [m], and the rotation of the
    camera [rad].
    """
    velocity = np.array(drift.velocity) - np.array(view.velocity)
    velocity[2] += size_class.rise_speed
    rotation, time = view.world_from_camera.rotation, view.exposure_time
    angular_velocity = np.array(view.angular_velocity)
    return np.stack(
        [time * rotate_back(rotation, velocity), time * rotate_back(rotation, angular_velocity)]
    )


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
    x: float,
    y: float,
    z: float,
    diameter: float,
    weight: float,
    sizes: Array,
    motions: Array,
    slopes: Array,
    reach: float,
    value: UInt64,
    particle: npt.NDArray[np.void],
) -> bool:
    """Write a particle at a place in the camera's frame; return False if it is not in view.

    Args:
        x: the place [m]; the others alike.
        y: along the second axis.
        z: along the third axis.
        diameter: the diameter [m].
        weight: the share of its image that is drawn [1].
        sizes: the numbers of the class.
        motions: the motions during the exposure, of `_find_motions`.
        slopes: the slopes of the image's edges.
        reach: the greatest range of the largest particles [m].
        value: the hash of the particle, for its shape.
        particle: the record to write, (1,).
    """
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
    share = math.sqrt(x * x + y * y + z * z) * sizes[1] / (reach * diameter)
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
        sizes: the least and the greatest diameter [m], 1 - s, the reflectance, the kind.
        depths: the depth of the camera, and the depth over which numbers fall to 1/e [m].
        motions: the motions during the exposure, of `_find_motions`.
        particles: the records to write, (`MAX_PARTICLES`,).
    """
    key, lower, upper, edge, mean_count = cells
    eye, rotation, slopes, reach = camera
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
                        x, y, z, diameter, weight, sizes, motions, slopes, reach,
                        hash_cell(value, number, 0, 0), particles[n : n + 1],
                    ):  # fmt: skip
                        n += 1
                        if n == len(particles):
                            return n
    return n


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
        sizes: the least and the greatest diameter [m], 1 - s, the reflectance, the kind.
        motions: the motions during the exposure, of `_find_motions`.
        particles: the records to write, (`MAX_PARTICLES`,).
    """
    key, first, last, rate, time = emission
    eye, rotation, slopes, reach = camera
    source, velocity, speed = path
    n = 0
    for bubble in range(first, last + 1):
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
        if add_particle(
            x, y, z, diameter, 1.0, sizes, motions, slopes, reach, value, particles[n : n + 1]
        ):
            n += 1
            if n == len(particles):
                return n
    return n

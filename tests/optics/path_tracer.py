"""A Monte-Carlo tracer of light in water: the reference of the formulas in `uwsim.optics`.

It knows the phase function as a table and nothing of the formulas. Light leaves a source, or the
camera, along straight paths whose lengths are exponentially distributed, and is scattered at their
ends with the weight b/c. Four quantities are computed, as the tables of `reference_tables` define
them. Direct light is exact; what is traced is the scattered rest.

- `trace_spread`: a beam along the normal of a plane in a half space of water.
- `trace_led`: a point source in unbounded water. Crossings of a sphere around it stand for the
  camera, so that no term is singular.
- `trace_lamp_signal`: the irradiance of the plane, in rings around the axis of the lamp, by paths
  from the lamp; and paths from the camera that end in it.
- `trace_lamp_veil`: paths from the camera. Each straight part of a path contributes the light that
  is scattered once more on it, by a quadrature over the logarithm of the scattering angle, which
  has neither 1/r^2 nor the peak of the phase function. A share `LAMP_SHARE` of the new directions
  is drawn around the direction to the lamp; the ratio of the densities is the weight.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from uwsim.base.numerics.jit import njit
from uwsim.optics import PhaseFunction

FloatArray = npt.NDArray[np.float64]

N_SHARES = 65_537
N_ANGLES = 4096
LOG_MIN_ANGLE = math.log(1e-7)
LOG_PI = math.log(math.pi)
LAMP_SHARE = 0.3
N_WEIGHTED = 12
"""The number of collisions after which light is absorbed by chance instead of by weight."""
MAX_COLLISIONS = 300
N_BATCHES = 20
N_RINGS = 160
MAX_RING = 4.0
"""The radius of the largest ring, in units of the distance of the plane."""
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)


@dataclass(frozen=True)
class Estimate:
    """A mean with its standard error."""

    value: FloatArray
    error: FloatArray


@dataclass(frozen=True)
class PhaseTables:
    """A phase function as tables: angles of equal shares, and ln p at equal ratios of angles."""

    angles: FloatArray
    log_density: FloatArray


def tabulate(phase: PhaseFunction) -> PhaseTables:
    """Tabulate the angle as a function of the share, and ln p."""
    fine_angles = np.append(0.0, np.geomspace(1e-9, math.pi, 400_000))
    shares = phase.compute_cumulative(fine_angles)
    angles = np.interp(np.linspace(0.0, 1.0, N_SHARES), shares, fine_angles)
    log_angles = np.linspace(LOG_MIN_ANGLE, LOG_PI, N_ANGLES)
    return PhaseTables(angles, np.log(phase.compute_density(np.exp(log_angles))))


def trace_spread(
    tables: PhaseTables, depth: float, albedo: float, n_paths: int, seed: int
) -> tuple[FloatArray, FloatArray]:
    """Trace a beam to a plane at an optical depth; return weights and radii of what arrives.

    The radii are in units of the distance. The weight of a path that does not arrive is 0. Direct
    light, exp(-depth), is not in it.
    """
    return _trace_spread(np.random.default_rng(seed), tables.angles, depth, albedo, n_paths)


def trace_led(
    tables: PhaseTables,
    depth: float,
    albedo: float,
    half_angles: FloatArray,
    n_paths: int,
    seed: int,
) -> Estimate:
    """Compute the share of a Lambertian source's light within half-angles [rad], (m,)."""
    sums, squares = _trace_led(
        np.random.default_rng(seed), tables.angles, depth, albedo, np.cos(half_angles), n_paths
    )
    means = sums / n_paths
    variances = np.maximum(squares / n_paths - means**2, 0.0) / n_paths
    return Estimate(math.exp(-depth) + means, np.sqrt(variances))


@dataclass(frozen=True)
class LampScene:
    """A lamp of 1 W/sr beside the camera, in a hard cone along z, before a plane across z."""

    beam_attenuation: float
    albedo: float
    distance: float
    offset: float
    pixel: float = 0.0
    half_angle: float = math.radians(30.0)

    @property
    def ray(self) -> FloatArray:
        """The unit direction of the pixel's ray, (3,)."""
        return np.array([self.pixel, 0.0, 1.0]) / math.hypot(self.pixel, 1.0)


def trace_lamp_signal(tables: PhaseTables, scene: LampScene, n_paths: int, seed: int) -> Estimate:
    """Compute the radiance of a white plane in the light of the lamp, of its first reflection."""
    generator = np.random.default_rng(seed)
    arguments = (
        tables.angles,
        scene.beam_attenuation,
        scene.albedo,
        scene.distance,
        math.cos(scene.half_angle),
        max(n_paths // N_BATCHES, 1),
    )
    values = [
        _trace_lamp_signal(generator, *arguments, scene.offset, scene.ray) for _ in range(N_BATCHES)
    ]
    return _average(values)


def trace_lamp_veil(tables: PhaseTables, scene: LampScene, n_paths: int, seed: int) -> Estimate:
    """Compute the veil of the lamp before a black plane; all orders of scattering."""
    arguments = (
        tables.angles,
        tables.log_density,
        scene.beam_attenuation,
        scene.albedo,
        scene.distance,
        math.cos(scene.half_angle),
        scene.offset,
        scene.ray,
    )
    single_scattering = _scatter_once(
        np.zeros(3),
        scene.ray,
        tables.log_density,
        scene.beam_attenuation,
        scene.distance,
        math.cos(scene.half_angle),
        scene.offset,
        _NODES,
        _WEIGHTS,
    )
    scattering = scene.albedo * scene.beam_attenuation
    generator = np.random.default_rng(seed)
    values = [
        _trace_lamp_veil(generator, *arguments, max(n_paths // N_BATCHES, 1), _NODES, _WEIGHTS)
        for _ in range(N_BATCHES)
    ]
    rest = _average(values)
    return Estimate(scattering * (single_scattering + rest.value), scattering * rest.error)


def trace_ambient_field(
    tables: PhaseTables, depth: float, albedo: float, target_albedo: float, n_paths: int, seed: int
) -> Estimate:
    """Compute the radiance of a Lambertian plane in a uniform isotropic field of radiance 1.

    The water emits what it absorbs, which keeps the field uniform far from the plane.
    """
    generator = np.random.default_rng(seed)
    arguments = (tables.angles, depth, albedo, target_albedo, max(n_paths // N_BATCHES, 1))
    return _average([_trace_ambient_field(generator, *arguments) for _ in range(N_BATCHES)])


def _average(values: list[float]) -> Estimate:
    batches = np.array(values)
    error = np.std(batches, ddof=1) / math.sqrt(len(batches))
    return Estimate(np.asarray(batches.mean()), np.asarray(error))


@njit
def _sample_angle(angles: FloatArray, share: float) -> float:
    position = share * (len(angles) - 1)
    index = min(int(position), len(angles) - 2)
    return angles[index] + (position - index) * (angles[index + 1] - angles[index])


@njit
def _turn(direction: FloatArray, angle: float, azimuth: float) -> None:
    """Turn a unit vector by an angle, in place."""
    x, y, z = direction
    sine, cosine = math.sin(angle), math.cos(angle)
    u, v = sine * math.cos(azimuth), sine * math.sin(azimuth)
    # Two unit vectors across (Duff et al., 2017).
    sign = math.copysign(1.0, z)
    a = -1.0 / (sign + z)
    b = x * y * a
    direction[0] = u * (1.0 + sign * x * x * a) + v * b + cosine * x
    direction[1] = u * sign * b + v * (sign + y * y * a) + cosine * y
    direction[2] = -u * sign * x - v * y + cosine * z
    length = math.sqrt(direction[0] ** 2 + direction[1] ** 2 + direction[2] ** 2)
    direction /= length


@njit
def _absorb(generator: np.random.Generator, albedo: float, n_collisions: int) -> float:
    """Return the factor of the weight at a collision; 0 if the light is absorbed."""
    if n_collisions <= N_WEIGHTED:
        return albedo
    return 1.0 if generator.random() < albedo and n_collisions < MAX_COLLISIONS else 0.0


@njit
def _trace_to_plane(
    generator: np.random.Generator,
    angles: FloatArray,
    attenuation: float,
    albedo: float,
    distance: float,
    position: FloatArray,
    direction: FloatArray,
) -> float:
    """Trace light to the plane and return its weight; what is not scattered does not count.

    The first collision is before the plane, with the probability of this as a weight. Position and
    direction are changed.
    """
    reach = (distance - position[2]) / direction[2]
    probability = -math.expm1(-attenuation * reach)
    step = -math.log1p(-generator.random() * probability) / attenuation
    position += step * direction
    weight = probability
    for n_collisions in range(1, MAX_COLLISIONS + 1):
        weight *= _absorb(generator, albedo, n_collisions)
        if weight == 0.0:
            return 0.0
        angle = _sample_angle(angles, generator.random())
        _turn(direction, angle, 2.0 * math.pi * generator.random())
        step = -math.log1p(-generator.random()) / attenuation
        if direction[2] > 0.0 and position[2] + step * direction[2] >= distance:
            position += (distance - position[2]) / direction[2] * direction
            return weight
        position += step * direction
    return 0.0


@njit
def _trace_spread(
    generator: np.random.Generator, angles: FloatArray, depth: float, albedo: float, n_paths: int
) -> tuple[FloatArray, FloatArray]:
    weights, radii = np.zeros(n_paths), np.zeros(n_paths)
    position, direction = np.zeros(3), np.zeros(3)
    for i in range(n_paths):
        position[:] = 0.0
        direction[:] = 0.0
        direction[2] = 1.0
        weights[i] = _trace_to_plane(generator, angles, 1.0, albedo, depth, position, direction)
        radii[i] = math.hypot(position[0], position[1]) / depth
    return weights, radii


@njit
def _trace_ambient_field(
    generator: np.random.Generator,
    angles: FloatArray,
    depth: float,
    albedo: float,
    target_albedo: float,
    n_paths: int,
) -> float:
    total = 0.0
    position, direction = np.zeros(3), np.zeros(3)
    for _ in range(n_paths):
        position[:] = 0.0
        direction[:] = 0.0
        direction[2] = 1.0
        weight = 1.0
        while weight > 1e-4:
            step = -math.log1p(-generator.random())
            if direction[2] > 0.0 and position[2] + step * direction[2] >= depth:
                position += (depth - position[2]) / direction[2] * direction
                weight *= target_albedo
                cosine = math.sqrt(generator.random())
                azimuth = 2.0 * math.pi * generator.random()
                sine = math.sqrt(1.0 - cosine * cosine)
                direction[0], direction[1] = sine * math.cos(azimuth), sine * math.sin(azimuth)
                direction[2] = -cosine
                continue
            position += step * direction
            total += weight * (1.0 - albedo)
            weight *= albedo
            angle = _sample_angle(angles, generator.random())
            _turn(direction, angle, 2.0 * math.pi * generator.random())
    return total / n_paths


@njit
def _trace_led(
    generator: np.random.Generator,
    angles: FloatArray,
    depth: float,
    albedo: float,
    cosines: FloatArray,
    n_paths: int,
) -> tuple[FloatArray, FloatArray]:
    sums, squares = np.zeros(len(cosines)), np.zeros(len(cosines))
    scores = np.zeros(len(cosines))
    position, direction = np.zeros(3), np.zeros(3)
    for _ in range(n_paths):
        position[:] = 0.0
        direction[:] = 0.0
        direction[2] = 1.0
        scores[:] = 0.0
        weight = 1.0
        for n_collisions in range(MAX_COLLISIONS):
            step = -math.log1p(-generator.random())
            # The outward crossing of the sphere: the greater root of |position + t direction|.
            b = np.sum(position * direction)
            discriminant = b * b - np.sum(position * position) + depth * depth
            if n_collisions > 0 and discriminant > 0.0:
                crossing = -b + math.sqrt(discriminant)
                if 0.0 < crossing < step:
                    lobe = (position[2] + crossing * direction[2]) / depth
                    cosine = (b + crossing) / depth
                    if lobe > 0.0:
                        for k in range(len(cosines)):
                            if cosine >= cosines[k]:
                                scores[k] += weight * lobe
            position += step * direction
            weight *= _absorb(generator, albedo, n_collisions + 1)
            if weight == 0.0:
                break
            angle = _sample_angle(angles, generator.random())
            _turn(direction, angle, 2.0 * math.pi * generator.random())
        sums += scores
        squares += scores * scores
    return sums, squares


@njit
def _compute_direct_irradiance(
    attenuation: float, distance: float, edge_cosine: float, radius: float
) -> float:
    length = math.hypot(radius, distance)
    cosine = distance / length
    return math.exp(-attenuation * length) * cosine / length**2 if cosine >= edge_cosine else 0.0


@njit
def _trace_lamp_signal(
    generator: np.random.Generator,
    angles: FloatArray,
    attenuation: float,
    albedo: float,
    distance: float,
    edge_cosine: float,
    n_paths: int,
    offset: float,
    ray: FloatArray,
) -> float:
    irradiance = np.zeros(N_RINGS)
    position, direction = np.zeros(3), np.zeros(3)
    ring_width = MAX_RING * distance / N_RINGS
    power = 2.0 * math.pi * (1.0 - edge_cosine) / (4 * n_paths)
    for _ in range(4 * n_paths):
        cosine = 1.0 - generator.random() * (1.0 - edge_cosine)
        azimuth = 2.0 * math.pi * generator.random()
        sine = math.sqrt(1.0 - cosine * cosine)
        position[:] = 0.0
        direction[0], direction[1] = sine * math.cos(azimuth), sine * math.sin(azimuth)
        direction[2] = cosine
        weight = _trace_to_plane(
            generator, angles, attenuation, albedo, distance, position, direction
        )
        ring = int(math.hypot(position[0], position[1]) / ring_width)
        if weight > 0.0 and ring < N_RINGS:
            area = math.pi * ring_width**2 * (2 * ring + 1)
            irradiance[ring] += weight * power / area

    total = 0.0
    reach = distance / ray[2]
    for i in range(n_paths + 1):
        if i == 0:  # the direct ray
            position[:] = reach * ray
            weight = math.exp(-attenuation * reach) * n_paths
        else:
            position[:] = 0.0
            direction[:] = ray
            weight = _trace_to_plane(
                generator, angles, attenuation, albedo, distance, position, direction
            )
        if weight > 0.0:
            radius = math.hypot(position[0] - offset, position[1])
            place = max(radius / ring_width - 0.5, 0.0)
            ring = int(place)
            value = _compute_direct_irradiance(attenuation, distance, edge_cosine, radius)
            if ring < N_RINGS - 1:
                value += irradiance[ring] + (place - ring) * (
                    irradiance[ring + 1] - irradiance[ring]
                )
            total += weight * value
    return total / n_paths / math.pi


@njit
def _look_up(log_density: FloatArray, log_angle: float) -> float:
    position = (log_angle - LOG_MIN_ANGLE) * (len(log_density) - 1) / (LOG_PI - LOG_MIN_ANGLE)
    position = min(max(position, 0.0), len(log_density) - 1.000001)
    index = int(position)
    return log_density[index] + (position - index) * (log_density[index + 1] - log_density[index])


@njit
def _measure_angle(first_direction: FloatArray, second_direction: FloatArray) -> float:
    """Measure the angle between two unit vectors, exactly also if it is small."""
    x = first_direction[1] * second_direction[2] - first_direction[2] * second_direction[1]
    y = first_direction[2] * second_direction[0] - first_direction[0] * second_direction[2]
    z = first_direction[0] * second_direction[1] - first_direction[1] * second_direction[0]
    return math.atan2(math.sqrt(x * x + y * y + z * z), np.sum(first_direction * second_direction))


@njit
def _find_lit_part(
    lamp_offset: FloatArray, direction: FloatArray, end: float, edge_cosine: float
) -> tuple[float, float]:
    """Find the part of a ray inside the cone along z; positions are relative to the lamp."""
    square = edge_cosine**2
    a = direction[2] ** 2 - square
    b = direction[2] * lamp_offset[2] - square * np.sum(direction * lamp_offset)
    c = lamp_offset[2] ** 2 - square * np.sum(lamp_offset * lamp_offset)
    if abs(a) < 1e-14:
        a = 1e-14
    root = math.sqrt(max(b * b - a * c, 0.0))
    near_crossing, far_crossing = (-b - root) / a, (-b + root) / a
    if near_crossing > far_crossing:
        near_crossing, far_crossing = far_crossing, near_crossing
    if a > 0.0:
        low, high = (far_crossing, math.inf) if direction[2] > 0.0 else (-math.inf, near_crossing)
    else:
        if (
            b * b - a * c <= 0.0
            or lamp_offset[2] + 0.5 * (near_crossing + far_crossing) * direction[2] <= 0.0
        ):
            return 0.0, 0.0
        low, high = near_crossing, far_crossing
    return max(low, 0.0), min(high, end)


@njit
def _scatter_once(
    position: FloatArray,
    direction: FloatArray,
    log_density: FloatArray,
    attenuation: float,
    distance: float,
    edge_cosine: float,
    offset: float,
    nodes: FloatArray,
    weights: FloatArray,
) -> float:
    """Integrate p exp(-c (t + d)) / d^2 along a ray to the plane, inside the lamp's cone."""
    lamp_offset = position.copy()
    lamp_offset[0] -= offset
    end = math.inf
    if direction[2] > 0.0:
        end = (distance - position[2]) / direction[2]
    start, end = _find_lit_part(lamp_offset, direction, end, edge_cosine)
    if end <= start:
        return 0.0
    foot = -np.sum(lamp_offset * direction)
    foot_vector = lamp_offset + foot * direction
    height = max(math.sqrt(np.sum(foot_vector * foot_vector)), 1e-9)
    # The scattering angle is that between the ray and the direction from the lamp, reversed.
    low = math.log(max(math.atan2(height, foot - start), 1e-7))
    high = math.log(max(math.atan2(height, foot - end), 1e-7))
    total = 0.0
    for k in range(len(nodes)):
        log_angle = 0.5 * (low + high) + 0.5 * (high - low) * nodes[k]
        angle = math.exp(log_angle)
        sine = math.sin(angle)
        path = foot - height * math.cos(angle) / sine + height / sine
        total += weights[k] * math.exp(
            _look_up(log_density, log_angle) + log_angle - attenuation * path
        )
    return 0.5 * (high - low) * total / height


@njit
def _trace_lamp_veil(
    generator: np.random.Generator,
    angles: FloatArray,
    log_density: FloatArray,
    attenuation: float,
    albedo: float,
    distance: float,
    edge_cosine: float,
    offset: float,
    ray: FloatArray,
    n_paths: int,
    nodes: FloatArray,
    weights: FloatArray,
) -> float:
    total = 0.0
    position, direction, to_lamp, new_direction = np.zeros(3), np.zeros(3), np.zeros(3), np.zeros(3)
    reach = distance / ray[2]
    probability = -math.expm1(-attenuation * reach)
    for _ in range(n_paths):
        direction[:] = ray
        step = -math.log1p(-generator.random() * probability) / attenuation
        position[:] = step * direction
        weight = probability
        for n_collisions in range(1, MAX_COLLISIONS + 1):
            weight *= _absorb(generator, albedo, n_collisions)
            if weight == 0.0:
                break
            to_lamp[:] = -position
            to_lamp[0] += offset
            to_lamp /= math.sqrt(np.sum(to_lamp * to_lamp))
            new_direction[:] = to_lamp if generator.random() < LAMP_SHARE else direction
            angle = _sample_angle(angles, generator.random())
            _turn(new_direction, angle, 2.0 * math.pi * generator.random())
            log_scattered_density = _look_up(
                log_density, math.log(_measure_angle(new_direction, direction) + 1e-12)
            )
            log_drawn_density = _look_up(
                log_density, math.log(_measure_angle(new_direction, to_lamp) + 1e-12)
            )
            weight /= (
                1.0
                - LAMP_SHARE
                + LAMP_SHARE * math.exp(min(log_drawn_density - log_scattered_density, 500.0))
            )
            direction[:] = new_direction
            if weight < 1e-12:
                break
            total += weight * _scatter_once(
                position,
                direction,
                log_density,
                attenuation,
                distance,
                edge_cosine,
                offset,
                nodes,
                weights,
            )
            step = -math.log1p(-generator.random()) / attenuation
            position += step * direction
            if position[2] >= distance:
                break
    return total / n_paths

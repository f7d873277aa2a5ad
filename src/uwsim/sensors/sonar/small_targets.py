r"""Echoes of targets that are small relative to the angle between neighbouring rays.

The rays of the grid may pass beside a small target, or beside the glint on it, which is as wide as
the slope of its facets times its radius of curvature. Surfaces are therefore covered by balls
(`uwsim.rays.cover`). Where a ball is less than `MAX_RAY_SPACINGS` rays wide, a lattice of about
`N_RAYS_ACROSS` rays over the ball replaces the grid. Each beam weights each ray by its pattern:

.. math:: P_b = \sum_k G(\phi_k - \phi_b)\, L(e_k)\, d\Omega_k\, \sigma_k
          \frac{10^{-2 \alpha r_k / 10}}{r_k^2 \cos\theta_k} ,

with the azimuth :math:`\phi_k`, the elevation :math:`e_k`, the solid angle :math:`d\Omega_k`, the
range :math:`r_k` and the angle of incidence :math:`\theta_k` of the ray k, the azimuth
:math:`\phi_b` of the beam, its horizontal and vertical two-way patterns G and L, the backscattering
cross section per area :math:`\sigma_k` and the absorption :math:`\alpha`.

The lattice is rotated relative to rows and columns, so that straight edges do not lie between its
lines. Hits of rays of the grid inside the balls are ignored.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ...base.geometry import Array, Pose
from ...base.numerics.elementwise import arcsin, arctan2
from ...base.numerics.jit import njit
from ...base.numerics.linear import product
from ...rays import Balls, Hits
from .kernel import MIN_COSINE, Integers, Singles, backscatter, facing_cosine, spread_echo
from .ray_grid import MARGIN, RayGrid, beam_pattern, line_pattern

MAX_RAY_SPACINGS = 8.0
"""The largest radius of a small target, relative to the angle between neighbouring rays [1]."""
N_RAYS_ACROSS = 48
"""The number of rays across a small target."""
MAX_RADIUS = math.radians(20.0)
"""The greatest angular radius of a small target [rad]."""
MAX_ELEVATION = math.radians(85.0)
"""The greatest elevation of a small target, up or down [rad]."""
MAX_RAYS = 4096
"""The largest number of rays to all small targets of a ping; lattices become coarser beyond it."""
TURN = (0.85, math.sqrt(1.0 - 0.85**2))
"""The cosine and the sine of the angle between a lattice and the rows of the grid."""
ANGLE_TOLERANCE = 1e-6
"""The tolerance for rounding in tests that accept or skip rays early [rad]."""
COSINE_TOLERANCE = 1e-14
"""The tolerance for rounding of a cosine."""
MAX_SLANT = 10.0
"""The tangent of the angle of incidence up to which an echo is spread over range."""


class Fan(NamedTuple):
    """The beams of a sonar, for compiled code."""

    first_azimuth: float
    """The azimuth of the first beam [rad]."""
    step: float
    """The angle between beams [rad]."""
    n: int
    """The number of beams."""
    width: float
    """The horizontal width of a beam at -3 dB of the two-way pattern [rad]."""
    aperture: float
    """The vertical width of a beam at -3 dB of the one-way pattern [rad]."""


class Discs(NamedTuple):
    """The small targets in a sonar's view; the discs of one surface are adjacent in the arrays."""

    azimuth: Array
    """The azimuths of the centres, (m,) [rad]."""
    elevation: Array
    """The elevations of the centres, (m,) [rad]."""
    radius: Array
    """The angular radii, (m,) [rad]."""
    direction: Array
    """The directions of the centres, unit vectors in the sonar's frame, (m, 3)."""
    surface: Integers
    """The indices of the surfaces, (m,)."""


class Lattice(NamedTuple):
    """The rays to small targets."""

    directions: Array
    """The directions of the rays, unit vectors in the sonar's frame, (n, 3)."""
    angles: Array
    """The azimuth, elevation and angle to neighbours [rad], and the solid angle [sr], (n, 4)."""
    surface: Integers
    """The index of the surface that each ray is to hit, (n,)."""


def find_discs(balls: Balls, world_from_sonar: Pose, reach: float, grid: RayGrid) -> Discs:
    """Return the balls that are small relative to the angle between the grid's rays near them."""
    offset = balls.centre - world_from_sonar.position
    centre = product(offset, world_from_sonar.rotation)
    distance = np.sqrt((centre * centre).sum(axis=1))
    is_near = (distance > 2.0 * balls.radius) & (distance - balls.radius < reach)
    is_near &= balls.radius > 0.0
    centre, distance = centre[is_near], distance[is_near]
    direction = centre / distance[:, None]
    radius = arcsin(balls.radius[is_near] / distance)
    elevation = arcsin(np.clip(direction[:, 2], -1.0, 1.0))
    is_small = (radius < MAX_RAY_SPACINGS * grid.spacing(elevation)) & (radius < MAX_RADIUS)
    is_small &= np.abs(elevation) + radius < MAX_ELEVATION
    direction = np.ascontiguousarray(direction[is_small])
    azimuth = arctan2(direction[:, 1], direction[:, 0])
    return Discs(
        azimuth, elevation[is_small], radius[is_small], direction, balls.surface[is_near][is_small]
    )


def create_lattice(discs: Discs, fan: Fan, max_elevation: float) -> Lattice:
    """Create rays over discs, in directions from which a beam receives echoes.

    Args:
        discs: the small targets.
        fan: the beams.
        max_elevation: the elevation beyond which no beam receives echoes [rad].
    """
    spacing = 2.0 / N_RAYS_ACROSS * np.sqrt(discs.radius**2)
    starts = np.flatnonzero(np.diff(discs.surface, prepend=-1))
    ends = np.append(starts[1:], len(spacing))
    for k in np.flatnonzero(ends - starts > 1).tolist():
        begin, end = starts[k], ends[k]
        mean_square = float((discs.radius[begin:end] ** 2).mean())
        spacing[begin:end] = 2.0 / N_RAYS_ACROSS * math.sqrt(mean_square)
    n = int(_fill(discs, spacing, fan, max_elevation, *_NO_RAYS))
    if n > MAX_RAYS:
        spacing *= math.sqrt(n / MAX_RAYS)
        n = int(_fill(discs, spacing, fan, max_elevation, *_NO_RAYS))
    rays = Lattice(np.empty((n, 3)), np.empty((n, 4)), np.empty(n, dtype=np.int32))
    _fill(discs, spacing, fan, max_elevation, *rays)
    return rays


_NO_RAYS = Lattice(np.empty((0, 3)), np.empty((0, 4)), np.empty(0, dtype=np.int32))


class Edge(NamedTuple):
    """Bounds that decide without exact trigonometry whether a direction is inside a disc."""

    max_inside: float
    """The squared sine of half the angle to the centre, below which a direction is inside."""
    min_outside: float
    """The squared sine of half the angle to the centre, above which a direction is outside."""
    max_product: float
    """The greatest product of the cosines of the elevations of the centre and of a direction."""
    min_product: float
    """The minimum product of these cosines."""


@njit
def _edge_of(elevation: float, radius: float) -> Edge:
    """Return the bounds for a disc, by the elevation of its centre [rad] and its radius [rad]."""
    square, middle = math.sin(0.5 * radius) ** 2, math.cos(elevation)
    return Edge(
        square * (1.0 - ANGLE_TOLERANCE) - COSINE_TOLERANCE,
        square * (1.0 + ANGLE_TOLERANCE) + COSINE_TOLERANCE,
        middle * math.cos(max(abs(elevation) - radius - ANGLE_TOLERANCE, 0.0)),
        middle * math.cos(abs(elevation) + radius + ANGLE_TOLERANCE),
    )


@njit
def _side(edge: Edge, up: float, right: float) -> int:
    r"""Return -1 for a direction inside a disc, 1 outside; 0 if the bounds do not decide it.

    The bounds are :math:`x^2/4\,(1 - x^2/12) \le \sin^2 x/2 \le x^2/4`.

    Args:
        edge: the bounds for the disc.
        up: the elevation of the direction relative to the centre [rad].
        right: the azimuth of the direction relative to the centre [rad].
    """
    u, v = 0.25 * up * up, 0.25 * right * right
    if u * (1.0 - u / 3.0) + edge.min_product * v * (1.0 - v / 3.0) > edge.min_outside:
        return 1
    return -1 if u + edge.max_product * v < edge.max_inside else 0


@njit
def _fill(
    discs: Discs,
    spacing: Array,
    fan: Fan,
    max_elevation: float,
    directions: Array,
    angles: Array,
    surface: Integers,
) -> int:
    """Write as many rays of a lattice as the arrays can hold; return their total number."""
    count, begin = 0, 0
    cosine, sine = TURN
    for disc in range(len(discs.radius)):
        if discs.surface[disc] != discs.surface[begin]:
            begin = disc
        step, radius = spacing[disc], discs.radius[disc]
        half_width = math.asin(min(1.0, math.sin(radius) / math.cos(discs.elevation[disc])))
        if abs(
            discs.elevation[disc]
        ) - radius > max_elevation + ANGLE_TOLERANCE or not _may_be_received(
            discs.azimuth[disc], half_width, fan
        ):
            continue
        is_whole = abs(
            discs.elevation[disc]
        ) + radius < max_elevation - ANGLE_TOLERANCE and _is_all_received(
            discs.azimuth[disc], half_width, fan
        )
        parallel_scale = math.cos(discs.elevation[begin])
        min_cosine = math.cos(radius)
        # the lattice of a surface goes through the centre of its first disc
        azimuth_offset = _wrap_angle(discs.azimuth[disc] - discs.azimuth[begin])
        right = azimuth_offset * parallel_scale
        up = discs.elevation[disc] - discs.elevation[begin]
        i0 = round((cosine * right + sine * up) / step)
        j0 = round((cosine * up - sine * right) / step)
        max_width = half_width * parallel_scale
        reach = math.ceil(1.5 * max(radius, max_width) / step) + 1
        edge = _edge_of(discs.elevation[disc], radius)
        for i in range(i0 - reach, i0 + reach + 1):
            for j in range(j0 - reach, j0 + reach + 1):
                azimuth = discs.azimuth[begin] + step * (cosine * i - sine * j) / parallel_scale
                elevation = discs.elevation[begin] + step * (sine * i + cosine * j)
                azimuth_error = azimuth - discs.azimuth[begin] - azimuth_offset
                elevation_error = elevation - discs.elevation[disc]
                if (
                    abs(elevation_error) > radius + ANGLE_TOLERANCE
                    or abs(azimuth_error) > half_width + ANGLE_TOLERANCE
                ):
                    continue
                if not is_whole and (
                    abs(elevation) > max_elevation or not _is_received(azimuth, fan)
                ):
                    continue
                side = _side(edge, elevation_error, azimuth_error)
                if side > 0:
                    continue
                if side < 0 and begin == disc and count >= len(surface):
                    count += 1
                    continue
                horizontal_length = math.cos(elevation)
                x, y, z = (
                    horizontal_length * math.cos(azimuth),
                    horizontal_length * math.sin(azimuth),
                    math.sin(elevation),
                )
                if _disc_cosine(discs.direction, disc, x, y, z) < min_cosine:
                    continue
                is_in_other_disc = False
                for other in range(begin, disc):
                    if _disc_cosine(discs.direction, other, x, y, z) >= math.cos(
                        discs.radius[other]
                    ):
                        is_in_other_disc = True
                        break
                if is_in_other_disc:
                    continue
                if count < len(surface):
                    directions[count, 0], directions[count, 1], directions[count, 2] = x, y, z
                    angles[count, 0], angles[count, 1] = azimuth, elevation
                    angles[count, 2], angles[count, 3] = (
                        step,
                        step * step / parallel_scale * horizontal_length,
                    )
                    surface[count] = discs.surface[disc]
                count += 1
    return count


@njit
def _disc_cosine(direction: Array, disc: int, x: float, y: float, z: float) -> float:
    """Return the cosine of the angle between a direction and the centre of a disc."""
    cosine: float = direction[disc, 0] * x + direction[disc, 1] * y + direction[disc, 2] * z
    return cosine


@njit
def _wrap_angle(angle: float) -> float:
    """Return an angle between -pi and pi that differs by full turns [rad]."""
    return angle - 2.0 * math.pi * round(angle / (2.0 * math.pi))


@njit
def _may_be_received(azimuth: float, half_width: float, fan: Fan) -> bool:
    """Return True if a beam may receive an echo from within an angle of an azimuth [rad]."""
    return _is_between_beams(azimuth, MARGIN * fan.width + half_width + ANGLE_TOLERANCE, fan)


@njit
def _is_all_received(azimuth: float, half_width: float, fan: Fan) -> bool:
    """Return True if beams receive all echoes from within an angle of an azimuth [rad]."""
    has_gaps = abs(fan.step) > 2.0 * MARGIN * fan.width
    return not has_gaps and _is_between_beams(
        azimuth, MARGIN * fan.width - half_width - ANGLE_TOLERANCE, fan
    )


@njit
def _is_between_beams(azimuth: float, margin: float, fan: Fan) -> bool:
    """Return True if an azimuth is between the outermost beams, or within a margin [rad]."""
    end = fan.first_azimuth + (fan.n - 1) * fan.step
    low, high = min(fan.first_azimuth, end) - margin, max(fan.first_azimuth, end) + margin
    is_within = False
    for n_turns in (-1.0, 0.0, 1.0):
        is_within |= low <= azimuth + 2.0 * math.pi * n_turns <= high
    return is_within


@njit
def _is_received(azimuth: float, fan: Fan) -> bool:
    """Return True if a beam receives echoes from an azimuth [rad]."""
    margin = MARGIN * fan.width
    for n_turns in (-1.0, 0.0, 1.0):
        first_beam, last_beam = _beam_range(azimuth + 2.0 * math.pi * n_turns, margin, fan)
        if first_beam <= last_beam:
            return True
    return False


@njit
def _beam_range(azimuth: float, margin: float, fan: Fan) -> tuple[int, int]:
    """Return the first and last beam within a margin of an azimuth [rad]; none if last < first."""
    first_beam = math.ceil((azimuth - margin - fan.first_azimuth) / fan.step)
    last_beam = math.floor((azimuth + margin - fan.first_azimuth) / fan.step)
    return max(first_beam, 0), min(last_beam, fan.n - 1)


@njit
def drop_hits(distance: Array, surface: Integers, directions: Array, discs: Discs) -> None:
    """Set the distance of hits to infinity where the lattice of a small target replaces them."""
    n = len(discs.surface)
    if n == 0:
        return
    starts = np.full(discs.surface.max() + 1, n)
    for disc in range(n - 1, -1, -1):
        starts[discs.surface[disc]] = disc
    for k in range(len(distance)):
        if distance[k] == np.inf or not 0 <= surface[k] < len(starts):
            continue
        for disc in range(starts[surface[k]], n):
            if surface[k] != discs.surface[disc]:
                break
            x, y, z = directions[k, 0], directions[k, 1], directions[k, 2]
            if _disc_cosine(discs.direction, disc, x, y, z) >= math.cos(discs.radius[disc]):
                distance[k] = np.inf
                break


@njit
def add_small_echoes(
    power: Singles,
    hits: Hits,
    rays: Lattice,
    fan: Fan,
    level: float,
    materials: Array,
    bins: tuple[float, float, float],
) -> None:
    """Add the power of the echoes of small targets to the bins of each beam.

    Args:
        power: the power in each bin and beam, to which echoes are added, (bins, n) [Pa2].
        hits: the distance (m,), normal in the sonar's frame (m, 3) and surface (m,) of each hit.
        rays: the rays to the small targets.
        fan: the beams.
        level: the power of the ping at 1 m on the axis of a beam [Pa2 m2].
        materials: the glint, sharpness of the glint and diffuse part of each surface, (m, 3).
        bins: the minimum range [m], the size of a bin [m], and the two-way absorption [1/m, neper
            of power].
    """
    distance, normal, surface = hits
    start, size, loss = bins
    margin = MARGIN * fan.width
    for k in range(len(distance)):
        r = distance[k]
        if r == np.inf or surface[k] != rays.surface[k]:
            continue
        cosine = max(facing_cosine(normal, rays.directions, k, k), MIN_COSINE)
        sigma, _ = backscatter(materials[surface[k]], cosine)
        pattern = line_pattern(rays.angles[k, 1], fan.aperture) ** 4 * rays.angles[k, 3]
        echo = level * pattern * sigma * math.exp(-loss * r) / (r * r * cosine)
        slant = min(math.sqrt(1.0 - min(cosine, 1.0) ** 2) / cosine, MAX_SLANT)
        half = 0.5 * rays.angles[k, 2] * r * slant
        near, far = (r - half - start) / size, (r + half - start) / size
        for n_turns in (-1.0, 0.0, 1.0):
            azimuth = rays.angles[k, 0] + 2.0 * math.pi * n_turns
            begin, last_beam = _beam_range(azimuth, margin, fan)
            for beam in range(begin, last_beam + 1):
                weight = beam_pattern(azimuth - fan.first_azimuth - beam * fan.step, fan.width)
                spread_echo(power[:, beam], echo * weight, near, far, 0.0)

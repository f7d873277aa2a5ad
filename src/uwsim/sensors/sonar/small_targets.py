r"""Echoes of targets that are small against the distance of neighbouring rays.

The rays of the grid may pass beside a small target, or beside the glint on it, which is as wide as
the slope of its facets times its radius of curvature. Surfaces are therefore covered by balls
(`uwsim.rays.cover`); where a ball is less than `FEW` rays wide, the grid is replaced by a lattice
of about `ACROSS` rays over the ball, and each beam weights each of these rays by its pattern:

.. math:: P_b = \sum_k G(\phi_k - \phi_b)\, L(e_k)\, d\Omega_k\, \sigma_k
          \frac{10^{-2 \alpha r_k / 10}}{r_k^2 \cos\theta_k} .

The lattice is turned against rows and columns, so that straight edges do not fall between its
lines. Rays of the grid that meet the surface within the balls do not count.
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
from .kernel import GRAZING, Singles, Whole, backscatter, facing_cosine, spread_echo
from .ray_grid import MARGIN, RayGrid, beam_pattern, line_pattern

FEW = 8.0
"""A target is small if its radius is less than so many distances of rays."""
ACROSS = 48
"""Rays across a small target."""
MAX_RADIUS = math.radians(20.0)
"""The greatest angular radius of a small target [rad]."""
STEEPEST = math.radians(85.0)
"""A small target is not higher or lower [rad]."""
MAX_RAYS = 4096
"""Rays to all small targets of a ping at most; lattices become coarser beyond it."""
TURN = (0.85, math.sqrt(1.0 - 0.85**2))
"""Cosine and sine of the angle between a lattice and the rows."""
SURE = 1e-6
"""Room for rounding where a whole target is passed over [rad]."""
TINY = 1e-14
"""Room for rounding of a cosine."""
MAX_SLANT = 10.0
"""Tangent of the angle of incidence up to which an echo is spread over range."""


class Fan(NamedTuple):
    """The beams of a sonar, for compiled code."""

    first: float
    """Azimuth of the first beam [rad]."""
    step: float
    """Between beams [rad]."""
    n: int
    """How many they are."""
    width: float
    """Of a beam between the points of half power [rad]."""
    aperture: float
    """Height of a beam between the points of half power, one way [rad]."""


class Discs(NamedTuple):
    """What small targets cover, seen from a sonar; discs of one surface are neighbours."""

    azimuth: Array
    """Of the middle, (m,) [rad]."""
    elevation: Array
    """Of the middle, (m,) [rad]."""
    radius: Array
    """(m,) [rad]."""
    direction: Array
    """Of the middle in the sonar's frame, (m, 3)."""
    surface: Whole
    """Number of the surface, (m,)."""


class Lattice(NamedTuple):
    """Rays to small targets."""

    directions: Array
    """In the sonar's frame, (n, 3)."""
    angles: Array
    """Azimuth, elevation, distance of neighbouring rays [rad] and solid angle [sr], (n, 4)."""
    surface: Whole
    """Number of the surface that each ray is for, (n,)."""


def find_discs(balls: Balls, world_from_sonar: Pose, reach: float, grid: RayGrid) -> Discs:
    """Return the balls that are small against the distance of rays where they are."""
    offset = balls.centre - world_from_sonar.position
    centre = product(offset, world_from_sonar.rotation)
    distance = np.sqrt((centre * centre).sum(axis=1))
    near = (distance > 2.0 * balls.radius) & (distance - balls.radius < reach)
    near &= balls.radius > 0.0
    centre, distance = centre[near], distance[near]
    direction = centre / distance[:, None]
    radius = arcsin(balls.radius[near] / distance)
    elevation = arcsin(np.clip(direction[:, 2], -1.0, 1.0))
    small = (radius < FEW * grid.spacing(elevation)) & (radius < MAX_RADIUS)
    small &= np.abs(elevation) + radius < STEEPEST
    direction = np.ascontiguousarray(direction[small])
    azimuth = arctan2(direction[:, 1], direction[:, 0])
    return Discs(azimuth, elevation[small], radius[small], direction, balls.surface[near][small])


def lattice(discs: Discs, fan: Fan, highest: float) -> Lattice:
    """Lay rays over discs, where the beams receive anything.

    Args:
        discs: of the small targets.
        fan: the beams.
        highest: elevation beyond which nothing is received [rad].
    """
    spacing = 2.0 / ACROSS * np.sqrt(discs.radius**2)
    begins = np.flatnonzero(np.diff(discs.surface, prepend=-1))
    ends = np.append(begins[1:], len(spacing))
    for k in np.flatnonzero(ends - begins > 1).tolist():
        begin, end = begins[k], ends[k]
        mean_square = float((discs.radius[begin:end] ** 2).mean())
        spacing[begin:end] = 2.0 / ACROSS * math.sqrt(mean_square)
    n = int(_fill(discs, spacing, fan, highest, *_NO_RAYS))
    if n > MAX_RAYS:
        spacing *= math.sqrt(n / MAX_RAYS)
        n = int(_fill(discs, spacing, fan, highest, *_NO_RAYS))
    rays = Lattice(np.empty((n, 3)), np.empty((n, 4)), np.empty(n, dtype=np.int32))
    _fill(discs, spacing, fan, highest, *rays)
    return rays


_NO_RAYS = Lattice(np.empty((0, 3)), np.empty((0, 4)), np.empty(0, dtype=np.int32))


class Edge(NamedTuple):
    """Bounds by which a direction is surely within a disc or beyond its edge."""

    within: float
    """Of the squared sine of half its angle to the middle, if it is within."""
    beyond: float
    """The same if it is beyond."""
    most: float
    """Of the product of the cosines of both elevations."""
    least: float
    """The same, from below."""


@njit
def _edge_of(elevation: float, radius: float) -> Edge:
    """The bounds of a disc, by the elevation of its middle and its radius [rad]."""
    square, middle = math.sin(0.5 * radius) ** 2, math.cos(elevation)
    return Edge(
        square * (1.0 - SURE) - TINY,
        square * (1.0 + SURE) + TINY,
        middle * math.cos(max(abs(elevation) - radius - SURE, 0.0)),
        middle * math.cos(abs(elevation) + radius + SURE),
    )


@njit
def _side(edge: Edge, above: float, away: float) -> int:
    r"""Whether a direction is within a disc, -1, or beyond, 1; 0 if that has to be computed.

    By :math:`x^2/4\,(1 - x^2/12) \le \sin^2 x/2 \le x^2/4`, with its elevation and its azimuth
    from the middle [rad].
    """
    up, across = 0.25 * above * above, 0.25 * away * away
    if up * (1.0 - up / 3.0) + edge.least * across * (1.0 - across / 3.0) > edge.beyond:
        return 1
    return -1 if up + edge.most * across < edge.within else 0


@njit
def _fill(
    discs: Discs,
    spacing: Array,
    fan: Fan,
    highest: float,
    directions: Array,
    angles: Array,
    surface: Whole,
) -> int:
    """Fill in the rays of a lattice as far as there is room; return how many there are."""
    count, begin = 0, 0
    cosine, sine = TURN
    for disc in range(len(discs.radius)):
        if discs.surface[disc] != discs.surface[begin]:
            begin = disc
        step, radius = spacing[disc], discs.radius[disc]
        broad = math.asin(min(1.0, math.sin(radius) / math.cos(discs.elevation[disc])))
        if abs(discs.elevation[disc]) - radius > highest + SURE or not _may_be_received(
            discs.azimuth[disc], broad, fan
        ):
            continue
        is_whole = abs(discs.elevation[disc]) + radius < highest - SURE and _is_all_received(
            discs.azimuth[disc], broad, fan
        )
        shrink = math.cos(discs.elevation[begin])
        least = math.cos(radius)
        # the lattice of a surface goes through the middle of its first disc
        aside = _wrapped(discs.azimuth[disc] - discs.azimuth[begin])
        right = aside * shrink
        up = discs.elevation[disc] - discs.elevation[begin]
        i0 = round((cosine * right + sine * up) / step)
        j0 = round((cosine * up - sine * right) / step)
        widest = broad * shrink
        reach = math.ceil(1.5 * max(radius, widest) / step) + 1
        edge = _edge_of(discs.elevation[disc], radius)
        for i in range(i0 - reach, i0 + reach + 1):
            for j in range(j0 - reach, j0 + reach + 1):
                azimuth = discs.azimuth[begin] + step * (cosine * i - sine * j) / shrink
                elevation = discs.elevation[begin] + step * (sine * i + cosine * j)
                away = azimuth - discs.azimuth[begin] - aside
                above = elevation - discs.elevation[disc]
                if abs(above) > radius + SURE or abs(away) > broad + SURE:
                    continue
                if not is_whole and (abs(elevation) > highest or not _is_received(azimuth, fan)):
                    continue
                side = _side(edge, above, away)
                if side > 0:
                    continue
                if side < 0 and begin == disc and count >= len(surface):
                    count += 1
                    continue
                level = math.cos(elevation)
                x, y, z = level * math.cos(azimuth), level * math.sin(azimuth), math.sin(elevation)
                if _along(discs.direction, disc, x, y, z) < least:
                    continue
                is_taken = False
                for earlier in range(begin, disc):
                    if _along(discs.direction, earlier, x, y, z) >= math.cos(discs.radius[earlier]):
                        is_taken = True
                        break
                if is_taken:
                    continue
                if count < len(surface):
                    directions[count, 0], directions[count, 1], directions[count, 2] = x, y, z
                    angles[count, 0], angles[count, 1] = azimuth, elevation
                    angles[count, 2], angles[count, 3] = step, step * step / shrink * level
                    surface[count] = discs.surface[disc]
                count += 1
    return count


@njit
def _along(direction: Array, disc: int, x: float, y: float, z: float) -> float:
    """Cosine of the angle between a direction and the middle of a disc."""
    cosine: float = direction[disc, 0] * x + direction[disc, 1] * y + direction[disc, 2] * z
    return cosine


@njit
def _wrapped(angle: float) -> float:
    """The angle between -pi and pi [rad]."""
    return angle - 2.0 * math.pi * round(angle / (2.0 * math.pi))


@njit
def _may_be_received(azimuth: float, broad: float, fan: Fan) -> bool:
    """Whether any beam may receive anything within an angle from an azimuth [rad]."""
    return _is_beside(azimuth, MARGIN * fan.width + broad + SURE, fan)


@njit
def _is_all_received(azimuth: float, broad: float, fan: Fan) -> bool:
    """Whether some beam receives whatever is within an angle from an azimuth [rad]."""
    has_gaps = abs(fan.step) > 2.0 * MARGIN * fan.width
    return not has_gaps and _is_beside(azimuth, MARGIN * fan.width - broad - SURE, fan)


@njit
def _is_beside(azimuth: float, margin: float, fan: Fan) -> bool:
    """Whether an azimuth is between the first beam and the last, or within a margin [rad]."""
    last = fan.first + (fan.n - 1) * fan.step
    low, high = min(fan.first, last) - margin, max(fan.first, last) + margin
    is_within = False
    for turn in (-1.0, 0.0, 1.0):
        is_within |= low <= azimuth + 2.0 * math.pi * turn <= high
    return is_within


@njit
def _is_received(azimuth: float, fan: Fan) -> bool:
    """Whether any beam receives anything from an azimuth [rad]."""
    margin = MARGIN * fan.width
    for turn in (-1.0, 0.0, 1.0):
        first, last = _beams(azimuth + 2.0 * math.pi * turn, margin, fan)
        if first <= last:
            return True
    return False


@njit
def _beams(azimuth: float, margin: float, fan: Fan) -> tuple[int, int]:
    """The first and the last beam within a margin of an azimuth [rad]; last < first: none."""
    first = math.ceil((azimuth - margin - fan.first) / fan.step)
    last = math.floor((azimuth + margin - fan.first) / fan.step)
    return max(first, 0), min(last, fan.n - 1)


@njit
def drop_hits(distance: Array, surface: Whole, directions: Array, discs: Discs) -> None:
    """Set the distance of those hits to infinity that the lattice of a small target replaces."""
    n = len(discs.surface)
    if n == 0:
        return
    begins = np.full(discs.surface.max() + 1, n)
    for disc in range(n - 1, -1, -1):
        begins[discs.surface[disc]] = disc
    for k in range(len(distance)):
        if distance[k] == np.inf or not 0 <= surface[k] < len(begins):
            continue
        for disc in range(begins[surface[k]], n):
            if surface[k] != discs.surface[disc]:
                break
            x, y, z = directions[k, 0], directions[k, 1], directions[k, 2]
            if _along(discs.direction, disc, x, y, z) >= math.cos(discs.radius[disc]):
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
        power: of each bin and beam, (bins, n); added to [Pa2].
        hits: distance (m,), normal in the sonar's frame (m, 3), surface (m,) of the rays.
        rays: to the small targets.
        fan: the beams.
        level: power of the ping at 1 m on the axis of a beam [Pa2 m2].
        materials: of each surface glint, sharpness of the glint and diffuse part, (m, 3).
        bins: least range, size of a bin [m], absorption there and back [1/m, neper of power].
    """
    distance, normal, surface = hits
    first, size, loss = bins
    margin = MARGIN * fan.width
    for k in range(len(distance)):
        r = distance[k]
        if r == np.inf or surface[k] != rays.surface[k]:
            continue
        cosine = max(facing_cosine(normal, rays.directions, k, k), GRAZING)
        sigma, _ = backscatter(materials[surface[k]], cosine)
        pattern = line_pattern(rays.angles[k, 1], fan.aperture) ** 4 * rays.angles[k, 3]
        echo = level * pattern * sigma * math.exp(-loss * r) / (r * r * cosine)
        slant = min(math.sqrt(1.0 - min(cosine, 1.0) ** 2) / cosine, MAX_SLANT)
        half = 0.5 * rays.angles[k, 2] * r * slant
        near, far = (r - half - first) / size, (r + half - first) / size
        for turn in (-1.0, 0.0, 1.0):
            azimuth = rays.angles[k, 0] + 2.0 * math.pi * turn
            begin, last = _beams(azimuth, margin, fan)
            for beam in range(begin, last + 1):
                weight = beam_pattern(azimuth - fan.first - beam * fan.step, fan.width)
                spread_echo(power[:, beam], echo * weight, near, far, 0.0)

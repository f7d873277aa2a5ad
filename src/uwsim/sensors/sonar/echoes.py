r"""A ping: rays in the sonar's beam pattern, their echoes in range bins, speckle and noise.

The echo level EL of a surface element follows from the sonar equation,

.. math:: EL = SL - 2 (20 \log r + \alpha r) + TS + D ,

with the source level SL, the range r, the absorption :math:`\alpha`, the target strength TS and the
two-way beam pattern D: vertically that of a uniform line array, :math:`(\sin u / u)^4`,
horizontally a Gaussian. The echoes in a bin of a beam come from many scatterers with random phases:
their amplitude has a Rayleigh distribution around the root of the mean power, which is the sum of
the powers of all echoes and of the noise.

With ``multipath``, rays also reach targets by reflection at the water's surface, and their echoes
return on the same path. They are cast from the mirror image of the sonar.
"""

from __future__ import annotations

import math
from functools import cache, lru_cache
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ...acoustics import MATERIALS, Material
from ...base.geometry import Array, Pose
from ...base.numerics.elementwise import log
from ...base.numerics.linear import product, rotate_back
from ...rays import Hits
from ...world import SensorWorld
from .kernel import Singles, add_echoes, compute_amplitudes
from .ray_grid import RayGrid
from .small_targets import Fan, Lattice, add_small_echoes, create_lattice, drop_hits, find_discs
from .spec import SonarSpec

SURFACE_REFLECTION = 0.631
"""The fraction of the power that a reflection at the water's surface retains [1]: -2 dB, for small
waves."""
MICROPASCAL = -120.0
"""The level of one micropascal [dB re 1 Pa]."""


class Power(NamedTuple):
    """The mean power of the echoes of a ping."""

    columns: Singles
    """The power in each range bin of each column of rays, (bins, m) [Pa2]; beams are sums of
    columns, weighted by their patterns."""
    small_targets: Singles
    """The power of small targets in each bin and beam, (bins, n) [Pa2]; (0, 0) without any."""


class Ping(NamedTuple):
    """The parameters of all rays of a ping."""

    world_from_sonar: Pose
    """The pose of the sonar."""
    level: float
    """The power at 1 m on the axis of a beam [Pa2 m2]."""
    materials: Array
    """The material of each surface, as for `add_echoes`, (m, 3); the last is the water's
    surface."""
    bins: tuple[float, float, float]
    """The minimum range [m], the bin size [m], and the two-way absorption [1/m, neper of power]."""


class Scan(NamedTuple):
    """The hits of the rays of a ping."""

    hits: Hits
    """The hits of the rays of the grid, outside of small targets."""
    to_surface: Array
    """The distance to the water's surface of each ray of the grid, (n,) [m]; inf: none."""
    small_targets: tuple[Lattice, Hits] | None
    """The rays to small targets and their hits; None: there are no small targets."""

    @property
    def all_hits(self) -> tuple[Hits, ...]:
        """The hits of the grid, and those of small targets."""
        return (self.hits,) if self.small_targets is None else (self.hits, self.small_targets[1])


class Echoes:
    """The echoes of a sonar's pings.

    Args:
        spec: the spec of the sonar.
        world: the world.
        azimuths: the azimuths of its beams, at equal steps, positive to port, (n,) [rad].
        step: the angle between beams, positive [rad]; for a single beam, the greatest spacing of
            its rays.
        max_elevation: the elevation of the highest ray [rad]; None for the first null of the beam.
    """

    def __init__(
        self,
        spec: SonarSpec,
        world: SensorWorld,
        azimuths: Array,
        step: float,
        max_elevation: float | None = None,
    ) -> None:
        self._spec, self._world = spec, world
        self.grid = _ray_grid(spec, tuple(azimuths.tolist()), step, max_elevation)
        """The rays of the pings."""
        self._fan = Fan(
            float(azimuths[0]),
            step,
            len(azimuths),
            math.radians(spec.beam_width),
            math.radians(spec.vertical_aperture),
        )
        self.bin_size = (spec.range - spec.min_range) / spec.bins
        """The size of a range bin [m]."""
        self._rayleigh = _rayleigh() if spec.speckle else np.ones(65536, dtype=np.float32)

    @property
    def ranges(self) -> Array:
        """The middles of the range bins, (bins,) [m]."""
        starts: Array = self.bin_size * np.arange(self._spec.bins, dtype=np.float64)
        return self._spec.min_range + 0.5 * self.bin_size + starts

    def sound_speed(self, world_from_sonar: Pose) -> float:
        """Return the speed of sound at the sonar [m/s]."""
        return self._world.sea_water.sound_speed(self._depth(world_from_sonar))

    def absorption(self, world_from_sonar: Pose) -> float:
        """Return the absorption of sound at the sonar [dB/m]."""
        depth = self._depth(world_from_sonar)
        return self._world.sea_water.absorption(self._spec.frequency, depth)

    def ping(self, world_from_sonar: Pose, seed: int) -> Singles:
        """Return the amplitudes of all bins and beams, (bins, n) [Pa].

        Args:
            world_from_sonar: the pose of the sonar.
            seed: the seed of the speckle and the noise of this ping.
        """
        spec = self._spec
        power = self.power(world_from_sonar)
        noise = 10.0 ** (0.1 * (spec.noise_level + MICROPASCAL))
        draws = _draw_integers(seed, (spec.bins, self._fan.n))
        grid = self.grid
        return compute_amplitudes(*power, grid.patterns, grid.stride, noise, draws, self._rayleigh)

    def power(self, world_from_sonar: Pose) -> Power:
        """Return the mean power of the echoes of a ping."""
        ping = self._make_ping(world_from_sonar)
        scan = self._scan(ping)
        power = self._add_direct(ping, scan, ping.materials)
        if self._spec.multipath and np.isfinite(scan.to_surface).any():
            self._add_multipath(power.columns, ping, scan.to_surface)
        return power

    def separate_amplitudes(
        self, world_from_sonar: Pose, groups: npt.NDArray[np.integer]
    ) -> dict[int, Singles]:
        """Return the root mean square amplitudes of the echoes of each group of surfaces alone.

        Surfaces of other groups cast shadows. Without speckle, noise and multipath.

        Args:
            world_from_sonar: the pose of the sonar.
            groups: the group of each surface, from 1; 0: no group. Surfaces beyond are in none.

        Returns:
            The amplitudes of the groups with hits, by group, (bins, n) [Pa].
        """
        ping = self._make_ping(world_from_sonar)
        scan = self._scan(ping)
        owners = np.zeros(len(ping.materials), np.int64)
        n = min(len(groups), len(owners) - 1)  # the last is the water's surface
        owners[:n] = groups[:n]
        hit_surfaces = [hits.surface[np.isfinite(hits.distance)] for hits in scan.all_hits]
        hit_groups = np.unique(owners[np.concatenate(hit_surfaces)])
        no_speckle = np.ones(1, dtype=np.float32)
        integers = np.zeros((self._spec.bins, self._fan.n), np.uint16)
        grid = self.grid
        return {
            group: compute_amplitudes(
                *self._add_direct(ping, scan, ping.materials * (owners == group)[:, None]),
                grid.patterns,
                grid.stride,
                0.0,
                integers,
                no_speckle,
            )
            for group in hit_groups.tolist()
            if group != 0
        }

    def _make_ping(self, world_from_sonar: Pose) -> Ping:
        spec, rays = self._spec, self._world.rays
        loss = 0.2 * math.log(10.0) * self.absorption(world_from_sonar)
        return Ping(
            world_from_sonar,
            10.0 ** (0.1 * (spec.source_level + MICROPASCAL)),
            _material_numbers([*rays.materials, MATERIALS["waterSurface"]]),
            (spec.min_range, self.bin_size, loss),
        )

    def _scan(self, ping: Ping) -> Scan:
        """Cast the rays of a ping, those of the grid and those to small targets."""
        hits, to_surface = self._cast(ping, self.grid.directions)
        discs = find_discs(
            self._world.rays.balls(), ping.world_from_sonar, self._spec.range, self.grid
        )
        drop_hits(hits.distance, hits.surface, self.grid.directions, discs)
        if not len(discs.radius):
            return Scan(hits, to_surface, None)
        lattice = create_lattice(discs, self._fan, self.grid.max_elevation)
        return Scan(hits, to_surface, (lattice, self._cast(ping, lattice.directions)[0]))

    def _add_direct(self, ping: Ping, scan: Scan, materials: Array) -> Power:
        """Return the power of the echoes on the direct path."""
        spec, grid = self._spec, self.grid
        power = np.zeros((spec.bins, len(grid.azimuths)), dtype=np.float32, order="F")
        rows = grid.rows * (ping.level, 1.0)
        add_echoes(power, scan.hits, grid.directions, rows, materials, ping.bins)
        small_targets = np.zeros((0, 0), dtype=np.float32)
        if scan.small_targets is not None:
            lattice, hits = scan.small_targets
            small_targets = np.zeros((spec.bins, self._fan.n), dtype=np.float32)
            add_small_echoes(
                small_targets, hits, lattice, self._fan, ping.level, materials, ping.bins
            )
        return Power(power, small_targets)

    def _cast(self, ping: Ping, directions: Array) -> tuple[Hits, Array]:
        """Return the first hits of rays, and their distances to the water's surface.

        Hits include the water's surface; their normals are in the sonar's frame. The distance of a
        ray that does not hit the water's surface is infinite, (n,) [m].
        """
        pose, reach = ping.world_from_sonar, self._spec.range
        hits = self._world.rays.cast(pose, directions, reach)
        normal = product(hits.normal, pose.rotation)
        up = rotate_back(pose.rotation, np.array([0.0, 0.0, 1.0]))
        surface_height = self._world.surface.height - pose.position[2]
        rise = product(directions, up)
        to_surface = np.full(len(rise), np.inf)
        if len(rise) and 0.0 < surface_height < reach * float(rise.max()):
            to_surface = np.where(rise > 1e-9, surface_height / np.maximum(rise, 1e-9), np.inf)
            is_surface = to_surface < np.minimum(hits.distance, reach)
            to_surface[~is_surface] = np.inf
            hits.distance[is_surface], normal[is_surface] = to_surface[is_surface], -up
            hits.surface[is_surface] = len(ping.materials) - 1
        return Hits(hits.distance, normal, hits.surface), to_surface

    def _add_multipath(self, power: Singles, ping: Ping, to_surface: Array) -> None:
        """Add echoes that are reflected at the water's surface on the way there and back."""
        grid, world_from_sonar = self.grid, ping.world_from_sonar
        mirror = np.diag([1.0, 1.0, -1.0])
        position = world_from_sonar.position.copy()
        position[2] = 2.0 * self._world.surface.height - position[2]
        rotation = product(mirror, world_from_sonar.rotation)
        starts = np.where(np.isfinite(to_surface), to_surface, self._spec.range)
        hits = self._world.rays.cast(
            Pose(position, rotation), grid.directions, self._spec.range, starts
        )
        hits.distance[~np.isfinite(to_surface)] = np.inf
        normal = product(hits.normal, rotation)
        rows = grid.rows * (SURFACE_REFLECTION**2 * ping.level, 1.0)
        sonar_hits = Hits(hits.distance, normal, hits.surface)
        add_echoes(power, sonar_hits, grid.directions, rows, ping.materials, ping.bins)

    def _depth(self, world_from_sonar: Pose) -> float:
        return max(0.0, self._world.surface.height - float(world_from_sonar.position[2]))


@lru_cache(maxsize=16)
def _ray_grid(
    spec: SonarSpec, azimuths: tuple[float, ...], step: float, max_elevation: float | None
) -> RayGrid:
    """Return the rays of the pings of a sonar; calls with equal arguments return one object."""
    return RayGrid(spec, np.array(azimuths), step, max_elevation)


def _material_numbers(materials: list[Material]) -> Array:
    """Return the parameters of materials for `add_echoes`, (m, 3)."""
    return np.array(
        [
            (
                material.reflection**2 / (8.0 * math.pi * material.slope**2),
                0.5 / material.slope**2,
                10.0 ** (0.1 * material.strength),
            )
            for material in materials
        ]
    )


def _draw_integers(seed: int, shape: tuple[int, int]) -> npt.NDArray[np.uint16]:
    """Return random integers from 0 to 65535, four from each 64-bit number."""
    rng = np.random.Generator(np.random.PCG64DXSM(seed))
    n = shape[0] * shape[1]
    integers = rng.integers(0, 2**64, size=-(-n // 4), dtype=np.uint64)
    return integers.astype("<u8", copy=False).view("<u2")[:n].reshape(shape)


@cache
def _rayleigh() -> npt.NDArray[np.float32]:
    """Return the quantiles of a Rayleigh amplitude with mean square 1, (65536,)."""
    shares = (np.arange(65536) + 0.5) / 65536.0
    return np.sqrt(-log(shares)).astype(np.float32)

r"""A ping: rays in the pattern of the sonar, their echoes in bins of range, speckle and noise.

The echo level of a surface element of the target strength TS is that of the sonar equation,

.. math:: EL = SL - 2 (20 \log r + \alpha r) + TS + D ,

D the pattern of the beam there and back: a uniform line, :math:`(\sin u / u)^4`, over the height, a
Gaussian over the width. Echoes of one bin and beam are of many scatterers with random phases: the
amplitude is of Rayleigh's distribution around the root of the mean power, which is the sum of all
echoes and of the noise.

The ray that leaves a sonar for the mirror image of what is above the water goes by way of its
surface: with ``multipath`` such rays send echoes back by the same way.
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
from .kernel import Singles, add_echoes, received
from .ray_grid import RayGrid
from .small_targets import Discs, Fan, add_small_echoes, drop_hits, find_discs, lattice
from .spec import SonarSpec

SURFACE_LOSS = 0.631
"""Of power, at the water's surface [1]: 2 dB, of small waves."""
MICROPASCAL = -120.0
"""Of one micropascal [dB re 1 Pa]."""


class Power(NamedTuple):
    """Mean power of the echoes of a ping."""

    of_columns: Singles
    """Of each bin and column of rays, for what beams weight by their patterns, (bins, m) [Pa2]."""
    of_small: Singles
    """Of each bin and beam, of small targets, (bins, n); (0, 0) without small targets [Pa2]."""


class Ping(NamedTuple):
    """What holds for all rays of a ping."""

    world_from_sonar: Pose
    """Where the sonar is."""
    level: float
    """Power at 1 m on the axis of a beam [Pa2 m2]."""
    materials: Array
    """Of each surface, as for `add_echoes`; the last one is the water's surface, (m, 3)."""
    bins: tuple[float, float, float]
    """Least range, size of a bin [m], absorption there and back [1/m, neper of power]."""


class Echoes:
    """Echoes of a sonar's pings.

    Args:
        spec: of the sonar.
        world: what it is in.
        azimuths: of its beams at equal steps, positive to port, (n,) [rad].
        step: between beams, positive; of a single beam any [rad].
        highest: elevation up to which there are rays [rad]; None for the first null of the beam.
    """

    def __init__(
        self,
        spec: SonarSpec,
        world: SensorWorld,
        azimuths: Array,
        step: float,
        highest: float | None = None,
    ) -> None:
        self._spec, self._world = spec, world
        self.grid = _ray_grid(spec, tuple(azimuths.tolist()), step, highest)
        """The rays of its pings."""
        self._fan = Fan(
            float(azimuths[0]),
            step,
            len(azimuths),
            math.radians(spec.beam_width),
            math.radians(spec.vertical_aperture),
        )
        self.bin_size = (spec.range - spec.min_range) / spec.bins
        """Of range [m]."""
        self._rayleigh = _rayleigh() if spec.speckle else np.ones(65536, dtype=np.float32)

    @property
    def ranges(self) -> Array:
        """Middles of the bins, (bins,) [m]."""
        begins: Array = self.bin_size * np.arange(self._spec.bins, dtype=np.float64)
        return self._spec.min_range + 0.5 * self.bin_size + begins

    def sound_speed(self, world_from_sonar: Pose) -> float:
        """Of the water where the sonar is [m/s]."""
        return self._world.sea_water.sound_speed(self._depth(world_from_sonar))

    def losses(self, world_from_sonar: Pose) -> float:
        """By absorption, where the sonar is [dB/m]."""
        depth = self._depth(world_from_sonar)
        return self._world.sea_water.absorption(self._spec.frequency, depth)

    def ping(self, world_from_sonar: Pose, key: int) -> Singles:
        """Return the amplitudes of all bins and beams, (bins, n) [Pa].

        Args:
            world_from_sonar: where the sonar is.
            key: what the speckle and the noise of this ping are drawn from.
        """
        spec = self._spec
        power = self.power(world_from_sonar)
        noise = 10.0 ** (0.1 * (spec.noise_level + MICROPASCAL))
        draws = _draws(key, (spec.bins, self._fan.n))
        grid = self.grid
        return received(*power, grid.patterns, grid.stride, noise, draws, self._rayleigh)

    def power(self, world_from_sonar: Pose) -> Power:
        """Mean power of the echoes of a ping."""
        spec, grid, rays = self._spec, self.grid, self._world.rays
        loss = 0.2 * math.log(10.0) * self.losses(world_from_sonar)
        ping = Ping(
            world_from_sonar,
            10.0 ** (0.1 * (spec.source_level + MICROPASCAL)),
            _numbers([*rays.materials, MATERIALS["waterSurface"]]),
            (spec.min_range, self.bin_size, loss),
        )
        power = np.zeros((spec.bins, len(grid.azimuths)), dtype=np.float32, order="F")
        hits, to_surface = self._cast(ping, grid.directions)
        discs = find_discs(rays.balls(), world_from_sonar, spec.range, grid)
        drop_hits(hits.distance, hits.surface, grid.directions, discs)
        add_echoes(
            power, hits, grid.directions, grid.rows * (ping.level, 1.0), ping.materials, ping.bins
        )
        of_small = np.zeros((0, 0), dtype=np.float32)
        if len(discs.radius):
            of_small = np.zeros((spec.bins, self._fan.n), dtype=np.float32)
            self._add_small(of_small, ping, discs)
        if spec.multipath and np.isfinite(to_surface).any():
            self._add_multipath(power, ping, to_surface)
        return Power(power, of_small)

    def _cast(self, ping: Ping, directions: Array) -> tuple[Hits, Array]:
        """The first hits of rays, the water's surface among them, and where they reach that.

        Normals are in the sonar's frame. Of a ray that does not reach the water's surface, that
        distance is infinite (n,) [m].
        """
        pose, reach = ping.world_from_sonar, self._spec.range
        hits = self._world.rays.cast(pose, directions, reach)
        normal = product(hits.normal, pose.rotation)
        up = rotate_back(pose.rotation, np.array([0.0, 0.0, 1.0]))
        above = self._world.surface_height - pose.position[2]
        rise = product(directions, up)
        to_surface = np.full(len(rise), np.inf)
        if len(rise) and 0.0 < above < reach * float(rise.max()):
            to_surface = np.where(rise > 1e-9, above / np.maximum(rise, 1e-9), np.inf)
            wet = to_surface < np.minimum(hits.distance, reach)
            to_surface[~wet] = np.inf
            hits.distance[wet], normal[wet] = to_surface[wet], -up
            hits.surface[wet] = len(ping.materials) - 1
        return Hits(hits.distance, normal, hits.surface), to_surface

    def _add_small(self, power: Singles, ping: Ping, discs: Discs) -> None:
        """Add the echoes of small targets to those of the beams."""
        rays = lattice(discs, self._fan, self.grid.highest)
        hits, _ = self._cast(ping, rays.directions)
        add_small_echoes(power, hits, rays, self._fan, ping.level, ping.materials, ping.bins)

    def _add_multipath(self, power: Singles, ping: Ping, to_surface: Array) -> None:
        """Add echoes by way of the water's surface, there and back."""
        grid, world_from_sonar = self.grid, ping.world_from_sonar
        mirror = np.diag([1.0, 1.0, -1.0])
        position = world_from_sonar.position.copy()
        position[2] = 2.0 * self._world.surface_height - position[2]
        rotation = product(mirror, world_from_sonar.rotation)
        begins = np.where(np.isfinite(to_surface), to_surface, self._spec.range)
        hits = self._world.rays.cast(
            Pose(position, rotation), grid.directions, self._spec.range, begins
        )
        hits.distance[~np.isfinite(to_surface)] = np.inf
        normal = product(hits.normal, rotation)
        rows = grid.rows * (SURFACE_LOSS**2 * ping.level, 1.0)
        found = Hits(hits.distance, normal, hits.surface)
        add_echoes(power, found, grid.directions, rows, ping.materials, ping.bins)

    def _depth(self, world_from_sonar: Pose) -> float:
        return max(0.0, self._world.surface_height - float(world_from_sonar.position[2]))


@lru_cache(maxsize=16)
def _ray_grid(
    spec: SonarSpec, azimuths: tuple[float, ...], step: float, highest: float | None
) -> RayGrid:
    """Return the rays of a sonar's pings; who asks again gets the same."""
    return RayGrid(spec, np.array(azimuths), step, highest)


def _numbers(materials: list[Material]) -> Array:
    """Numbers of materials for `add_echoes`, (m, 3)."""
    return np.array(
        [
            (
                each.reflection**2 / (8.0 * math.pi * each.slope**2),
                0.5 / each.slope**2,
                10.0 ** (0.1 * each.strength),
            )
            for each in materials
        ]
    )


def _draws(key: int, shape: tuple[int, int]) -> npt.NDArray[np.uint16]:
    """Random whole numbers from 0 to 65535, four of each that is drawn."""
    random = np.random.Generator(np.random.PCG64DXSM(key))
    n = shape[0] * shape[1]
    wide = random.integers(0, 2**64, size=-(-n // 4), dtype=np.uint64)
    return wide.astype("<u8", copy=False).view("<u2")[:n].reshape(shape)


@cache
def _rayleigh() -> npt.NDArray[np.float32]:
    """Quantiles of the amplitude whose mean square is 1, (65536,)."""
    shares = (np.arange(65536) + 0.5) / 65536.0
    return np.sqrt(-log(shares)).astype(np.float32)

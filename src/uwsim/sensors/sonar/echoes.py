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

import numpy as np
import numpy.typing as npt

from ...acoustics import MATERIALS, Material
from ...geometry import Array, Pose
from ...numerics.elementwise import log
from ...numerics.linear import product, turned_back
from ...world import SensorWorld
from .kernel import BLOCK, Singles, add_echoes, received
from .spec import SonarSpec

MARGIN = 1.25
"""A beam is summed up so many of its widths to either side."""
RAYS_A_WIDTH = 2.5
"""At least so many rays are side by side in the width of a beam."""
HIGH = 0.6
"""Rays go so many vertical apertures up and down from the middle, but not past straight up."""
LINE_WIDTH = 0.4429
"""Half width of a line array at half power is the arc sine of this, in wave lengths over length."""
SURFACE_LOSS = 0.631
"""Of power, at the water's surface [1]: 2 dB, of small waves."""
MICROPASCAL = -120.0
"""Of one micropascal [dB re 1 Pa]."""


class Echoes:
    """Echoes of a sonar's pings.

    Args:
        spec: of the sonar.
        world: what it is in.
        azimuths: of its beams at equal steps, positive to port, (n,) [rad].
        step: between beams; of a single beam any [rad].
    """

    def __init__(self, spec: SonarSpec, world: SensorWorld, azimuths: Array, step: float) -> None:
        self._spec, self._world = spec, world
        width = math.radians(spec.beam_width)
        self.azimuths = azimuths
        """Of the beams, (n,) [rad]."""
        n_phases = max(1, int(width / RAYS_A_WIDTH / abs(step)))
        apart = n_phases * step
        n_side = max(1, math.ceil(MARGIN * width / abs(apart)))
        phases = np.arange(min(n_phases, len(azimuths)))
        off = np.arange(-n_side, n_side + 2) * apart - phases[:, None] * step
        powers = [[_gaussian(angle, width) for angle in line] for line in off.tolist()]
        self._patterns = np.array(powers, dtype=np.float32)
        n_rays = (len(azimuths) - 1) // n_phases + 2 * n_side + 2
        self._ray_azimuths = azimuths[0] + apart * np.arange(-n_side, n_rays - n_side)
        aperture = math.radians(spec.vertical_aperture)
        highest = min(HIGH * aperture, 0.5 * math.pi)
        rise = 2.0 * highest / spec.rows
        elevations: Array = rise * (np.arange(spec.rows, dtype=np.float64) + 0.5) - highest
        self.directions = _directions(self._ray_azimuths, elevations)
        """Of the rays in the sonar's frame, (n k, 3)."""
        patterns = np.array([_line(angle, aperture) ** 4 for angle in elevations.tolist()])
        self._rows = patterns * np.cos(elevations) * rise * abs(apart)
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
        draws = _draws(key, (spec.bins, len(self.azimuths)))
        return received(power, self._patterns, noise, draws, self._rayleigh)

    def power(self, world_from_sonar: Pose) -> Singles:
        """Mean power of the echoes of each bin and ray azimuth, (bins, m) [Pa2]."""
        spec, rays = self._spec, self._world.rays
        power = np.zeros((spec.bins, len(self._ray_azimuths)), dtype=np.float32, order="F")
        up = turned_back(world_from_sonar.rotation, np.array([0.0, 0.0, 1.0]))
        above = self._world.surface_height - world_from_sonar.position[2]
        rise = product(self.directions, up)
        hits = rays.cast(world_from_sonar, self.directions, spec.range)
        normal = product(hits.normal, world_from_sonar.rotation)
        to_surface = np.full(len(rise), np.inf)  # of the rays that reach it
        if 0.0 < above < spec.range * float(rise.max()):
            to_surface = np.where(rise > 1e-9, above / np.maximum(rise, 1e-9), np.inf)
            wet = to_surface < np.minimum(hits.distance, spec.range)
            to_surface[~wet] = np.inf
            hits.distance[wet], normal[wet] = to_surface[wet], -up
            hits.surface[wet] = len(rays.materials)
        level = 10.0 ** (0.1 * (spec.source_level + MICROPASCAL))
        materials = _numbers([*rays.materials, MATERIALS["waterSurface"]])
        loss = 0.2 * math.log(10.0) * self.losses(world_from_sonar)
        bins = spec.min_range, self.bin_size, loss
        found = hits.distance, normal, hits.surface
        add_echoes(power, found, self.directions, level * self._rows, materials, bins)
        if spec.multipath and np.isfinite(to_surface).any():
            self._add_multipath(power, world_from_sonar, to_surface, level, materials, bins)
        return power

    def _add_multipath(
        self,
        power: Singles,
        world_from_sonar: Pose,
        to_surface: Array,
        level: float,
        materials: Array,
        bins: tuple[float, float, float],
    ) -> None:
        """Add echoes by way of the water's surface, there and back."""
        mirror = np.diag([1.0, 1.0, -1.0])
        position = world_from_sonar.position.copy()
        position[2] = 2.0 * self._world.surface_height - position[2]
        rotation = product(mirror, world_from_sonar.rotation)
        image = Pose(position, rotation)
        begins = np.where(np.isfinite(to_surface), to_surface, self._spec.range)
        hits = self._world.rays.cast(image, self.directions, self._spec.range, begins)
        hits.distance[~np.isfinite(to_surface)] = np.inf
        normal = product(hits.normal, rotation)
        rows = SURFACE_LOSS**2 * level * self._rows
        found = hits.distance, normal, hits.surface
        add_echoes(power, found, self.directions, rows, materials, bins)

    def _depth(self, world_from_sonar: Pose) -> float:
        return max(0.0, self._world.surface_height - float(world_from_sonar.position[2]))


def _directions(azimuths: Array, elevations: Array) -> Array:
    """Unit vectors: x ahead, y to port, z up, in the order of `add_echoes`, (n k, 3)."""
    azimuth, elevation = np.meshgrid(azimuths, elevations)
    x, y = np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth)
    rows = np.stack([x, y, np.sin(elevation)], axis=2)
    blocks = [rows[:, k : k + BLOCK].reshape(-1, 3) for k in range(0, len(azimuths), BLOCK)]
    return np.concatenate(blocks)


def _gaussian(angle: float, width: float) -> float:
    """Power of a beam that has half of it at half of ``width`` [rad]; 0 beyond the margin."""
    return 2.0 ** -((2.0 * angle / width) ** 2) if abs(angle) <= MARGIN * width else 0.0


def _line(angle: float, width: float) -> float:
    """Amplitude of a uniform line array that has half its power at half of ``width`` [rad]."""
    u = math.pi * LINE_WIDTH * math.sin(angle) / math.sin(0.5 * width)
    return math.sin(u) / u if u else 1.0


def _numbers(materials: list[Material]) -> Array:
    """What `add_echoes` wants to know of materials, (m, 3)."""
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


def _rayleigh() -> npt.NDArray[np.float32]:
    """Quantiles of the amplitude whose mean square is 1, (65536,)."""
    shares = (np.arange(65536) + 0.5) / 65536.0
    return np.sqrt(-log(shares)).astype(np.float32)

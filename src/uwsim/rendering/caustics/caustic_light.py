"""Caustics on the GPU: the maps of the present time, and the uniform block ``Caustics``."""

from __future__ import annotations

import math
from functools import lru_cache

import moderngl
import numpy as np

from ...base.geometry import Array, Pose
from ...base.numerics.jit import njit
from ...optics import Medium
from ..physical.daylight_field import compute_light_field, compute_scaled_attenuation
from ..physical.moving_surface import MovingSurface
from ..physical.physical_water import Daylight, PhysicalWater
from ..program import Block
from .caustic_map import CausticMapper, CausticOptics, FloatMaps, make_optics
from .refraction import make_beam
from .ripples import Ripples
from .swell import N_POINTS, SPACING, compute_swell, find_short_waves
from .wave_tile import N_NODES, TILE_EDGE, TileWaves

CAUSTICS = Block(
    "Caustics",
    5,
    {
        "caustic_x": "vec4",
        "caustic_y": "vec4",
        "swell_frame": "vec4",
        "caustic_depths": "vec4",
        "caustic_loss": "vec4",
        "shaft_numbers": "vec4",
    },
)
PATTERN_FREQUENCY = 10.0
"""The frequency of the pattern in the blur by scattering [cycles/rad]: 0.5 m in 5 m."""
MAX_DEPTH, LEAST_LOST_DEPTH, LEAST_FLOOR_DEPTH = 20.0, 3.0, 1.0
"""The greatest depth of the deepest map, and the least by the loss of contrast and by the floor
[m]."""
DEPTH_STEP = 0.05
"""The step to which the depth of the floor is rounded up [m]."""
LOST_CONTRAST = 3.0
"""The exponent of the loss of contrast in the deepest map, in the clearest channel."""

SHAFT_OPTICAL_DEPTH, MAX_SHAFT = 3.0, 24.0
"""The limits of the way along which shafts are added up: attenuation times way, and way [m]."""

MAX_PHASE_RATIOS = (3.0, 15.0)
"""The greatest ratio of b p to b* p* on the way to the surface, without and with the image of the
sun, whose aureole is the mean of the shafts near it [1]."""


@lru_cache(maxsize=16)
def find_contrast_loss(medium: Medium, sun_cosine: float) -> Array:
    r"""Return the rate at which the contrast of caustics falls with depth, (3,) [1/m].

    The array is shared, do not change it.

    The beam of `physical.daylight_field` contains the share :math:`g^2` of scattered light that
    counts as unscattered. A pattern of the frequency :math:`\psi` keeps the share :math:`Q(\psi)`
    of its contrast (`optics.transmission`): :math:`b\, (g^2 - Q(\psi)) / \mu_w`.
    """
    phase = medium.phase_function
    transform = float(phase.compute_transform(np.array([PATTERN_FREQUENCY]))[0])
    share = max(phase.mean_cosine**2 - transform, 0.0)
    loss: Array = share * np.array(medium.scattering) / sun_cosine
    return loss


class CausticLight:
    """The caustics of a renderer.

    Args:
        context: the context of the renderer.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._values = np.zeros((), dtype=CAUSTICS.dtype)
        self._buffer = context.buffer(reserve=CAUSTICS.dtype.itemsize, dynamic=True)
        self._all_maps: dict[int, moderngl.TextureArray] = {}  # by the number of layers
        self._swell = context.texture((N_POINTS, N_POINTS), 4, dtype="f4")
        self._swell.filter = (moderngl.LINEAR, moderngl.LINEAR)
        self._swell.repeat_x = self._swell.repeat_y = False
        self._maps: moderngl.TextureArray | None = None
        self._mapper: CausticMapper | None = None
        self._maps_key: object = None
        self._swell_key: object = None
        self._corner = (0.0, 0.0)

    def prepare(
        self,
        water: PhysicalWater,
        surface: MovingSurface,
        world_from_camera: Pose,
        surface_height: float,
        floor_depth: float,
    ) -> tuple[tuple[str, int], ...]:
        """Compute and upload what has changed, and fill the uniform block.

        Args:
            water: the water.
            surface: the moving surface.
            world_from_camera: the pose of the camera; OpenGL axes.
            surface_height: the height of the still surface in W [m].
            floor_depth: the depth of the lowest point of the ground; infinity if unknown [m].

        Returns:
            The switches of the shaders.
        """
        ripples = water.ripples
        assert ripples is not None
        mapper = self._find_mapper(water, floor_depth)
        key = surface, water.daylight, water.medium, ripples, mapper.optics.depths
        if key != self._maps_key:
            self._maps_key = key
            maps = mapper.compute(_find_tile_waves(ripples, surface), surface.time)
            self._upload(maps)
        switches: tuple[tuple[str, int], ...] = (("CAUSTICS", 1), ("N_SLICES", self.n_slices))
        if surface.waves is not None:
            switches += (("SWELL", 1),)
            self._update_swell(key, mapper, surface, world_from_camera, surface_height)
        self._fill(water, mapper, world_from_camera, surface_height)
        return switches

    def _upload(self, maps: FloatMaps) -> None:
        """Upload the maps: the first four, and of six the last four in a second layer."""
        n_layers = len(maps) // 2 - 1
        if n_layers not in self._all_maps:
            texture = self._context.texture_array((N_NODES, N_NODES, n_layers), 4, dtype="f4")
            texture.filter = (moderngl.LINEAR_MIPMAP_NEAREST, moderngl.LINEAR)
            self._all_maps[n_layers] = texture
        pixels = np.empty((n_layers, N_NODES, N_NODES, 4), np.float32)
        pack_maps(maps, pixels)
        self._maps = self._all_maps[n_layers]
        self._maps.write(pixels)
        self._maps.build_mipmaps()

    def _find_mapper(self, water: PhysicalWater, floor_depth: float) -> CausticMapper:
        """Return the computation of maps of this water; its memory is the renderer's own."""
        assert water.ripples is not None
        steps = math.ceil(min(floor_depth, MAX_DEPTH) / DEPTH_STEP - 1e-6)
        optics = find_optics(water.medium, water.daylight, water.ripples, steps * DEPTH_STEP)
        if self._mapper is None or self._mapper.optics is not optics:
            self._mapper = CausticMapper(optics)
        return self._mapper

    @property
    def n_slices(self) -> int:
        """The number of maps of the last image."""
        assert self._mapper is not None
        return len(self._mapper.optics.depths)

    def use(self, maps_unit: int, swell_unit: int) -> None:
        """Bind the textures to their units."""
        assert self._maps is not None
        self._maps.use(maps_unit)
        self._swell.use(swell_unit)

    def _update_swell(
        self,
        maps_key: object,
        mapper: CausticMapper,
        surface: MovingSurface,
        world_from_camera: Pose,
        surface_height: float,
    ) -> None:
        """Update the grid of long waves, which has the camera's beam in its middle."""
        assert surface.waves is not None
        beam = mapper.optics.beam
        depth = max(surface_height - float(world_from_camera.position[2]), 0.0)
        centre = world_from_camera.position[:2] - depth * beam.level_drift
        x, y = (SPACING * math.floor(c / SPACING - 0.5 * N_POINTS) for c in centre.tolist())
        if (maps_key, x, y) != self._swell_key:
            self._swell_key, self._corner = (maps_key, x, y), (x, y)
            swell = compute_swell(
                surface.waves, beam.slope_matrix, (x, y), surface.time, surface.wave_scale
            )
            self._swell.write(swell)

    def _fill(
        self,
        water: PhysicalWater,
        mapper: CausticMapper,
        world_from_camera: Pose,
        surface_height: float,
    ) -> None:
        values, beam, depths = self._values, mapper.optics.beam, mapper.optics.depths
        rotation, position = world_from_camera.rotation, world_from_camera.position
        for row, name in enumerate(("caustic_x", "caustic_y")):
            # the point of the still surface on the refracted beam, in tiles, from the camera frame
            drift = float(beam.level_drift[row])
            depth = surface_height - float(position[2])
            start = (float(position[row]) - drift * depth) / TILE_EDGE
            gradient = (rotation[row] + drift * rotation[2]) / TILE_EDGE
            tile = math.floor(start)
            values[name] = *gradient, start - tile
            corner = self._corner[row] / TILE_EDGE - tile
            edge = N_POINTS * SPACING / TILE_EDGE
            values["swell_frame"][row] = 0.5 / N_POINTS - corner / edge
            values["swell_frame"][2] = 1.0 / edge
        values["swell_frame"][3] = 1.0 / TILE_EDGE
        ratio = math.log2(depths[1] / depths[0])
        values["caustic_depths"] = depths[0], 1.0 / ratio, -math.log2(depths[0]) / ratio, depths[-1]
        values["caustic_loss"], shaft_numbers = find_medium_numbers(water)
        values["shaft_numbers"] = *shaft_numbers, N_NODES
        self._buffer.write(values.tobytes())
        self._buffer.bind_to_uniform_block(CAUSTICS.binding)


def find_medium_numbers(water: PhysicalWater) -> tuple[list[float], list[float]]:
    """Find the numbers of the uniform block that follow from the medium.

    Returns:
        ``caustic_loss`` (4,), and ``shaft_numbers`` without the last one (3,).
    """
    field = compute_light_field(water.medium, water.daylight)
    loss = find_contrast_loss(water.medium, float(field.towards_sun[2]))
    g = water.medium.phase_function.mean_cosine
    attenuation = float(compute_scaled_attenuation(water.medium).min())
    longest_way = min(SHAFT_OPTICAL_DEPTH / max(attenuation, 1e-6), MAX_SHAFT)
    shaft_numbers = [g / (1.0 + g), 1.0 - g * g, longest_way]
    return [*loss.tolist(), MAX_PHASE_RATIOS[water.has_surface]], shaft_numbers


@njit
def pack_maps(maps: FloatMaps, pixels: FloatMaps) -> None:
    """Copy maps into the channels of layers, of which two have two maps in common."""
    _, n_rows, n_columns = maps.shape
    for layer in range(len(pixels)):
        for row in range(n_rows):
            for column in range(n_columns):
                for channel in range(4):
                    pixels[layer, row, column, channel] = maps[channel + 2 * layer, row, column]


@lru_cache(maxsize=4)
def find_optics(
    medium: Medium, daylight: Daylight, ripples: Ripples, floor_depth: float
) -> CausticOptics:
    """Return the beam, the depths and the blur of maps for a medium, a sun and ripples; shared.

    The deepest map is that of the floor, unless the contrast is lost above it.
    """
    depth = min(find_lost_depth(medium, daylight), max(floor_depth, LEAST_FLOOR_DEPTH))
    return make_optics(make_beam(daylight), depth, ripples.unresolved_slope)


def find_lost_depth(medium: Medium, daylight: Daylight) -> float:
    """Find the greatest depth of the deepest map, below which contrast is lost [m]."""
    field = compute_light_field(medium, daylight)
    loss = float(find_contrast_loss(medium, float(field.towards_sun[2])).min())
    return min(max(LOST_CONTRAST / max(loss, 1e-6), LEAST_LOST_DEPTH), MAX_DEPTH)


@lru_cache(maxsize=4)
def _draw_ripples(ripples: Ripples, seed: int) -> TileWaves:
    return ripples.draw(seed)


def _find_tile_waves(ripples: Ripples, surface: MovingSurface) -> TileWaves:
    drawn_waves = _draw_ripples(ripples, surface.seed)
    if surface.waves is None:
        return drawn_waves
    return drawn_waves.join(find_short_waves(surface.waves).scale(surface.wave_scale))

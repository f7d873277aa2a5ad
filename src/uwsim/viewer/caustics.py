"""The entries of the head for caustics and light shafts, which a moving surface makes.

The entry of the scene is null if the surface focuses no light, or::

    {edge, n_nodes,               the edge of the tile of ripples [m], and its nodes along an edge
     columns, rows: ref i2,       the waves of the tile: their numbers along x and y
     amplitudes: ref u2,          in multiples of `amplitude` [m]
     amplitude,
     phases: ref u2,              at the origin of W at time 0, in 1/65536 turns
     tension,                     the surface tension of water over its density [m3/s2]
     waves: null or ref f4,       the waves of the scene, as those of `uwsim.viewer.surface`
     wave_lengths: [min, max],    those of the scene that join the tile [m]
     scale,                       the factor on amplitudes of waves at step 0 [1]
     swell: {n_points, spacing},  the grid of longer waves [m]
     sun: 3, drift: 2, matrix: 4, `uwsim.rendering.caustics.refraction.Beam`
     covariance: 3, index,        that of the drift by the sun's disc and by shorter ripples: xx,
                                  xy, yy; the refractive index
     maps: {...},                 constants of the maps (below)
     has_caustics,
     shafts: null or {NAME: text}}    the switches of their shader

The entry of a medium, in its ``optics``, is null or::

    {lost_depth, loss: 4, shafts: 3}     the depth of the deepest map without a floor above it [m],
                                         and the numbers of the uniform block
                                         (`uwsim.rendering.caustics.caustic_light`)

The names of constants of maps are those of `uwsim.rendering.caustics.caustic_map` and
``caustic_light``, in lower case.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..base.numerics.linear import product
from ..rendering.caustics.caustic_light import (
    DEPTH_STEP,
    LEAST_FLOOR_DEPTH,
    MAX_DEPTH,
    find_lost_depth,
    find_medium_numbers,
)
from ..rendering.caustics.caustic_map import (
    FEW_SLICES,
    LEAST_BLUR,
    MANY_SLICES,
    MAP_BLUR,
    MAX_RATIO,
    MAX_SPREAD,
    MIN_DEPTH,
    SMOOTH_BLUR,
)
from ..rendering.caustics.light_shafts import SWITCHES
from ..rendering.caustics.refraction import make_beam
from ..rendering.caustics.ripple_spectrum import SURFACE_TENSION
from ..rendering.caustics.swell import N_POINTS, SPACING
from ..rendering.caustics.wave_tile import MAX_WAVE_LENGTH, MIN_WAVE_LENGTH, N_NODES, TILE_EDGE
from ..rendering.physical.daylight_field import REFRACTIVE_INDEX
from ..rendering.physical.physical_water import PhysicalWater
from ..rendering.surface.wave_grids import read_components
from ..simulation.live_scene import LiveScene
from .pack import Blob

Json = dict[str, Any]
N_TURN_STEPS = 65536
"""The number of steps of a turn in which phases are stored."""
MAP_CONSTANTS = {
    "min_depth": MIN_DEPTH,
    "few_slices": FEW_SLICES,
    "many_slices": MANY_SLICES,
    "max_ratio": MAX_RATIO,
    "max_depth": MAX_DEPTH,
    "least_floor_depth": LEAST_FLOOR_DEPTH,
    "depth_step": DEPTH_STEP,
    "max_spread": MAX_SPREAD,
    "least_blur": LEAST_BLUR,
    "smooth_blur": SMOOTH_BLUR,
    "map_blur": MAP_BLUR,
}
"""The constants of maps that the page needs."""


def describe_caustics(world: LiveScene, blob: Blob) -> Json | None:
    """Return the entry of the scene.

    Args:
        world: the scene.
        blob: the binary part of the pack, to which arrays are appended.
    """
    water = world.scenery.state.water.physical_water
    if water is None or not water.has_focused_light:
        return None
    if not (water.has_caustics or water.has_light_shafts):
        return None
    assert water.ripples is not None
    tile, beam = water.ripples.draw(world.model.seed), make_beam(water.daylight)
    unit = float(tile.amplitude.max()) / 65535.0
    spread = product(beam.slope_matrix, beam.slope_matrix.T)
    covariance = (beam.disc_covariance + water.ripples.unresolved_slope**2 * spread).tolist()
    return {
        "edge": TILE_EDGE,
        "n_nodes": N_NODES,
        "columns": blob.add(tile.columns.astype("<i2")),
        "rows": blob.add(tile.rows.astype("<i2")),
        "amplitudes": blob.add(np.rint(tile.amplitude / unit).astype("<u2")),
        "amplitude": unit,
        "tension": SURFACE_TENSION,
        **describe_focusing_waves(world, blob),
        "wave_lengths": [MIN_WAVE_LENGTH, MAX_WAVE_LENGTH],
        "scale": float(world.water.state.wave_scale[0]),
        "swell": {"n_points": N_POINTS, "spacing": SPACING},
        "sun": beam.towards_sun.tolist(),
        "drift": beam.level_drift.tolist(),
        "matrix": beam.slope_matrix.ravel().tolist(),
        "covariance": [covariance[0][0], covariance[0][1], covariance[1][1]],
        "index": REFRACTIVE_INDEX,
        "maps": MAP_CONSTANTS,
        "has_caustics": water.has_caustics,
        "shafts": {name: str(value) for name, value in SWITCHES.items()}
        if water.has_light_shafts
        else None,
    }


def describe_focusing_waves(world: LiveScene, blob: Blob) -> Json:
    """Return the fields ``phases`` and ``waves``, which depend on the seed of a trial."""
    water, waves = world.scenery.state.water.physical_water, world.water.waves
    assert water is not None
    assert water.ripples is not None
    phases = water.ripples.draw(world.model.seed).phase / (2.0 * np.pi)
    steps = np.rint(phases * N_TURN_STEPS) % N_TURN_STEPS
    columns = None
    if waves is not None:
        c = read_components(waves, 1.0)
        columns = np.stack([c.amplitude, c.omega, c.kx, c.ky, c.phase]).astype("<f4")
    return {
        "phases": blob.add(steps.astype("<u2")),
        "waves": None if columns is None else blob.add(columns.ravel()),
    }


def describe_focusing(water: PhysicalWater) -> Json | None:
    """Return the entry of a medium."""
    if not water.has_focused_light:
        return None
    loss, shafts = find_medium_numbers(water)
    lost_depth = find_lost_depth(water.medium, water.daylight)
    return {"lost_depth": lost_depth, "loss": loss, "shafts": shafts}

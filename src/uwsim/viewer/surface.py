"""The entry of the head for the moving surface of physical water, the sky and the air.

The entry is null if images do not show the surface, or::

    {waves: null or ref f4,        the components before the scale, in W: n amplitudes [m], then n
                                   angular frequencies [rad/s], wave numbers along x and y [rad/m],
                                   and phases [rad] (`uwsim.rendering.surface.wave_grids`)
     scale,                        the factor on amplitudes at step 0 [1]
     ripples: null or ref f4,      the same of the tile of ripples
                                   (`uwsim.rendering.surface.ripples`)
     slope_variance,               the variance of the slopes of waves and ripples along an axis [1]
     mirror,                       true if it mirrors bodies on the side of the camera
     air,                          the attenuation of air [1/m]
     sky: {sun: 3, sunlight: 3, light: 3, clear, overcast}}
                                   `uwsim.rendering.surface.sky`: the unit vector towards the sun;
                                   irradiances by the sun, of a surface that faces it, and by the
                                   sky, of a level one; factors on the two distributions
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..base import rng
from ..rendering.surface.ripples import draw_ripples
from ..rendering.surface.sky import compute_sky, compute_sky_levels
from ..rendering.surface.surface_block import CONTRAST_LOSS
from ..rendering.surface.wave_grids import Components, read_components
from ..simulation.live_scene import LiveScene
from .pack import Blob

Json = dict[str, Any]


def describe_surface(world: LiveScene, blob: Blob) -> Json | None:
    """Return the entry of the surface.

    Args:
        world: the scene.
        blob: the binary part of the pack, to which arrays are appended.
    """
    water = world.scenery.state.water.physical_water
    if water is None or not water.has_surface:
        return None
    sky = compute_sky(water.daylight)
    clear_level, overcast_level = compute_sky_levels(sky)
    ripples = water.ripples
    return {
        **describe_moving_surface(world, blob),
        "scale": float(world.water.state.wave_scale[0]),
        "slope_variance": 0.0 if ripples is None else 0.5 * math.fsum(ripples.slope_variances),
        "short_wave_variance": 0.0 if ripples is None else ripples.short_wave_variance,
        "mirror": water.has_mirror,
        "air": CONTRAST_LOSS / water.visibility,
        "sky": {
            "sun": sky.towards_sun.tolist(),
            "sunlight": sky.sun_irradiance.tolist(),
            "light": sky.irradiance.tolist(),
            "clear": clear_level,
            "overcast": overcast_level,
        },
    }


def describe_moving_surface(world: LiveScene, blob: Blob) -> Json:
    """Return the fields ``waves`` and ``ripples``, which depend on the seed of a trial."""
    water = world.scenery.state.water.physical_water
    waves, components = world.water.waves, None
    ripples = None if water is None else water.ripples
    if ripples is not None:
        generator = rng.stream(world.model.seed, "scene/ripples")
        components = draw_ripples(generator, ripples.direction)
    return {
        "waves": None if waves is None else _add(read_components(waves, 1.0), blob),
        "ripples": None if components is None else _add(components, blob),
    }


def _add(c: Components, blob: Blob) -> Any:
    columns = np.stack([c.amplitude, c.omega, c.kx, c.ky, c.phase])
    return blob.add(columns.astype("<f4").ravel())

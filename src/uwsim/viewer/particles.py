"""The entry of the head for particles: what their places in any view follow from.

The entry is null, or::

    {range, exposure_time, aperture, focus_distance,     `uwsim.particles.ParticlesSpec`
     source: null or 3,                                  the place from which plumes rise, in W
     classes: [{kind, key: "0x...", concentration, min_diameter, max_diameter, slope, rise_speed,
                reflectance, depth_scale: null or m, is_plume}],    `uwsim.particles.SizeClass`
     sediment: null or {key: "0x...", settling_speed, diffusivity, scattering, colour: 3, period}}
                                                         `uwsim.particles.sediment`; the time
                                                         between births of puffs [s]
"""

from __future__ import annotations

import math
from typing import Any

from ..particles import SizeClass
from ..simulation.live_scene import LiveScene
from ..simulation.scenery.scene_sediment import UPDATE_RATE, SceneSediment

Json = dict[str, Any]


def describe_particles(world: LiveScene) -> Json | None:
    """Return the entry of the particles; None without any."""
    particles = world.scenery.particles
    if particles is None:
        return None
    spec, source, sediment = particles.spec, particles.source, particles.sediment
    return {
        "range": spec.range,
        "exposure_time": spec.exposure_time,
        "aperture": spec.aperture,
        "focus_distance": spec.focus_distance,
        "source": None if source is None else source.tolist(),
        "classes": [
            *(_describe_class(size_class, is_plume=False) for size_class in particles.classes),
            *(_describe_class(size_class, is_plume=True) for size_class in particles.plume_classes),
        ],
        "sediment": None if sediment is None else _describe_sediment(sediment),
    }


def _describe_sediment(sediment: SceneSediment) -> Json:
    spec = sediment.spec
    return {
        "key": f"{int(sediment.key):#018x}",
        "settling_speed": spec.settling_speed,
        "diffusivity": spec.diffusivity,
        "scattering": spec.scattering,
        "colour": list(spec.color),
        "period": 1.0 / UPDATE_RATE,
    }


def _describe_class(size_class: SizeClass, *, is_plume: bool) -> Json:
    depth_scale = size_class.depth_scale
    return {
        "kind": int(size_class.kind),
        "key": f"{size_class.key:#018x}",
        "concentration": size_class.concentration,
        "min_diameter": size_class.min_diameter,
        "max_diameter": size_class.max_diameter,
        "slope": size_class.slope,
        "rise_speed": size_class.rise_speed,
        "reflectance": size_class.reflectance,
        "depth_scale": None if math.isinf(depth_scale) else depth_scale,
        "is_plume": is_plume,
    }

"""The water of a scene as plain values, for ``uwsim info`` and its ``--json``."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from ...optics import Medium
from ...particles import ParticlesSpec
from ...scene.physical_water import PhysicalWaterSpec, RipplesSpec
from ...scene.spec import SceneSpec
from ...waves import WAVE_SYSTEMS, SeaSettings, WaveSystemSpec
from ...world import GRAVITY

Fields = dict[str, Any]

N_DIGITS = 6
"""The number of decimal places of positions."""


def list_water(scene: SceneSpec, medium: Medium | None) -> Fields:
    """Return the surface, the waves, the optics and the currents of the water.

    Args:
        scene: the scene.
        medium: the water of the physical law of images; None if the scene has the fog law.
    """
    ocean = scene.ocean_state
    surface = np.array([[0.0, 0.0, ocean.ocean_surface_height]])
    position = scene.world_from_localized.inverse().transform(surface)[0]
    water = ocean.water
    return {
        "surface_above_origin": [round(float(value), N_DIGITS) + 0.0 for value in position],
        "waves": [_wave(system, ocean.sea) for system in ocean.waves],
        "image_model": "uwsim" if water is None else water.law,
        "physical": (
            None
            if water is None or medium is None
            else _physical_water(water, medium, has_waves=bool(ocean.waves))
        ),
        "fog_density": ocean.fog.density,
        "fog_colour": list(ocean.fog.color),
        "colour": list(ocean.color),
        "attenuation": list(ocean.attenuation),
        "currents": [type(current).__name__.removesuffix("Spec") for current in ocean.currents],
    }


def _wave(system: WaveSystemSpec, sea: SeaSettings) -> Fields:
    k = system.peak_number(sea)
    frequency = math.sqrt(GRAVITY * k * math.tanh(k * sea.depth))  # [rad/s]
    return {
        "kind": next(name for name, spec in WAVE_SYSTEMS.items() if type(system) is spec),
        "height": system.expected_height(sea),
        "period": 2.0 * math.pi / frequency if frequency > 0.0 else None,
    }


def _physical_water(water: PhysicalWaterSpec, medium: Medium, *, has_waves: bool) -> Fields:
    ripples = water.ripples or (RipplesSpec() if has_waves else None)
    source = water.type or water.file or (water.spectrum and water.spectrum.file)
    return {
        "source": source or ("of a spectrum" if water.spectrum else "of its coefficients"),
        "absorption": [round(float(value), 6) for value in medium.absorption],
        "scattering": [round(float(value), 6) for value in medium.scattering],
        "sun": {
            "elevation": water.sun.elevation,
            "azimuth": water.sun.azimuth,
            "irradiance": water.sun.irradiance,
        },
        "ripples_wind": None if ripples is None else ripples.wind_speed,
        "particles": [] if water.particles is None else list(_particles(water.particles)),
    }


def _particles(particles: ParticlesSpec) -> Iterator[str]:
    snow, bubbles = particles.marine_snow, particles.bubbles
    if snow is not None:
        yield f"marine snow {snow.concentration:g} 1/m3"
    if bubbles is not None and bubbles.source is None:
        yield f"bubbles {bubbles.concentration:g} 1/m3 at the surface"
    elif bubbles is not None and bubbles.source is not None:
        place = ", ".join(f"{value:.4g}" for value in bubbles.source)
        yield f"bubbles {bubbles.rate:g} 1/s from ({place}) m"
    if particles.sediment is not None:
        yield "sediment that thrusters stir up"

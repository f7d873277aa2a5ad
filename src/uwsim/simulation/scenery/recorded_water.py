"""Physical water in recorded motion: two numbers from which films draw it again.

A scene updater scales the medium of the scene file and sets the exposure. The numbers are the beam
attenuation of the green channel [1/m] and the binary logarithm of the exposure, in stops.
"""

from __future__ import annotations

import math
from dataclasses import replace

from ...optics import Medium
from ...rendering.water import Water

GREEN = 1
"""The channel of the recorded beam attenuation."""


def measure_water(water: Water) -> tuple[float, ...]:
    """Return the beam attenuation [1/m] and the exposure [stops]; nothing without physical water.

    Args:
        water: the present water.
    """
    physical_water = water.physical_water
    if physical_water is None:
        return ()
    return float(physical_water.beam_attenuation[GREEN]), math.log2(physical_water.exposure)


def restore_water(
    water: Water, medium: Medium, beam_attenuation: float, exposure_level: float
) -> Water:
    """Return physical water with recorded numbers.

    Args:
        water: the water of the scene, which is physical.
        medium: the medium of the scene file.
        beam_attenuation: the beam attenuation of the green channel [1/m].
        exposure_level: the binary logarithm of the exposure [stops].
    """
    physical_water, scene_attenuation = water.physical_water, medium.beam_attenuation[GREEN]
    assert physical_water is not None
    if scene_attenuation > 0.0:
        medium = medium.scale(beam_attenuation / float(scene_attenuation))
    exposure = 2.0**exposure_level
    return replace(water, physical_water=replace(physical_water, medium=medium, exposure=exposure))

"""The numbers with which the page draws physical water: what its shaders and its open water need.

The numbers of one medium in one light are ``optics``::

    {absorption: 3, scattering: 3,     a and b of red, green and blue [1/m]
     exposure, clear_exposure,         the ratio of full scale to radiance [1], and that of views
                                       through the purest water
     field: 2, phase: 8,               e0 and k of the whole field; ln p as a polynomial
     scale, forward,                   the middle range [m] of the table of the weights of blur; the
                                       share of light that is scattered forward
     transform: {min_frequency, max_frequency, values: ref f4},
                                       the transform Q of single scattering at frequencies in equal
                                       ratios [cycles/rad]
     sun: 3, beam: 3, beam_loss: 3, total: 3, loss: 3, reflectance: 3,
                                       `uwsim.rendering.physical.daylight_field.LightField`
     open_water: {scattering: 3, molecules: 3, attenuation: 3, asymmetry, backscatter, window}
                                       b*, b_w, c* [1/m]; g and the backscatter ratio of p*; the
                                       radiance of the sky in Snell's window
     lamps: [[share, factor]],         EE(half angle) - A and k_L of each lamp of the head
     caustics: null or {...},          `uwsim.viewer.caustics`
     linear, blur, lamp_veil,          true for linear stored values, for blur, for veils of lamps
     blur_margin}                      the share of the image that is drawn beyond each edge
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt

from ..base.numerics.elementwise import exp
from ..devices.lamp import MountedLamp
from ..devices.led_array import Led
from ..optics import PhaseFunction
from ..rendering.physical.blur_weights import (
    HIGHEST_FREQUENCY,
    LOWEST_FREQUENCY,
    find_table_scale,
)
from ..rendering.physical.daylight_field import (
    compute_light_field,
    compute_scaled_attenuation,
    compute_window_radiance,
    scale_scattering,
)
from ..rendering.physical.optics_block import compute_phase_numbers, find_lamp_numbers
from ..rendering.physical.physical_water import PhysicalWater
from .caustics import describe_focusing
from .pack import Blob

Json = dict[str, Any]
N_FREQUENCIES = 256
"""The number of frequencies at which the transform of a phase function is sent."""


def describe_optics(
    water: PhysicalWater, clear_exposure: float, lamps: Sequence[MountedLamp | Led], blob: Blob
) -> Json:
    """Return the entry of a medium in its light.

    Args:
        water: the water and its light.
        clear_exposure: the exposure of views through the purest water.
        lamps: the lamps of the scene, in the order of the head.
        blob: the binary part of the pack, to which the transform is appended.
    """
    medium = water.medium
    numbers = compute_phase_numbers(medium.phase_function)
    field = compute_light_field(medium, water.daylight)
    phase, scattering = scale_scattering(medium)
    return {
        "absorption": list(medium.absorption),
        "scattering": list(medium.scattering),
        "exposure": water.exposure,
        "clear_exposure": clear_exposure,
        "field": list(numbers.field_coefficients),
        "phase": numbers.polynomial.tolist(),
        "scale": find_table_scale(medium),
        "forward": 1.0 - medium.phase_function.backscatter_ratio,
        "transform": {
            "min_frequency": LOWEST_FREQUENCY,
            "max_frequency": HIGHEST_FREQUENCY,
            "values": blob.add(_compute_transform(medium.phase_function)),
        },
        "sun": field.towards_sun.tolist(),
        "beam": field.beam.tolist(),
        "beam_loss": field.beam_attenuation.tolist(),
        "total": field.total.tolist(),
        "loss": field.diffuse_attenuation.tolist(),
        "reflectance": field.reflectance.tolist(),
        "open_water": {
            "scattering": scattering.tolist(),
            "molecules": medium.molecules.tolist(),
            "attenuation": compute_scaled_attenuation(medium).tolist(),
            "asymmetry": phase.asymmetry,
            "backscatter": phase.backscatter_ratio,
            "window": compute_window_radiance(water.daylight),
        },
        "lamps": [
            find_lamp_numbers(medium.phase_function, float(np.radians(lamp.spec.fov / 2.0)))
            for lamp in lamps
        ],
        "caustics": describe_focusing(water),
        "linear": water.transfer == "linear",
        "blur": water.has_blur,
        "blur_margin": water.blur_margin,
        "lamp_veil": water.has_lamp_veil,
    }


@lru_cache(maxsize=16)
def _compute_transform(phase: PhaseFunction) -> npt.NDArray[np.float32]:
    low, high = math.log(LOWEST_FREQUENCY), math.log(HIGHEST_FREQUENCY)
    frequencies = exp(np.linspace(low, high, N_FREQUENCIES))
    return phase.compute_transform(frequencies).astype("<f4")

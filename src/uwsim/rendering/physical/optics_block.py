"""The uniform block ``Optics``: the numbers of physical water, which are constant in an image."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import moderngl
import numpy as np

from ...base.geometry import Array, Intrinsics
from ...base.numerics.elementwise import log
from ...optics import Medium, PhaseFunction
from ...optics.lamp_light import find_lamp_coefficients
from ...optics.transmission import find_field_coefficients
from ..lights.lamp import Lamp
from ..program import Block
from .blur_plan import MAX_LEVELS, plan_blur
from .blur_weights import find_table_scale
from .daylight_field import compute_light_field
from .physical_water import PhysicalWater

OPTICS = Block(
    "Optics",
    4,
    {
        "absorption": "vec4",
        "scattering": "vec4",
        "reach": "vec4[2]",
        "camera": "vec4",
        "sun_beam": "vec4",
        "sun_loss": "vec4",
        "daylight_total": "vec4",
        "daylight_loss": "vec4",
        "upwelling": "vec4",
        "phase_low": "vec4",
        "phase_high": "vec4",
        "ray_first": "vec4",
        "ray_column": "vec4",
        "ray_row": "vec4",
        "lamp_optics": "vec4[4]",
    },
)

PHASE_ORDER = 7
"""The order of the polynomial in place of ln p."""
MIN_PHASE_ANGLE = math.radians(1.0)
"""The smallest scattering angle of the polynomial [rad]; below it p is constant."""


@dataclass(frozen=True, eq=False)
class PhaseNumbers:
    """The numbers of a phase function that the shaders need."""

    field_coefficients: tuple[float, float]
    """The coefficients e0 and k of the whole field."""
    polynomial: Array
    """The coefficients of ln p over q = ((1 - cos) / 2)^(1/4), the constant first, (8,)."""


@lru_cache(maxsize=16)
def compute_phase_numbers(phase: PhaseFunction) -> PhaseNumbers:
    """Compute the numbers of a phase function for the shaders."""
    return PhaseNumbers(
        field_coefficients=find_field_coefficients(phase),
        polynomial=fit_phase_polynomial(phase),
    )


def fit_phase_polynomial(phase: PhaseFunction) -> Array:
    """Fit ln p by a polynomial of the seventh order in q = ((1 - cos) / 2)^(1/4), (8,).

    The polynomial is the interpolation at Chebyshev's points from 1 to 180 degrees. For Fournier
    and Forand's default it is within 1.5 % above 75 degrees and within 5 % above 3 degrees.
    """
    low = math.sqrt(math.sin(0.5 * MIN_PHASE_ANGLE))
    n = PHASE_ORDER + 1
    angles = math.pi * (np.arange(n) + 0.5) / n
    cosines = np.array([math.cos(angle) for angle in angles])
    middle, half_width = 0.5 * (1.0 + low), 0.5 * (1.0 - low)
    nodes = middle + half_width * cosines
    scattering_angles = [2.0 * math.asin(node * node) for node in nodes.tolist()]
    values = log(phase.compute_density(np.array(scattering_angles)))
    series = [
        (2.0 if order else 1.0)
        / n
        * math.fsum(float(v) * math.cos(order * a) for v, a in zip(values, angles, strict=True))
        for order in range(n)
    ]
    polynomial = np.polynomial.Chebyshev(series, domain=[low, 1.0]).convert(
        kind=np.polynomial.Polynomial
    )
    return np.asarray(polynomial.coef, dtype=np.float64)


class OpticsBlock:
    """The buffer of the uniform block ``Optics`` (``shaders/optics.glsl``)."""

    def __init__(self, context: moderngl.Context) -> None:
        self._values = np.zeros((), dtype=OPTICS.dtype)
        self._buffer = context.buffer(reserve=OPTICS.dtype.itemsize, dynamic=True)

    def fill(
        self,
        water: PhysicalWater,
        intrinsics: Intrinsics,
        lamps: Sequence[Lamp],
        light_rate: float,
    ) -> None:
        """Write the values of an image and bind the buffer."""
        values, medium = self._values, water.medium
        self._fill_medium(medium)
        reach = plan_blur(intrinsics, has_blur=water.has_blur).reach
        values["reach"].reshape(MAX_LEVELS)[: len(reach)] = reach
        values["camera"] = 0.0, water.exposure, find_table_scale(medium), 0.0
        self._fill_daylight(water, light_rate)
        self._fill_rays(intrinsics)
        for number, lamp in enumerate(lamps):
            cosine = math.cos(lamp.half_angle)
            is_cone = lamp.half_angle < 0.5 * math.pi
            share, factor = find_lamp_numbers(medium.phase_function, lamp.half_angle)
            values["lamp_optics"][number] = share, factor, cosine * cosine, float(is_cone)
        self._buffer.write(values.tobytes())
        self._buffer.bind_to_uniform_block(OPTICS.binding)

    def _fill_medium(self, medium: Medium) -> None:
        values, phase = self._values, compute_phase_numbers(medium.phase_function)
        values["absorption"] = *medium.absorption, phase.field_coefficients[0]
        values["scattering"] = *medium.scattering, phase.field_coefficients[1]
        values["phase_low"], values["phase_high"] = phase.polynomial[:4], phase.polynomial[4:]

    def _fill_daylight(self, water: PhysicalWater, light_rate: float) -> None:
        values = self._values
        if water.isotropic_radiance is not None:
            values["sun_beam"] = values["sun_loss"] = values["daylight_loss"] = 0.0
            values["daylight_total"][:3] = light_rate * np.array(water.isotropic_radiance)
            values["upwelling"] = 1.0
            return
        field = compute_light_field(water.medium, water.daylight)
        sun_cosine = float(field.towards_sun[2])
        values["sun_beam"][:3] = light_rate * field.beam
        values["sun_loss"][:3] = field.beam_attenuation
        values["daylight_total"][:3] = light_rate * field.total
        values["daylight_loss"][:3] = field.diffuse_attenuation
        values["upwelling"] = *field.reflectance, sun_cosine

    def _fill_rays(self, intrinsics: Intrinsics) -> None:
        """Fill the ray of a pixel as a linear function of ``gl_FragCoord``, with z = -1."""
        lens, values = intrinsics, self._values
        column = 1.0 / lens.fx
        row = -1.0 / lens.fy
        skew = lens.skew * row / lens.fx  # x of a point at the height y: u = fx x + skew y + cx
        first_y = row * (-0.5 - lens.cy)
        first_x = column * (-0.5 - lens.cx) - lens.skew * first_y / lens.fx
        values["ray_first"] = first_x, first_y, -1.0, 0.0
        values["ray_column"] = column, 0.0, 0.0, 0.0
        values["ray_row"] = -skew, row, 0.0, 0.0


@lru_cache(maxsize=64)
def find_lamp_numbers(phase: PhaseFunction, half_angle: float) -> tuple[float, float]:
    """Find the numbers EE - A and k_L of a lamp's cone with a half angle [rad]."""
    return find_lamp_coefficients(phase, half_angle)

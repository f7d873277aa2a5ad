"""Physical water as the renderer needs it: the medium, its daylight, and the exposure."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Literal

from ...base.geometry import Triple
from ...errors import BadSetting, ErrorCollector
from ...optics import Medium
from ..caustics.ripples import Ripples

Transfer = Literal["srgb", "linear"]
"""The curve from relative light to stored values."""

N_CHANNELS = 3
"""The number of channels of an image: red, green and blue."""


@dataclass(frozen=True, kw_only=True)
class Daylight:
    """The light of sun and sky above the water.

    Raises:
        BadSetting: a number is invalid.
        SeveralErrors: several are.
    """

    elevation: float = math.radians(50.0)
    """The elevation of the sun above the horizon [rad], 0 to pi/2."""
    azimuth: float = 0.0
    """The direction of the sun from W's x axis towards y [rad]."""
    irradiance: float = 1.0
    """The irradiance of a level surface above the water by sun and sky, 0 at night [1]."""
    sky_share: float = 0.3
    """The share of the sky in the irradiance, 0..1."""

    def __post_init__(self) -> None:
        errors = ErrorCollector()
        for is_valid, text in (
            (
                0.0 <= self.elevation <= 0.5 * math.pi + 1e-9,
                f"The elevation of the sun is {self.elevation:g} rad; expected 0 to pi/2.",
            ),
            (
                math.isfinite(self.azimuth),
                f"The azimuth of the sun is {self.azimuth:g} rad; expected a finite number.",
            ),
            (
                0.0 <= self.irradiance < math.inf,
                f"The irradiance of daylight is {self.irradiance:g}; expected 0 or more.",
            ),
            (
                0.0 <= self.sky_share <= 1.0,
                f"The share of the sky is {self.sky_share:g}; expected 0 to 1.",
            ),
        ):
            with errors.collect():
                if not is_valid:
                    raise BadSetting(text)
        errors.raise_errors()


@dataclass(frozen=True, kw_only=True)
class PhysicalWater:
    """The inputs of the physical image model.

    The radiance 1 is that of a white surface in the irradiance 1.

    Raises:
        BadSetting: the medium does not have three channels, or the exposure is invalid.
    """

    medium: Medium
    """The water, in red, green and blue."""
    daylight: Daylight = field(default_factory=Daylight)
    """The light above the surface."""
    exposure: float = 1.0
    """The ratio of full scale to radiance: stored linear value over radiance [1]."""
    transfer: Transfer = "srgb"
    """The curve from linear to stored values."""
    has_blur: bool = True
    """True if light that is scattered forward blurs the image; else it counts as sharp."""
    blur_margin: float = 0.0
    """The share of the image that is drawn beyond each of its edges, so that scattered light of
    what is outside reaches it [1]."""
    has_lamp_veil: bool = True
    """True if the water scatters the light of lamps into the camera."""
    ripples: Ripples | None = None
    """The ripples of a moving surface; None: it has none, and there are no caustics."""
    has_caustics: bool = True
    """True if a moving surface focuses the sun's light on surfaces."""
    has_light_shafts: bool = True
    """True if a moving surface focuses the sun's light that the water scatters."""
    has_surface: bool = False
    """True if images show the water's surface, the sky and the air above; else the water fills
    them, and a level surface is part of the open water."""
    has_mirror: bool = True
    """True if the surface mirrors bodies on the side of the camera; else it mirrors those above it
    that are in the picture."""
    visibility: float = 30e3
    """The distance in air at which 2 % of the contrast to the horizon are left [m]."""
    isotropic_radiance: Triple | None = None
    """The radiance of a light field that is equal in all directions and at all depths, instead of
    daylight; for tests of energy conservation."""

    @property
    def beam_attenuation(self) -> tuple[float, ...]:
        """The beam attenuation c of each channel [1/m]."""
        return tuple(self.medium.beam_attenuation.tolist())

    @property
    def has_focused_light(self) -> bool:
        """True if a moving surface focuses light: the sun shines, and there are ripples."""
        daylight = self.daylight
        has_beam = daylight.irradiance > 0.0 and daylight.sky_share < 1.0
        return self.ripples is not None and has_beam and self.isotropic_radiance is None

    def __post_init__(self) -> None:
        if self.medium.n_channels != N_CHANNELS:
            raise BadSetting(
                f"Physical water has {self.medium.n_channels} channels; expected {N_CHANNELS}: "
                "red, green and blue."
            )
        if not 0.0 < self.exposure < math.inf:
            raise BadSetting(f"The exposure is {self.exposure:g}; expected a positive number.")

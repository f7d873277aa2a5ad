"""The spec of the water: ``<oceanState>`` and its ``<fog>``."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..acoustics import SeaWater
from ..base.geometry import Triple
from ..currents import CURRENTS, CurrentSpec
from ..schema import MAX_DISTANCE, NAMESPACE, REQUIRED_BY_DTD, Numbers, Original, Spec, element
from ..waves import WAVE_SYSTEMS, SeaSettings, WaveSystemSpec
from .physical_water import PhysicalWaterSpec
from .seawater import sea_water_density

NIGHT_BLUE: Triple = (0.0, 0.05, 0.3)
"""The default colour of the water, RGB [0..1]."""
WAVE_SETTING = Original(is_window_setting=True, used_by=f"{{{NAMESPACE}}}waves")
"""The option of an element that affects the original's window, and ``<u:waves>`` here."""
DEFAULT_TEMPERATURE = 15.0
"""The temperature of water of which only the salinity is given [degrees Celsius]."""


@dataclass(frozen=True, kw_only=True)
class FogSpec(Spec):
    """A ``<fog>``: the decrease of visibility with distance."""

    density: float = element(default=0.1, original=REQUIRED_BY_DTD, minimum=0, maximum=1e6)
    """The density: the share ``1 - exp(-(density d)^2)`` of light is lost at a distance d [1/m]."""
    color: Triple = element(default=NIGHT_BLUE, parts="rgb", original=REQUIRED_BY_DTD)
    """The colour that replaces the lost light [0..1]."""


@dataclass(frozen=True, kw_only=True)
class ProfileSpec(Spec):
    """A ``<u:profile>``: stratified water, linear between levels, constant above and below them."""

    depth: Numbers = element(namespaced=True, minimum=0.0)
    """The depth of the levels below the surface, rising, two or more [m]."""
    density: Numbers = element(namespaced=True, default=(), minimum=100.0, maximum=20000.0)
    """The density of the water at each level [kg/m3]."""
    temperature: Numbers = element(namespaced=True, default=(), minimum=-2.0, maximum=40.0)
    """The temperature at each level instead of the density, for EOS-80 [degrees Celsius]."""
    salinity: Numbers = element(namespaced=True, default=(), minimum=0.0, maximum=42.0)
    """The salinity at each level, with the temperature; without it 0 [g/kg]."""

    @property
    def levels(self) -> tuple[tuple[float, float], ...]:
        """The depth [m] and density [kg/m3] of each level."""
        densities = self.density or tuple(
            map(sea_water_density, self.temperature, self.salinity or (0.0,) * len(self.depth))
        )
        return tuple(zip(self.depth, densities, strict=True))

    def errors(self) -> list[str]:
        """Return the errors in the numbers of the levels."""
        n = len(self.depth)
        if n < 2 or any(b <= a for a, b in pairwise(self.depth)):
            return [f"<u:depth> has {n} depths; expected 2 or more, rising [m]"]
        if bool(self.density) == bool(self.temperature):
            return ["expected one of <u:density> and <u:temperature>, a number for each depth"]
        columns = {"density": self.density, "temperature": self.temperature}
        columns["salinity"] = self.salinity
        return [
            f"<u:{name}> has {len(numbers)} numbers; expected {n}, one for each depth"
            for name, numbers in columns.items()
            if numbers and len(numbers) != n
        ]

    def density_at(self, depth: float) -> float:
        """Return the density at a depth [kg/m3]."""
        depths, densities = zip(*self.levels, strict=True)
        return float(np.interp(depth, depths, densities))


@dataclass(frozen=True, kw_only=True)
class OceanStateSpec(Spec):
    """An ``<oceanState>``: the water surface and the properties of the water."""

    windx: float = element(default=0.04, original=WAVE_SETTING)
    """The wind direction along x; the length of the direction vector scales the waves [1]."""
    windy: float = element(default=0.04, original=WAVE_SETTING)
    """The wind direction along y; the length of the direction vector scales the waves [1]."""
    wind_speed: float = element(default=12.0, original=WAVE_SETTING)
    """The wind speed of the wave spectrum [m/s]."""
    depth: float = element(default=1000.0, original=WAVE_SETTING)
    """The depth of the water, only for waves; it adds no floor [m]."""
    reflection_damping: float = element(default=0.35, original=WAVE_SETTING)
    """The factor on waves that travel against the wind [1]."""
    wave_scale: float = element(default=1e-7, original=WAVE_SETTING)
    """The amplitude of the wave spectrum [1]."""
    is_not_choppy: bool = element(
        default=False, original=Original(invalid_flag_value=True, is_window_setting=True)
    )
    """True if waves displace points of the surface only vertically."""
    choppy_factor: float = element(default=2.5, original=Original(is_window_setting=True))
    """The factor on the horizontal displacement of points of the surface by waves [1]."""
    crest_foam_height: float = element(default=2.2, original=Original(is_window_setting=True))
    """The height from which wave crests foam; read but not used, as in the original UWSim [m]."""
    ocean_surface_height: float = element(default=0.0, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """The height of the water surface in the world frame W, z up [m]."""
    fog: FogSpec = element(default=FogSpec())
    """The decrease of visibility with distance."""
    color: Triple = element(default=NIGHT_BLUE, parts="rgb")
    """The light that the water scatters into the view [0..1]."""
    attenuation: Triple = element(
        default=(0.015, 0.0075, 0.005), parts="rgb", minimum=0, maximum=1e6
    )
    """The loss of red, green and blue light per distance [1/m]."""
    density: float | None = element(namespaced=True, default=None, minimum=100.0, maximum=20000.0)
    """The density of the water [kg/m3]; without it the density at the temperature and salinity, and
    without these the density in the hydrodynamics files of the vehicles."""
    temperature: float | None = element(namespaced=True, default=None, minimum=-2.0, maximum=40.0)
    """The temperature, for the density by EOS-80 [degrees Celsius]; 15 with salinity alone."""
    salinity: float | None = element(namespaced=True, default=None, minimum=0.0, maximum=42.0)
    """The salinity, for the density by EOS-80 [g/kg]; 0 if only temperature is given, 35 at sea."""
    profile: ProfileSpec | None = element(namespaced=True, default=None)
    """The density over depth, instead of density, temperature and salinity."""
    currents: tuple[CurrentSpec, ...] = element(
        "current", namespaced=True, default=(),
        choice={f"{{{NAMESPACE}}}{name}": spec for name, spec in CURRENTS.items()},
    )  # fmt: skip
    """The currents, whose velocities are added."""
    waves: tuple[WaveSystemSpec, ...] = element(
        namespaced=True, default=(),
        choice={f"{{{NAMESPACE}}}{name}": spec for name, spec in WAVE_SYSTEMS.items()},
    )  # fmt: skip
    """The wave systems of the surface, which add up; when absent the surface is level."""

    @property
    def sea(self) -> SeaSettings:
        """The settings of the sea that wave systems may need."""
        return SeaSettings(
            depth=self.depth,
            wind=(self.windx, self.windy),
            wind_speed=self.wind_speed,
            reflection_damping=self.reflection_damping,
            wave_scale=self.wave_scale,
        )

    water: PhysicalWaterSpec | None = element(namespaced=True, default=None)
    """The physical law of images; when absent fog, colour and attenuation hold."""

    @property
    def sea_water(self) -> SeaWater:
        """The water as an acoustic medium; sea water if the file gives no salinity."""
        temperature = DEFAULT_TEMPERATURE if self.temperature is None else self.temperature
        default_salinity = 0.0 if self.temperature is not None else SeaWater.salinity
        return SeaWater(temperature, default_salinity if self.salinity is None else self.salinity)

    @property
    def water_density(self) -> float | None:
        """The density at the surface [kg/m3]; None if the file gives none."""
        if self.profile is not None:
            return self.profile.density_at(0.0)
        if self.density is not None:
            return self.density
        if self.temperature is None and self.salinity is None:
            return None
        temperature = DEFAULT_TEMPERATURE if self.temperature is None else self.temperature
        return sea_water_density(temperature, self.salinity or 0.0)

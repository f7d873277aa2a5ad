"""Waves of the water's surface: spectra, linear theory, and what they do below it."""

from __future__ import annotations

from .components import WaveComponents, draw_components
from .dispersion import wave_numbers
from .jonswap import JonswapSpec
from .pierson_moskowitz import PiersonMoskowitzSpec
from .regular_wave import RegularWaveSpec
from .spectrum import Spectrum
from .uwsim_ocean import UwsimOceanSpec
from .wave_system import (
    MAX_HEIGHT,
    IrregularWavesSpec,
    SeaSettings,
    WaveSystemSpec,
    find_sea_errors,
)
from .waves import WaterUnderWaves, Waves, bind_waves

WAVE_SYSTEMS: dict[str, type[WaveSystemSpec]] = {
    "jonswap": JonswapSpec,
    "piersonMoskowitz": PiersonMoskowitzSpec,
    "regularWave": RegularWaveSpec,
    "uwsimOcean": UwsimOceanSpec,
}
"""The spec of each element of ``<u:waves>``."""

__all__ = [
    "MAX_HEIGHT",
    "WAVE_SYSTEMS",
    "IrregularWavesSpec",
    "JonswapSpec",
    "PiersonMoskowitzSpec",
    "RegularWaveSpec",
    "SeaSettings",
    "Spectrum",
    "UwsimOceanSpec",
    "WaterUnderWaves",
    "WaveComponents",
    "WaveSystemSpec",
    "Waves",
    "bind_waves",
    "draw_components",
    "find_sea_errors",
    "wave_numbers",
]

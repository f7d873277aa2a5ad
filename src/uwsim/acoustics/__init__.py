"""Acoustics of water: sound speed, absorption, ambient noise, backscatter."""

from .absorption import absorption
from .ambient_noise import ambient_noise, power_sum
from .material import MATERIALS, Material, MaterialName
from .sea_water import SeaWater
from .sound_speed import sound_speed
from .thorp import thorp_absorption

__all__ = [
    "MATERIALS",
    "Material",
    "MaterialName",
    "SeaWater",
    "absorption",
    "ambient_noise",
    "power_sum",
    "sound_speed",
    "thorp_absorption",
]

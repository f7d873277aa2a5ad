"""Sound in water: how fast it is, what the water takes, what comes back from a surface."""

from .absorption import absorption
from .sound_speed import sound_speed

__all__ = ["absorption", "sound_speed"]

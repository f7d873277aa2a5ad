"""Water by wavelength: its spectra, and their reduction to the three channels of an image."""

from .jerlov import find_jerlov_spectrum
from .pure_water import find_pure_water
from .spectral_water import SpectralWater
from .spectrum_table import read_spectrum_table

__all__ = ["SpectralWater", "find_jerlov_spectrum", "find_pure_water", "read_spectrum_table"]

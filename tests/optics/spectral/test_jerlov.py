"""The colours of Jerlov's types, against the scale of Forel and Ule.

The scale has 21 colours of natural waters, from the blue of the open ocean (1) over green (6 to 9)
to brown (21). S. Novoa and others (*J. Eur. Opt. Soc. Rapid Publ.* 8, 13057 (2013), table 5)
measured their chromaticities. The index of a water is that of the nearest hue angle around the
white of equal energy (M. R. Wernand and H. J. van der Woerd, *J. Eur. Opt. Soc. Rapid Publ.* 5,
10014s (2010)). The colour of deep water is bb / (a + bb).
"""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.optics import PETZOLD_AVERAGE, Medium, find_water
from uwsim.optics.spectral import SpectralWater, find_jerlov_spectrum, find_pure_water
from uwsim.optics.spectral.colorimetry import OBSERVER, SRGB_FROM_XYZ, compute_channel_weights
from uwsim.optics.spectral.jerlov import DIFFUSE_ATTENUATION

FOREL_ULE = (
    *((0.191, 0.167), (0.199, 0.200), (0.210, 0.240), (0.227, 0.288), (0.246, 0.335)),
    *((0.266, 0.376), (0.291, 0.412), (0.315, 0.440), (0.337, 0.462), (0.363, 0.476)),
    *((0.386, 0.487), (0.402, 0.481), (0.416, 0.474), (0.431, 0.466), (0.446, 0.458)),
    *((0.461, 0.449), (0.475, 0.441), (0.489, 0.433), (0.503, 0.425), (0.516, 0.416)),
    (0.528, 0.408),
)
"""The chromaticity (x, y) of each colour of the scale."""
EQUAL_ENERGY = (1.0 / 3.0, 1.0 / 3.0)
D65 = (0.3127, 0.3290)
EXPECTED_INDEX = {
    **{"I": (1, 2), "IA": (1, 2), "IB": (1, 3), "II": (2, 4), "III": (3, 5)},
    **{"1C": (5, 8), "3C": (5, 8), "5C": (5, 9), "7C": (7, 11), "9C": (10, 14)},
}
"""The least and greatest index of each type: blue ocean, green coast, olive to brown harbours."""


def compute_hue(chromaticity: tuple[float, float], white: tuple[float, float]) -> float:
    """Return the hue angle of a colour around a white [degrees]."""
    x, y = chromaticity
    return math.degrees(math.atan2(y - white[1], x - white[0])) % 360.0


def find_index(chromaticity: tuple[float, float], white: tuple[float, float]) -> int:
    """Return the index of Forel and Ule of a colour around a white."""
    hue = compute_hue(chromaticity, white)
    angles = [compute_hue(colour, EQUAL_ENERGY) for colour in FOREL_ULE]
    return 1 + min(range(len(angles)), key=lambda i: abs(angles[i] - hue))


def compute_spectral_reflectance(water: SpectralWater) -> np.ndarray:
    """Return bb / (a + bb) at each wavelength."""
    (a, b), molecules = water.resample(), find_pure_water()[1]
    backscattering = PETZOLD_AVERAGE.backscatter_ratio * (b - molecules) + 0.5 * molecules
    return np.asarray(backscattering / (a + backscattering))


def compute_reflectance(medium: Medium) -> np.ndarray:
    """Return bb / (a + bb) of each channel."""
    return np.asarray(medium.backscattering / (np.array(medium.absorption) + medium.backscattering))


def find_chromaticity(xyz: np.ndarray) -> tuple[float, float]:
    """Return x and y of a colour."""
    x, y = (xyz[:2] / xyz.sum()).tolist()
    return x, y


@pytest.mark.parametrize("name", DIFFUSE_ATTENUATION)
def test_a_type_has_its_colour_on_the_scale_of_forel_and_ule(name: str) -> None:
    reflectance = compute_spectral_reflectance(find_jerlov_spectrum(name))
    index = find_index(find_chromaticity(np.array(OBSERVER) @ reflectance), EQUAL_ENERGY)
    least, greatest = EXPECTED_INDEX[name]
    assert least <= index <= greatest


@pytest.mark.parametrize("name", DIFFUSE_ATTENUATION)
def test_three_channels_have_the_colour_of_all_wavelengths(name: str) -> None:
    channels = compute_reflectance(find_water(f"jerlov-{name}"))
    spectrum = compute_spectral_reflectance(find_jerlov_spectrum(name))
    exact = np.maximum(np.stack(compute_channel_weights()) @ spectrum, 0.0)
    assert channels == pytest.approx(exact, abs=0.12 * exact.max())


@pytest.mark.parametrize("name", DIFFUSE_ATTENUATION)
def test_three_channels_are_within_one_step_of_the_scale(name: str) -> None:
    channels = compute_reflectance(find_water(f"jerlov-{name}"))
    xyz = np.linalg.inv(np.array(SRGB_FROM_XYZ)) @ channels
    index = find_index(find_chromaticity(xyz), D65)
    reflectance = compute_spectral_reflectance(find_jerlov_spectrum(name))
    exact = find_index(find_chromaticity(np.array(OBSERVER) @ reflectance), EQUAL_ENERGY)
    assert abs(index - exact) <= 1


def test_a_harbour_is_olive() -> None:
    """Its green was twice its red, lime, when each channel had one wavelength."""
    red, green, blue = compute_reflectance(find_water("jerlov-9C")).tolist()
    assert 0.8 * green < red <= green
    assert blue < 0.6 * green


def test_the_open_ocean_is_blue_and_the_coast_green() -> None:
    ocean = compute_reflectance(find_water("jerlov-I"))
    assert ocean[2] > 5.0 * ocean[1] > 5.0 * ocean[0]
    for name in ("jerlov-3C", "jerlov-5C", "jerlov-7C"):
        assert compute_reflectance(find_water(name)).argmax() == 1


def test_the_types_have_their_diffuse_attenuation() -> None:
    for name, column in DIFFUSE_ATTENUATION.items():
        attenuation = find_water(f"jerlov-{name}").diffuse_attenuation[1]
        assert attenuation == pytest.approx(column[7] / 100.0, rel=0.15)  # 550 nm

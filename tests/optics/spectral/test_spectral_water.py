"""The reduction of spectra to three channels, against the sum over wavelengths."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.errors import BadSetting, SeveralErrors
from uwsim.optics import WATERS, HenyeyGreenstein
from uwsim.optics.medium import KIRK_FACTOR
from uwsim.optics.spectral import SpectralWater, find_jerlov_spectrum, find_pure_water
from uwsim.optics.spectral.colorimetry import WAVELENGTHS, compute_channel_weights
from uwsim.optics.spectral.jerlov import DIFFUSE_ATTENUATION
from uwsim.optics.spectral.pure_water import scale_particles

LARGEST_ERRORS = (0.073, 0.017, 0.03)
"""The largest errors of the light of a white surface in red, green and blue [1]."""
TYPES = tuple(DIFFUSE_ATTENUATION)
AC9 = (412.0, 440.0, 488.0, 510.0, 532.0, 555.0, 650.0, 676.0, 715.0)
"""The bands of an ac-9 [nm]."""


def make_spectrum(name: str) -> SpectralWater:
    """Return the spectrum of a named water."""
    if name.startswith("jerlov-"):
        return find_jerlov_spectrum(name.removeprefix("jerlov-"))
    absorption, molecules = find_pure_water()
    scatterings = {
        "clear": molecules,
        "pool": scale_particles(0.05, 1.0),
        "tank": scale_particles(0.1435, 1.0),
    }
    return SpectralWater(
        wavelengths=tuple(WAVELENGTHS.tolist()),
        absorption=tuple(absorption.tolist()),
        scattering=tuple(scatterings[name].tolist()),
    )


def integrate_light(attenuation: np.ndarray, ranges: np.ndarray) -> np.ndarray:
    """Return the light of a white surface that is left in each channel, (3, n)."""
    light = np.exp(-np.outer(attenuation, ranges))
    # a display shows no negative light: colours outside of sRGB are cut
    return np.maximum(np.stack(compute_channel_weights()) @ light, 0.0)


@pytest.mark.parametrize("name", WATERS)
def test_the_numbers_of_a_named_water_are_those_of_its_spectrum(name: str) -> None:
    medium, water = make_spectrum(name).reduce(), WATERS[name]
    assert water.absorption == pytest.approx(medium.absorption, rel=5e-4)
    assert water.scattering == pytest.approx(medium.scattering, rel=5e-4)
    assert water.molecular_scattering == pytest.approx(medium.molecular_scattering, rel=5e-4)


@pytest.mark.parametrize("name", TYPES)
@pytest.mark.parametrize("quantity", ["absorption", "beam attenuation", "diffuse attenuation"])
def test_three_channels_have_the_light_of_all_wavelengths(name: str, quantity: str) -> None:
    water = find_jerlov_spectrum(name)
    (a, b), medium = water.resample(), water.reduce()
    spectrum, channels = {
        "absorption": (a, np.array(medium.absorption)),
        "beam attenuation": (a + b, medium.beam_attenuation),
        "diffuse attenuation": (np.sqrt(a * a + KIRK_FACTOR * a * b), medium.diffuse_attenuation),
    }[quantity]
    for channel, coefficient in enumerate(channels):
        ranges = np.linspace(0.0, 3.0 / coefficient, 61)  # three attenuation lengths
        exact = integrate_light(spectrum, ranges)[channel]
        error = np.abs(np.exp(-coefficient * ranges) - exact).max()
        assert error < LARGEST_ERRORS[channel]


def test_one_wavelength_for_each_channel_has_larger_errors() -> None:
    """Red at 680 nm, as these waters were given before, loses twice the light."""
    water = find_jerlov_spectrum("I")
    exact = integrate_light(water.resample()[0], np.array([2.0]))[0, 0]
    assert exact == pytest.approx(np.exp(-2.0 * water.reduce().absorption[0]), abs=0.03)
    assert exact > np.exp(-2.0 * 0.46) + 0.1


def test_grey_water_keeps_its_coefficients() -> None:
    phase = HenyeyGreenstein(0.9)
    absorption = find_pure_water()[0] * 0.0 + 0.3
    water = SpectralWater(
        wavelengths=tuple(WAVELENGTHS.tolist()),
        absorption=tuple(absorption.tolist()),
        scattering=(0.5,) * len(WAVELENGTHS),
        phase_function=phase,
    )
    medium = water.reduce()
    assert medium.absorption == pytest.approx((0.3, 0.3, 0.3))
    assert medium.scattering == pytest.approx((0.5, 0.5, 0.5))
    assert medium.phase_function == phase


@pytest.mark.parametrize(
    ("name", "bound"), [("I", 0.08), ("IB", 0.08), ("III", 0.08), ("3C", 0.08), ("9C", 0.26)]
)
def test_the_bands_of_an_ac9_are_interpolated(name: str, bound: float) -> None:
    """It has no band between 555 and 650 nm, where dissolved matter of harbours absorbs less."""
    full_water = find_jerlov_spectrum(name)
    absorption, scattering = full_water.resample()
    sparse_water = SpectralWater(
        wavelengths=AC9,
        absorption=tuple(np.interp(AC9, WAVELENGTHS, absorption).tolist()),
        scattering=tuple(np.interp(AC9, WAVELENGTHS, scattering).tolist()),
    )
    medium, expected = sparse_water.reduce(), full_water.reduce()
    assert medium.absorption == pytest.approx(expected.absorption, rel=bound)
    assert medium.scattering == pytest.approx(expected.scattering, rel=0.03)


def test_contents_are_added_to_pure_water() -> None:
    absorption, scattering = find_pure_water()
    contents = SpectralWater.from_contents(AC9, (0.1,) * 9, (0.4,) * 9)
    total_absorption, total_scattering = contents.resample()
    assert total_absorption == pytest.approx(absorption + 0.1)
    assert total_scattering == pytest.approx(scattering + 0.4)


@pytest.mark.parametrize(
    ("wavelengths", "absorption", "text"),
    [
        ((450.0, 620.0), (0.1, 0.1), "2 wavelengths; expected 3 to 1000"),
        ((450.0, 550.0, 650.0), (0.1, 0.1), "3 wavelengths and 2 values of absorption"),
        ((450.0, 650.0, 550.0), (0.1, 0.1, 0.1), "do not rise"),
        ((500.0, 550.0, 650.0), (0.1, 0.1, 0.1), "from 500 to 650 nm; expected at least 450"),
        ((0.45, 0.55, 0.65), (0.1, 0.1, 0.1), "is 0.45 nm; expected 300 to 1000 nm"),
        ((450.0, 550.0, 650.0), (0.1, -0.1, 0.1), "absorption at 550 nm is -0.1"),
    ],
)
def test_an_invalid_spectrum_is_rejected(
    wavelengths: tuple[float, ...], absorption: tuple[float, ...], text: str
) -> None:
    with pytest.raises((BadSetting, SeveralErrors), match=text):
        SpectralWater(
            wavelengths=wavelengths, absorption=absorption, scattering=(0.1,) * len(wavelengths)
        )

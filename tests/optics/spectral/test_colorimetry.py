"""The channels of an image as sums over wavelengths, against the definition of sRGB."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.optics.spectral.colorimetry import (
    DAYLIGHT,
    OBSERVER,
    WAVELENGTHS,
    compute_channel_weights,
    integrate_spectrum,
)


def test_a_white_surface_has_one_in_each_channel() -> None:
    for weights in compute_channel_weights():
        assert integrate_spectrum(weights, np.ones_like(WAVELENGTHS)) == pytest.approx(1.0)


def test_daylight_has_the_chromaticity_of_d65() -> None:
    xyz = np.array(OBSERVER) @ np.array(DAYLIGHT)
    assert (xyz / xyz.sum())[:2] == pytest.approx([0.3127, 0.3290], abs=2e-4)


def test_the_observer_has_the_chromaticities_of_spectral_lines() -> None:
    published = {480.0: (0.0913, 0.1327), 520.0: (0.0743, 0.8338), 600.0: (0.6270, 0.3725)}
    for wavelength, chromaticity in published.items():  # CIE 15
        xyz = np.array(OBSERVER)[:, WAVELENGTHS.tolist().index(wavelength)]
        assert (xyz / xyz.sum())[:2] == pytest.approx(chromaticity, abs=5e-4)

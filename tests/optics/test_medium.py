"""Media and named waters."""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.errors import BadSetting, SeveralErrors, UnknownName
from uwsim.optics import WATERS, FournierForand, Medium, find_water

JERLOV_KD_550 = {
    "jerlov-I": 0.063,
    "jerlov-IA": 0.067,
    "jerlov-IB": 0.072,
    "jerlov-II": 0.089,
    "jerlov-III": 0.120,
    "jerlov-1C": 0.12,
    "jerlov-3C": 0.19,
    "jerlov-5C": 0.30,
    "jerlov-7C": 0.46,
    "jerlov-9C": 0.63,
}
"""The diffuse attenuation at 550 nm [1/m], Jerlov (1976), table XXVII."""


def test_the_properties_of_a_medium_follow_from_its_coefficients() -> None:
    water = Medium.from_beam_attenuation([1.0, 0.5], [0.85, 0.3])
    np.testing.assert_allclose(water.absorption, [0.15, 0.2])
    np.testing.assert_allclose(water.beam_attenuation, [1.0, 0.5])
    np.testing.assert_allclose(water.single_scattering_albedo, [0.85, 0.6])
    np.testing.assert_allclose(water.attenuation_length, [1.0, 2.0])
    np.testing.assert_allclose(
        water.diffuse_attenuation[0], math.sqrt(0.15**2 + 0.256 * 0.15 * 0.85)
    )
    np.testing.assert_allclose(water.backscattering, np.array([0.85, 0.3]) * 0.018313, rtol=1e-4)


def test_water_without_attenuation_has_an_infinite_attenuation_length() -> None:
    water = Medium(absorption=(0.0,), scattering=(0.0,))
    assert water.attenuation_length == math.inf
    assert water.single_scattering_albedo == 0.0


def test_media_are_compared_by_their_numbers() -> None:
    water = Medium(absorption=(0.1,), scattering=(0.2,))
    assert water == Medium(absorption=(0.1,), scattering=(0.2,), phase_function=FournierForand())
    assert water != Medium(absorption=(0.1,), scattering=(0.3,))


def test_all_errors_of_coefficients_are_reported() -> None:
    with pytest.raises(SeveralErrors) as error:
        Medium(absorption=(0.1, -0.1, math.nan), scattering=(1e6, 0.1, 0.1))
    lines = str(error.value).splitlines()
    assert lines[0].startswith("The absorption of green is -0.1 1/m; expected 0 to 1000")
    assert len(lines) == 3


@pytest.mark.parametrize(
    ("absorption", "scattering", "message"),
    [
        ((), (), "0 channels; expected 1 to 64"),
        ((0.1,) * 65, (0.1,) * 65, "65 channels"),
        ((0.1, 0.1), (0.1,), "2 absorption and 1 scattering"),
    ],
)
def test_a_wrong_number_of_channels_is_rejected(
    absorption: tuple[float, ...], scattering: tuple[float, ...], message: str
) -> None:
    with pytest.raises(BadSetting, match=message):
        Medium(absorption=absorption, scattering=scattering)


def test_scattering_above_the_beam_attenuation_is_rejected() -> None:
    with pytest.raises(BadSetting, match=r"scattering of channel 2 is 0\.6"):
        Medium.from_beam_attenuation([1.0, 0.5], [0.85, 0.6])
    with pytest.raises(BadSetting, match="2 absorption and 1 scattering"):
        Medium.from_beam_attenuation([1.0, 0.5], [0.85])


@pytest.mark.parametrize("name", WATERS)
def test_each_named_water_has_a_source(name: str) -> None:
    water = WATERS[name]
    assert water.source
    assert find_water(name).absorption == water.absorption


@pytest.mark.parametrize(("name", "expected"), JERLOV_KD_550.items())
def test_the_diffuse_attenuation_of_jerlov_types_is_near_his(name: str, expected: float) -> None:
    assert find_water(name).diffuse_attenuation[1] == pytest.approx(expected, rel=0.25)


def test_an_unknown_water_gives_the_nearest_name() -> None:
    with pytest.raises(UnknownName, match="Did you mean 'jerlov-5C'"):
        find_water("jerlov-5")

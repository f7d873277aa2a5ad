"""Conversions of water to fog, ranges and depths, against published examples and tables."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.optics.reference_tables import PHASES, read_rows, water_of
from uwsim.errors import BadSetting
from uwsim.optics import FournierForand, HenyeyGreenstein, Lamp, Medium
from uwsim.optics.conversions import View, WaterEstimate, convert_water, propagate_error
from uwsim.optics.visibility import (
    compute_fog_density,
    compute_lamp_contrast,
    compute_lamp_range,
    compute_secchi_depth,
    compute_transfer,
    compute_visual_range,
    find_attenuation_of_contrast,
    find_attenuation_of_fog,
    find_feature_frequency,
)

EXAMPLE = water_of(FournierForand(), 1.0, 0.85)
DISTANCE = 1.36


def lamp_at(offset: float) -> Lamp:
    return Lamp(
        position=(offset, 0.0, 0.0),
        direction=(0.0, 0.0, 1.0),
        intensity=(1.0,),
        half_angle=math.radians(30.0),
    )


@pytest.mark.parametrize(
    ("frequency", "transfer", "fog"),
    [(None, 0.257, 0.857), (100.0, 0.303, 0.803), (10.0, 0.426, 0.679), (1.0, 0.680, 0.456)],
)
def test_the_fog_of_a_water_depends_on_the_scale(
    frequency: float | None, transfer: float, fog: float
) -> None:
    """Compare with the example of the reference: c = 1/m, b/c = 0.85, at 1.36 m."""
    assert compute_transfer(EXAMPLE, DISTANCE, frequency)[0] == pytest.approx(transfer, abs=0.0015)
    assert compute_fog_density(EXAMPLE, DISTANCE, frequency)[0] == pytest.approx(fog, abs=0.0015)


def test_the_secchi_depth_and_diffuse_attenuation_of_the_example() -> None:
    assert EXAMPLE.diffuse_attenuation[0] == pytest.approx(0.235, abs=0.0005)
    assert compute_secchi_depth(EXAMPLE)[0] == pytest.approx(7.0, abs=0.05)


@pytest.mark.parametrize(
    ("fog", "expected"), [(0.606, 0.5), (0.857, 1.0), (1.050, 1.5), (1.213, 2.0), (1.485, 3.0)]
)
def test_fog_and_beam_attenuation_of_sharp_detail(fog: float, expected: float) -> None:
    """c = fog^2 d0 at 1.36 m, and back."""
    assert find_attenuation_of_fog(fog, DISTANCE) == pytest.approx(expected, rel=2e-3)
    water = water_of(FournierForand(), expected, 0.8)
    assert compute_fog_density(water, DISTANCE)[0] == pytest.approx(fog, rel=1e-3)


@pytest.mark.parametrize(("frequency", "expected"), [(None, 1.65), (10.0, 2.6)])
def test_the_papers_limit_in_physical_units(frequency: float | None, expected: float) -> None:
    """Find c for the contrast of 0.107 at 1.36 m; b/c = 0.85."""
    attenuation = find_attenuation_of_contrast(
        0.107, DISTANCE, albedo=0.85, phase_function=FournierForand(), frequency=frequency
    )
    assert attenuation == pytest.approx(expected, abs=0.05)
    water = water_of(FournierForand(), attenuation, 0.85)
    assert compute_transfer(water, DISTANCE, frequency)[0] == pytest.approx(0.107, rel=1e-9)


def test_an_impossible_contrast_is_rejected() -> None:
    with pytest.raises(BadSetting, match=r"The share of contrast is 1\.2"):
        find_attenuation_of_contrast(1.2, 1.0, albedo=0.5, phase_function=FournierForand())


def test_a_feature_of_2_cm_is_34_cycles_per_radian() -> None:
    assert find_feature_frequency(0.02, DISTANCE) == pytest.approx(34.0)


def test_visual_ranges_are_multiples_of_the_attenuation_length() -> None:
    assert compute_visual_range(EXAMPLE)[0] == pytest.approx(4.8)
    assert compute_visual_range(EXAMPLE, 0.02)[0] == pytest.approx(3.912, abs=1e-3)


def test_water_without_attenuation_has_no_limits() -> None:
    water = Medium(absorption=(0.0,), scattering=(0.0,))
    assert compute_secchi_depth(water)[0] == math.inf
    assert compute_visual_range(water)[0] == math.inf
    assert compute_lamp_range(water, lamp_at(0.3), 0.1)[0] == math.inf


@pytest.mark.parametrize("row", read_rows("lamp"), ids=lambda row: "-".join(list(row.values())[:3]))
def test_the_contrast_in_a_lamps_light_is_that_of_the_tables(row: dict[str, str]) -> None:
    """Allow 0.06, which follows from errors of 10 % in signal and 15 % in veil."""
    c, distance, offset = (float(value) for value in list(row.values())[:3])
    if offset <= distance * math.tan(math.radians(22.0)):
        contrast = compute_lamp_contrast(water_of(PHASES["FF"], c, 0.85), lamp_at(offset), distance)
        assert contrast[0] == pytest.approx(float(row["contrast"]), abs=0.06)


def test_the_own_lamp_range_is_where_the_contrast_falls_below() -> None:
    water = Medium(absorption=(0.15, 0.3), scattering=(0.85, 0.2))
    lamp = Lamp(
        position=(0.3, 0.0, 0.0),
        direction=(0.0, 0.0, 1.0),
        intensity=(1.0, 1.0),
        half_angle=math.radians(30.0),
    )
    ranges = compute_lamp_range(water, lamp, 0.3)
    for channel, distance in enumerate(ranges):
        contrast = compute_lamp_contrast(water, lamp, np.array([distance - 1e-6, distance + 1e-6]))
        assert contrast[0, channel] >= 0.3 >= contrast[1, channel]


def test_a_lamp_that_lights_nothing_has_no_range() -> None:
    lamp = Lamp(
        position=(0.3, 0.0, 0.0),
        direction=(1.0, 0.0, 0.0),
        intensity=(1.0,),
        half_angle=math.radians(30.0),
    )
    assert compute_lamp_range(EXAMPLE, lamp, 0.3)[0] == 0.0


ESTIMATE = WaterEstimate(
    beam_attenuation=1.0, scattering=0.85, covariance=((4e-4, 1e-4), (1e-4, 2.25e-4))
)


def deviation_of(name: str) -> tuple[float, float]:
    """Return value and standard deviation of the quantity whose name begins so."""
    matches = [quantity for quantity in convert_water(ESTIMATE) if quantity.name.startswith(name)]
    assert matches
    return matches[0].value, matches[0].standard_deviation


def test_standard_deviations_are_those_of_the_quoted_formulas() -> None:
    assert deviation_of("beam attenuation") == pytest.approx((1.0, 0.02))
    assert deviation_of("attenuation length") == pytest.approx((1.0, 0.02), rel=1e-6)
    value, deviation = deviation_of("contrast left, sharpest")
    assert deviation / value == pytest.approx(1.36 * 0.02, rel=1e-6)
    value, deviation = deviation_of("UWSim fog density, sharpest")
    assert deviation / value == pytest.approx(0.02 / 2.0, rel=1e-6)


def test_the_deviation_of_contrast_follows_from_absorption_and_scattering() -> None:
    """R sqrt(s_a^2 + ((1 - Q) s_b)^2) of independent a and b, without the wide-angle term."""
    s_a, s_b, frequency = 0.012, 0.015, 10.0
    estimate = WaterEstimate(
        beam_attenuation=1.0,
        scattering=0.85,
        covariance=((s_a**2 + s_b**2, s_b**2), (s_b**2, s_b**2)),
    )
    deviation = propagate_error(
        estimate, lambda water: float(compute_transfer(water, DISTANCE, frequency)[0])
    )
    transform = float(FournierForand().compute_transform(frequency))
    relative_deviation = DISTANCE * math.hypot(s_a, (1.0 - transform) * s_b)
    transfer = float(compute_transfer(EXAMPLE, DISTANCE, frequency)[0])
    assert deviation / transfer == pytest.approx(relative_deviation, rel=0.01)


def test_deviations_agree_with_random_samples() -> None:
    draws = np.random.default_rng(1).normal(size=(200, 2))
    draws -= draws.mean(axis=0)
    draws = draws @ np.linalg.inv(np.linalg.cholesky(np.cov(draws.T)).T)  # covariance exactly 1
    samples = np.array([1.0, 0.85]) + draws @ np.linalg.cholesky(ESTIMATE.covariance).T
    for function in (
        lambda water: float(compute_fog_density(water, DISTANCE, 34.0)[0]),
        lambda water: float(compute_secchi_depth(water)[0]),
        lambda water: float(compute_lamp_range(water, lamp_at(0.3), 0.05)[0]),
    ):
        values = [function(ESTIMATE.make_medium(c, b)) for c, b in samples.tolist()]
        assert np.std(values) == pytest.approx(propagate_error(ESTIMATE, function), rel=0.05)


def test_formulas_of_ten_percent_say_so() -> None:
    for name in ("diffuse attenuation", "Secchi depth"):
        value, deviation = deviation_of(name)
        assert 0.1 * value < deviation < 0.15 * value


def test_every_quantity_of_water_without_error_has_no_deviation_but_that_of_its_formula() -> None:
    quantities = convert_water(
        WaterEstimate(beam_attenuation=0.5, scattering=0.5, phase_function=HenyeyGreenstein(0.9)),
        View(distance=2.0),
    )
    deviations = {quantity.name for quantity in quantities if quantity.standard_deviation > 0.0}
    assert deviations <= {"diffuse attenuation Kd", "Secchi depth"}


def test_an_impossible_covariance_is_rejected() -> None:
    with pytest.raises(BadSetting, match="is no covariance"):
        WaterEstimate(beam_attenuation=1.0, scattering=0.5, covariance=((1e-4, 1e-3), (1e-3, 1e-4)))

"""Direct light, small sources, whole fields, blur and ambient veil against the tables."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.optics.reference_tables import (
    FREQUENCIES,
    PHASES,
    name_of_row,
    read_rows,
    values_of,
    water_of,
    water_of_row,
)
from uwsim.optics import FournierForand, HenyeyGreenstein, Medium, PhaseFunction
from uwsim.optics.transmission import (
    compute_ambient_veil,
    compute_direct,
    compute_full_field,
    compute_led_halo,
    compute_led_signal,
    compute_modulation_transfer,
)

RGB_WATER = Medium(absorption=(0.4, 0.1, 0.05), scattering=(0.3, 0.35, 0.5))
DEPTHS = np.array([0.0, 0.1, 1.0, 3.0, 10.0])


@pytest.mark.parametrize("row", read_rows("full_field"), ids=lambda row: row["optical_depth"])
def test_direct_light_and_whole_fields_are_those_of_the_tables(row: dict[str, str]) -> None:
    depth = float(row["optical_depth"])
    largest_error = 0.006 if depth <= 4.0 else 0.02
    for column, value in list(row.items())[2:]:
        name, albedo = column.split()
        water = water_of(PHASES[name], depth, float(albedo))
        assert compute_direct(water, 1.0)[0] == pytest.approx(float(row["direct"]), abs=6e-6)
        assert compute_full_field(water, 1.0)[0] == pytest.approx(float(value), rel=largest_error)


@pytest.mark.parametrize("row", read_rows("transfer"), ids=name_of_row)
def test_the_modulation_transfer_is_that_of_the_tables(row: dict[str, str]) -> None:
    """Allow 1.1 % to an optical depth of 2, and 2.4 % to 4."""
    largest_error = 0.011 if float(row["optical_depth"]) <= 2.0 else 0.024
    transfer = compute_modulation_transfer(water_of_row(row), FREQUENCIES, 1.0)[:, 0]
    np.testing.assert_allclose(transfer, values_of(row, FREQUENCIES), rtol=largest_error)


@pytest.mark.parametrize("row", read_rows("led"), ids=name_of_row)
def test_the_light_of_a_small_source_is_that_of_the_tables(row: dict[str, str]) -> None:
    angles = (0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0)
    errors = (0.015, 0.035, 0.13) if row["phase"] == "HG" else (0.008, 0.019, 0.046)
    largest_error = errors[sum(float(row["optical_depth"]) > limit for limit in (1.0, 2.0))]
    signal = compute_led_signal(water_of_row(row), 1.0, np.radians(angles))[:, 0]
    np.testing.assert_allclose(signal, values_of(row, angles, "P "), rtol=largest_error)


@pytest.mark.parametrize("row", read_rows("led"), ids=name_of_row)
def test_the_halo_of_a_small_source_is_that_of_the_tables(row: dict[str, str]) -> None:
    angles = (0.5, 1.0, 2.0, 5.0, 10.0)
    depth = float(row["optical_depth"])
    largest_error = 0.08 if depth <= 1.0 else 0.13 if depth <= 2.0 else 0.25
    halo = compute_led_halo(water_of_row(row), 1.0, np.radians(angles))[:, 0]
    np.testing.assert_allclose(halo, values_of(row, angles, "halo "), rtol=largest_error)


def test_the_halo_is_the_derivative_of_the_light_within_an_angle() -> None:
    angles = np.array([0.01, 0.1])
    step = 1e-4 * angles
    low, high = (compute_led_signal(RGB_WATER, 1.5, angles + sign * step) for sign in (-1, 1))
    rings = 2.0 * math.pi * np.sin(angles) * 2.0 * step  # [sr]
    expected = (high - low) / rings[:, None]
    np.testing.assert_allclose(compute_led_halo(RGB_WATER, 1.5, angles), expected, rtol=2e-3)


@pytest.mark.parametrize("distance", [0.0, 0.3, 2.0, 15.0])
@pytest.mark.parametrize("phase", [*PHASES.values(), FournierForand(1.15, 4.0)], ids=str)
def test_a_white_target_in_an_isotropic_field_is_invisible(
    phase: PhaseFunction, distance: float
) -> None:
    """Light of the target and veiling light of equal radiance make that radiance at every range."""
    water = Medium(absorption=(0.4, 0.1, 0.05), scattering=(0.3, 0.35, 0.5), phase_function=phase)
    ambient_radiance = np.array([0.2, 0.7, 1.3])
    radiance = compute_full_field(water, distance) * ambient_radiance + compute_ambient_veil(
        water, ambient_radiance, distance
    )
    np.testing.assert_allclose(radiance, ambient_radiance, rtol=1e-12)


@pytest.mark.parametrize("row", read_rows("full_field"), ids=lambda row: row["optical_depth"])
def test_ambient_pictures_of_uniform_targets_are_those_of_the_reference(
    row: dict[str, str],
) -> None:
    """L / L_a = 1 - h (1 - albedo) / (1 - albedo r), with the diffuse albedo r of the water."""
    largest_error = 0.005 if float(row["optical_depth"]) <= 4.0 else 0.01
    reflectances = {"HG 0.6": 0.0271, "HG 0.85": 0.0911, "FF 0.6": 0.0194, "FF 0.85": 0.0673}
    for column, reflectance in reflectances.items():
        name, albedo = column.split()
        water = water_of(PHASES[name], float(row["optical_depth"]), float(albedo))
        for target in (0.05, 0.5, 0.9):
            source = target * (1.0 - reflectance) / (1.0 - target * reflectance)
            field = float(compute_full_field(water, 1.0)[0])
            radiance = source * field + float(compute_ambient_veil(water, [1.0], 1.0)[0])
            expected = 1.0 - float(row[column]) * (1.0 - target) / (1.0 - target * reflectance)
            assert radiance == pytest.approx(expected, abs=largest_error)


def test_ranges_of_any_shape_are_computed_at_once() -> None:
    ranges = np.array([[0.5, 1.0], [2.0, 4.0]])
    assert compute_direct(RGB_WATER, ranges).shape == (2, 2, 3)
    transfer = compute_modulation_transfer(RGB_WATER, 3.0, ranges)
    assert transfer.shape == (2, 2, 3)
    transfer_of_pixel = compute_modulation_transfer(RGB_WATER, 3.0, 2.0)
    np.testing.assert_array_equal(transfer[1, 0], transfer_of_pixel)


def test_the_limits_of_the_modulation_transfer_are_the_whole_field_and_direct_light() -> None:
    transfer = compute_modulation_transfer(RGB_WATER, np.array([0.0, 1e6]), 1.5)
    np.testing.assert_allclose(transfer[0], compute_full_field(RGB_WATER, 1.5), rtol=1e-12)
    np.testing.assert_allclose(transfer[1], compute_direct(RGB_WATER, 1.5), rtol=1e-3)


def test_water_that_only_absorbs_obeys_beers_law() -> None:
    water = Medium(absorption=(0.3,), scattering=(0.0,), phase_function=HenyeyGreenstein(0.9))
    expected = math.exp(-0.3 * 2.5)
    for value in (
        compute_direct(water, 2.5),
        compute_full_field(water, 2.5),
        compute_led_signal(water, 2.5, 0.1),
        compute_modulation_transfer(water, 3.0, 2.5),
    ):
        assert value[0] == pytest.approx(expected, rel=1e-12)


def test_a_narrow_angle_sees_direct_light_and_a_wide_one_most_of_the_rest() -> None:
    water = Medium(absorption=(0.15,), scattering=(0.85,))
    narrow_signal = compute_led_signal(water, 1.0, 1e-8)
    wide_signal = compute_led_signal(water, 1.0, math.pi)
    assert narrow_signal[0] == pytest.approx(math.exp(-1.0), rel=0.01)
    assert wide_signal[0] == pytest.approx(math.exp(-0.15), rel=1e-6)

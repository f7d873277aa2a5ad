"""The path tracer against the tables, another renderer and the energy of a uniform field."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from scipy.special import j0

from tests.optics.path_tracer import (
    LampScene,
    PhaseTables,
    tabulate,
    trace_ambient_field,
    trace_lamp_signal,
    trace_lamp_veil,
    trace_led,
    trace_spread,
)
from tests.optics.reference_tables import (
    FREQUENCIES,
    PHASES,
    PIXELS,
    PLACES,
    RADII,
    FloatArray,
    name_of_row,
    read_rows,
    values_of,
)

N_PATHS = 100_000
N_SIGMAS = 4.5
"""The standard errors that are allowed; about 1500 numbers are compared."""
LED_ANGLES = (0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 30.0, 90.0)


@cache
def tables_of(phase: str) -> PhaseTables:
    return tabulate(PHASES[phase])


@cache
def spread_of(phase: str, albedo: float, depth: float) -> tuple[FloatArray, FloatArray]:
    return trace_spread(tables_of(phase), depth, albedo, N_PATHS, seed=1)


def spread_of_row(row: dict[str, str]) -> tuple[FloatArray, FloatArray]:
    return spread_of(row["phase"], float(row["albedo"]), float(row["optical_depth"]))


def assert_near(
    scores: FloatArray, direct_light: FloatArray | float, expected: FloatArray, table_error: float
) -> None:
    """Compare the means of scores (n_paths, m), plus direct light, with a table."""
    values = scores.mean(axis=0) + direct_light
    errors = np.hypot(scores.std(axis=0) / math.sqrt(N_PATHS), table_error * expected)
    assert (np.abs(values - expected) <= N_SIGMAS * errors + 6e-5).all()


@pytest.mark.parametrize("row", read_rows("full_field"), ids=lambda row: row["optical_depth"])
def test_whole_fields_are_those_of_the_tables(row: dict[str, str]) -> None:
    depth = float(row["optical_depth"])
    for column, value in list(row.items())[2:]:
        phase, albedo = column.split()
        weights, _ = spread_of(phase, float(albedo), depth)
        assert_near(weights[:, None], math.exp(-depth), np.array([float(value)]), 4e-4)


@pytest.mark.parametrize("row", read_rows("spread"), ids=name_of_row)
def test_the_spread_of_a_beam_is_that_of_the_tables(row: dict[str, str]) -> None:
    weights, radii = spread_of_row(row)
    scores = weights[:, None] * (radii[:, None] <= np.array(RADII))
    assert_near(scores, math.exp(-float(row["optical_depth"])), values_of(row, RADII), 1e-3)


@pytest.mark.parametrize("row", read_rows("transfer"), ids=name_of_row)
def test_the_modulation_transfer_is_that_of_the_tables(row: dict[str, str]) -> None:
    weights, radii = spread_of_row(row)
    scores = weights[:, None] * j0(2.0 * math.pi * radii[:, None] * np.array(FREQUENCIES))
    expected = values_of(row, FREQUENCIES)
    assert_near(scores, math.exp(-float(row["optical_depth"])), expected, 3e-3)


@pytest.mark.parametrize("row", read_rows("edge"), ids=name_of_row)
def test_an_edge_is_that_of_the_tables(row: dict[str, str]) -> None:
    """Use the known probability that a point of a path's ring is on the white half plane."""
    weights, radii = spread_of_row(row)
    places = np.array(PLACES)
    ratio = np.clip(places / np.maximum(radii[:, None], 1e-12), -1.0, 1.0)
    scores = weights[:, None] * (1.0 - np.arccos(ratio) / math.pi)
    direct_light = np.where(places > 0.0, math.exp(-float(row["optical_depth"])), 0.0)
    assert_near(scores, direct_light, values_of(row, PLACES), 3e-3)


@pytest.mark.parametrize("row", read_rows("led"), ids=name_of_row)
def test_the_light_of_a_source_is_that_of_the_tables(row: dict[str, str]) -> None:
    estimate = trace_led(
        tables_of(row["phase"]),
        float(row["optical_depth"]),
        float(row["albedo"]),
        np.radians(LED_ANGLES),
        n_paths=10_000,
        seed=2,
    )
    expected = values_of(row, LED_ANGLES, "P ")
    errors = np.hypot(estimate.error, 1e-3 * expected)
    assert (np.abs(estimate.value - expected) <= N_SIGMAS * errors + 6e-5).all()


@pytest.mark.parametrize("row", read_rows("lamp"), ids=lambda row: "-".join(list(row.values())[:3]))
def test_the_signal_of_a_lamp_is_that_of_the_tables(row: dict[str, str]) -> None:
    """Allow for the second reflection in the tables, 4 % at most."""
    c, distance, offset = (float(value) for value in list(row.values())[:3])
    if offset < distance * math.tan(math.radians(29.0)):
        scene = LampScene(c, 0.85, distance, offset)
        estimate = trace_lamp_signal(tables_of("FF"), scene, n_paths=20_000, seed=3)
        ratio, error = (part / float(row["signal"]) for part in (estimate.value, estimate.error))
        tolerance = N_SIGMAS * math.hypot(float(error), 0.005)
        assert 0.96 - tolerance <= ratio <= 1.0 + tolerance


@pytest.mark.slow
@pytest.mark.parametrize("row", read_rows("lamp"), ids=lambda row: "-".join(list(row.values())[:3]))
def test_the_veil_of_a_lamp_is_that_of_the_tables(row: dict[str, str]) -> None:
    """Use the error of each row, the largest of its five pixels."""
    c, distance, offset = (float(value) for value in list(row.values())[:3])
    table_error = float(row["error_percent"]) / 100.0
    for pixel in PIXELS:
        scene = LampScene(c, 0.85, distance, offset, pixel)
        estimate = trace_lamp_veil(tables_of("FF"), scene, n_paths=10_000, seed=4)
        expected = float(row[f"{pixel:g}"])
        error = math.hypot(float(estimate.error), table_error * expected)
        assert abs(float(estimate.value) - expected) <= N_SIGMAS * error


@pytest.mark.parametrize(
    ("c", "albedo", "distance", "offset", "veil", "error"),
    [
        (0.5, 0.85, 1.0, 0.3, 6.96e-4, 0.15e-4),
        (1.0, 0.85, 1.36, 0.1, 7.53e-3, 0.085e-3),
        (2.0, 0.60, 1.0, 0.1, 6.44e-3, 0.08e-3),
    ],
)
def test_the_veil_is_that_of_mitsuba(
    c: float, albedo: float, distance: float, offset: float, veil: float, error: float
) -> None:
    """Centre pixels of Mitsuba 3.9 (scalar volpath, Henyey and Greenstein 0.9, black plane)."""
    scene = LampScene(c, albedo, distance, offset)
    estimate = trace_lamp_veil(tables_of("HG"), scene, n_paths=40_000, seed=5)
    assert abs(estimate.value - veil) <= 3.0 * math.hypot(float(estimate.error), error)


@pytest.mark.parametrize(
    ("c", "distance", "offset", "radiance", "error"),
    [(0.5, 1.0, 0.3, 0.2187, 0.0026), (1.0, 1.36, 0.1, 0.0981, 0.0012)],
)
def test_a_white_plane_in_the_light_of_a_lamp_is_that_of_mitsuba(
    c: float, distance: float, offset: float, radiance: float, error: float
) -> None:
    """Allow for more reflections in the picture, up to 4 %."""
    scene = LampScene(c, 0.85, distance, offset)
    signal = trace_lamp_signal(tables_of("HG"), scene, n_paths=100_000, seed=6)
    veil = trace_lamp_veil(tables_of("HG"), scene, n_paths=20_000, seed=7)
    value = float(signal.value + veil.value)
    assert value <= radiance + 3.0 * error
    assert value >= 0.96 * radiance - 3.0 * error


@pytest.mark.parametrize("depth", [0.3, 1.0, 3.0])
@pytest.mark.parametrize("phase", ["HG", "FF"])
def test_a_white_plane_in_a_uniform_field_is_invisible(phase: str, depth: float) -> None:
    estimate = trace_ambient_field(tables_of(phase), depth, 0.85, 1.0, 2000, seed=8)
    assert estimate.value == pytest.approx(1.0, abs=0.005)


@pytest.mark.parametrize("depth", [0.4, 1.36])
@pytest.mark.parametrize("target_albedo", [0.05, 0.5, 0.9])
def test_uniform_planes_in_a_uniform_field_are_those_of_the_reference(
    depth: float, target_albedo: float
) -> None:
    """L = 1 - h (1 - albedo) / (1 - albedo r), with r = 0.0673 for FF and b/c = 0.85."""
    expected = {
        (0.4, 0.05): 0.1086, (0.4, 0.5): 0.5161, (0.4, 0.9): 0.9004,
        (1.36, 0.05): 0.2477, (1.36, 0.5): 0.5916, (1.36, 0.9): 0.9160,
    }  # fmt: skip
    estimate = trace_ambient_field(tables_of("FF"), depth, 0.85, target_albedo, 20_000, seed=9)
    tolerance = N_SIGMAS * float(estimate.error) + 1e-4
    assert abs(estimate.value - expected[depth, target_albedo]) <= tolerance


def test_the_same_seed_gives_the_same_paths() -> None:
    scene = LampScene(1.0, 0.85, 1.0, 0.1)
    first, second = (trace_lamp_veil(tables_of("FF"), scene, 1000, seed=1) for _ in range(2))
    assert first.value == second.value

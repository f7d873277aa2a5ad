"""The formulas against the path tracer, in waters and places that are in no table.

The phase functions of `HELD_OUT` entered no fit. Optical depths, albedos, frequencies and lamps
differ from those of the tables.
"""

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
    trace_lamp_signal,
    trace_lamp_veil,
    trace_led,
    trace_spread,
)
from tests.optics.reference_tables import FloatArray, water_of
from uwsim.optics import FournierForand, HenyeyGreenstein, PhaseFunction
from uwsim.optics.lamp_light import (
    Lamp,
    compute_lamp_veil,
    compute_target_radiance,
)
from uwsim.optics.transmission import (
    compute_direct,
    compute_full_field,
    compute_led_signal,
    compute_modulation_transfer,
)

HELD_OUT = [HenyeyGreenstein(0.93), FournierForand(1.07, 3.7), FournierForand(1.18, 3.75)]
PHASES = [*HELD_OUT, HenyeyGreenstein(0.95), FournierForand(1.15, 4.0), FournierForand()]
WATERS = [(0.7, 0.35), (0.92, 1.2), (0.75, 3.1), (0.92, 3.8)]
"""The albedos and optical depths."""
FREQUENCIES = np.array([0.4, 2.0, 6.0, 20.0, 60.0])
HALF_ANGLES = np.radians([0.3, 0.7, 1.5, 4.0, 8.0])
N_PATHS = 100_000
N_SIGMAS = 4.0

CASES = [(phase, albedo, depth) for phase in PHASES for albedo, depth in WATERS]
LAMPS = [
    LampScene(0.35, 0.70, 1.7, 0.20, 0.10, math.radians(30.0)),
    LampScene(0.80, 0.92, 1.2, 0.25, 0.00, math.radians(40.0)),
    LampScene(0.80, 0.75, 2.2, 0.15, -0.05, math.radians(25.0)),
    LampScene(0.15, 0.90, 3.0, 0.40, 0.00, math.radians(45.0)),
    LampScene(1.50, 0.75, 0.8, 0.15, 0.00, math.radians(30.0)),
]


@cache
def tables_of(phase: PhaseFunction) -> PhaseTables:
    return tabulate(phase)


@cache
def spread_of(phase: PhaseFunction, albedo: float, depth: float) -> tuple[FloatArray, FloatArray]:
    return trace_spread(tables_of(phase), depth, albedo, N_PATHS, seed=21)


def summarise(scores: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the means of scores (n_paths, m), and the errors that are allowed for chance."""
    return scores.mean(axis=0), N_SIGMAS * scores.std(axis=0) / math.sqrt(N_PATHS)


def name_case(value: object) -> str:
    return str(value)


@pytest.mark.parametrize(("phase", "albedo", "depth"), CASES, ids=name_case)
def test_direct_light_is_within_1_percent(
    phase: PhaseFunction, albedo: float, depth: float
) -> None:
    """Compare with the limit of the tracer's fine detail."""
    assert compute_direct(water_of(phase, depth / 2.0, albedo), 2.0)[0] == pytest.approx(
        math.exp(-depth), rel=1e-12
    )


@pytest.mark.parametrize(("phase", "albedo", "depth"), CASES, ids=name_case)
def test_the_whole_field_is_within_2_percent(
    phase: PhaseFunction, albedo: float, depth: float
) -> None:
    weights, _ = spread_of(phase, albedo, depth)
    mean, chance = summarise(weights[:, None])
    expected = math.exp(-depth) + mean[0]
    field = compute_full_field(water_of(phase, depth / 1.7, albedo), 1.7)[0]
    assert abs(field - expected) <= 0.02 * expected + chance[0]


@pytest.mark.parametrize(("phase", "albedo", "depth"), CASES, ids=name_case)
def test_the_modulation_transfer_is_within_3_percent(
    phase: PhaseFunction, albedo: float, depth: float
) -> None:
    weights, radii = spread_of(phase, albedo, depth)
    means, chance = summarise(weights[:, None] * j0(2.0 * math.pi * radii[:, None] * FREQUENCIES))
    expected = math.exp(-depth) + means
    transfer = compute_modulation_transfer(water_of(phase, depth, albedo), FREQUENCIES, 1.0)[:, 0]
    assert (np.abs(transfer - expected) <= 0.03 * expected + chance).all()


@pytest.mark.parametrize(("phase", "albedo", "depth"), CASES[::2] + CASES[1::4], ids=name_case)
def test_the_light_of_a_small_source_is_as_good_as_stated(
    phase: PhaseFunction, albedo: float, depth: float
) -> None:
    """1.5 % to an optical depth of 1, 3.5 % to 2, 13 % to 4."""
    largest_error = 0.015 if depth <= 1.0 else 0.035 if depth <= 2.0 else 0.13
    estimate = trace_led(tables_of(phase), depth, albedo, HALF_ANGLES, n_paths=20_000, seed=22)
    signal = compute_led_signal(water_of(phase, depth, albedo), 1.0, HALF_ANGLES)[:, 0]
    tolerance = largest_error * estimate.value + N_SIGMAS * estimate.error
    assert (np.abs(signal - estimate.value) <= tolerance).all()


def lamp_of(scene: LampScene) -> Lamp:
    return Lamp(
        position=(scene.offset, 0.0, 0.0),
        direction=(0.0, 0.0, 1.0),
        intensity=(1.0,),
        half_angle=scene.half_angle,
    )


@pytest.mark.parametrize("phase", PHASES, ids=name_case)
@pytest.mark.parametrize("scene", LAMPS, ids=name_case)
def test_the_signal_of_a_lamp_is_within_10_percent(phase: PhaseFunction, scene: LampScene) -> None:
    estimate = trace_lamp_signal(tables_of(phase), scene, n_paths=20_000, seed=23)
    point = scene.ray * scene.distance / scene.ray[2]
    signal = compute_target_radiance(
        water_of(phase, scene.beam_attenuation, scene.albedo),
        lamp_of(scene),
        point,
        np.array([0.0, 0.0, -1.0]),
        (0.0, 0.0, 0.0),
    )
    tolerance = 0.1 * estimate.value + N_SIGMAS * estimate.error
    assert abs(signal[0] - estimate.value) <= tolerance


@pytest.mark.parametrize("phase", PHASES, ids=name_case)
@pytest.mark.parametrize("scene", LAMPS, ids=name_case)
def test_the_veil_of_a_lamp_is_within_15_percent(phase: PhaseFunction, scene: LampScene) -> None:
    """Allow 20 % for the phase function of minerals, whose bb/b is 0.078."""
    estimate = trace_lamp_veil(tables_of(phase), scene, n_paths=20_000, seed=24)
    veil = compute_lamp_veil(
        water_of(phase, scene.beam_attenuation, scene.albedo),
        lamp_of(scene),
        (0.0, 0.0, 0.0),
        scene.ray,
        scene.distance / scene.ray[2],
    )
    largest_error = 0.15 if phase.backscatter_ratio < 0.05 else 0.2
    tolerance = largest_error * estimate.value + N_SIGMAS * estimate.error
    assert abs(veil[0] - estimate.value) <= tolerance

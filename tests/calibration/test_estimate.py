"""The fit finds the water of signals that the path tracer computed, with the noise of a camera."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
import pytest

from tests.calibration.traced_signals import (
    BLACK,
    HALF_ANGLES,
    LAMP_HALF_ANGLE,
    LAMP_OFFSET,
    SIDES,
    WHITE,
    Water,
    trace_board_signals,
    trace_led_signals,
)
from uwsim.calibration import (
    Accuracy,
    BoardReading,
    LedReading,
    Reading,
    WaterNumbers,
    estimate_water,
)
from uwsim.calibration.forward_model import ForwardModel
from uwsim.calibration.readings import average_geometry
from uwsim.errors import BadSetting
from uwsim.optics import FournierForand, HenyeyGreenstein, PhaseFunction

PHASES: dict[str, PhaseFunction] = {"FF": FournierForand(), "HG": HenyeyGreenstein(0.9)}
ALBEDO = 0.85
CLEAR = (0.06, 0.02)
"""The beam attenuation and scattering of the reference water [1/m]."""
N_PATHS = 60_000
N_SEEDS = 20


@dataclass(frozen=True)
class Noise:
    """The errors of a trial: the error budget of the reference."""

    full_well: float = 10_000.0
    read_noise: float = 3.0
    n_frames: int = 16
    black_error: float = 0.1
    drift: float = 0.01
    distance: float = 0.005
    reference: float = 0.01


def limit_of_c(c: float) -> float:
    return max(0.03, 0.04 * c)


def limit_of_b(b: float) -> float:
    return max(0.03, 0.05 * b)


@cache
def trace(name: str, c: float, distance: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
    water = Water(PHASES[name], c, CLEAR[1] if c == CLEAR[0] else ALBEDO * c)
    return (
        trace_led_signals(water, distance, N_PATHS, 1),
        trace_board_signals(water, distance, N_PATHS, 2),
    )


def geometry_of(side: float, distance: float) -> tuple[float, float, float]:
    places = [(x * side / 2.0, y * side / 2.0, distance) for x in (-1, 1) for y in (-1, 1)]
    return average_geometry(np.array(places), (LAMP_OFFSET, 0.0, 0.0))


def make_readings(
    led: Sequence[float],
    board: Sequence[float],
    clear_led: Sequence[float] | None,
    clear_board: Sequence[float] | None,
    distance: float = 1.0,
) -> list[Reading]:
    leds = [
        LedReading(
            channel="red",
            source="led",
            distance=distance,
            half_angle=float(half_angle),
            signal=float(signal),
            reference=None if clear_led is None else float(clear_led[k]),
        )
        for k, (half_angle, signal) in enumerate(zip(HALF_ANGLES, led, strict=True))
    ]
    boards = [
        BoardReading(
            channel="red",
            source="board",
            distance=distance,
            side=side,
            lamp_distance=geometry_of(side, distance)[1],
            lamp_half_angle=LAMP_HALF_ANGLE,
            incidence=geometry_of(side, distance)[2],
            signal=float(signal),
            reference=None if clear_board is None else float(clear_board[k]),
        )
        for k, (side, signal) in enumerate(zip(SIDES, board, strict=True))
    ]
    return [*leds, *boards]


def add_noise(
    signals: np.ndarray,
    electrons: np.ndarray,
    n_pixels: np.ndarray,
    noise: Noise,
    generator: np.random.Generator,
) -> tuple[np.ndarray, np.ndarray]:
    """Return signals with noise, and the relative standard deviation that a camera can know.

    Args:
        signals: the signals, sums over pixels.
        electrons: the electrons of each signal in a frame.
        n_pixels: the number of pixels that each sum has.
        noise: the errors.
        generator: the source of noise.
    """
    variances = (electrons + n_pixels * noise.read_noise**2) / noise.n_frames
    black_errors = noise.black_error * n_pixels
    drift = 1.0 + noise.drift * generator.standard_normal()
    changes = np.sqrt(variances) * generator.standard_normal(len(signals))
    changes = changes + black_errors * generator.standard_normal()
    deviations = np.hypot(np.sqrt(variances), black_errors) / electrons
    return drift * signals * (1.0 + changes / electrons), deviations


def make_noisy_readings(name: str, c: float, seed: int) -> tuple[list[Reading], WaterNumbers]:
    """Make readings with noise, and a reference water whose numbers are wrong by their error."""
    generator, noise = np.random.default_rng(seed), Noise()
    clear_signals, signals = trace(name, CLEAR[0]), trace(name, c)
    # A pixel is 1 mrad. In clear water the narrowest disc has 20 full wells; the discs from 1
    # degree have 16 times the exposure. The white squares have 0.9 of a full well.
    n_pixels = (math.pi * (np.tan(HALF_ANGLES) * 1000.0) ** 2, 2.0 * (np.array(SIDES) * 500.0) ** 2)
    exposures = (np.where(math.radians(0.6) > HALF_ANGLES, 1.0, 16.0), np.ones(3))
    scales = (
        20.0 * noise.full_well / clear_signals[0][0] * exposures[0],
        0.9 * noise.full_well * n_pixels[1] / clear_signals[1][0],
    )
    noisy_signals, deviations = [], []
    for kind in (0, 1):
        for traced in (signals, clear_signals):
            values, errors = add_noise(
                traced[kind], traced[kind] * scales[kind], n_pixels[kind], noise, generator
            )
            noisy_signals.append(values)
            deviations.append(errors)
    led, clear_led, board, clear_board = noisy_signals
    noises = np.append(
        np.hypot(deviations[0], deviations[1]), np.hypot(deviations[2], deviations[3])
    )
    wrong_distance = 1.0 + noise.distance * generator.standard_normal()
    readings = [
        replace(reading, distance=reading.distance * wrong_distance, noise=float(deviation))
        for reading, deviation in zip(
            make_readings(led, board, clear_led, clear_board), noises, strict=True
        )
    ]
    wrong_absorption = CLEAR[0] - CLEAR[1] + noise.reference * generator.standard_normal()
    return readings, WaterNumbers(max(wrong_absorption, 0.0), CLEAR[1], 1.0)


@pytest.mark.slow
@pytest.mark.parametrize("name", PHASES)
@pytest.mark.parametrize("c", [0.25, 1.0, 2.0])
def test_the_mean_of_twenty_noisy_calibrations_is_the_water(name: str, c: float) -> None:
    estimates = [estimate_water(*make_noisy_readings(name, c, seed)) for seed in range(N_SEEDS)]
    mean_c = np.mean([estimate.water.beam_attenuation for estimate in estimates])
    mean_b = np.mean([estimate.water.scattering for estimate in estimates])
    assert mean_c == pytest.approx(c, abs=limit_of_c(c))
    assert mean_b == pytest.approx(ALBEDO * c, abs=limit_of_b(ALBEDO * c))
    # Almost every interval of 95 % contains the truth.
    n_inside = sum(
        abs(e.water.beam_attenuation - c) <= 1.96 * e.standard_deviations["beam_attenuation"]
        for e in estimates
    )
    assert n_inside >= 17
    assert all(estimate.reduced_chi_squared < 3.0 for estimate in estimates)


@pytest.mark.slow
@pytest.mark.parametrize("name", PHASES)
@pytest.mark.parametrize("c", [0.25, 1.0, 2.0])
def test_the_naive_reading_of_the_board_is_outside_of_the_limits(name: str, c: float) -> None:
    """It takes c = -ln(S / S_ref) / (2 R), as if all scattered light were lost."""
    (_, board), (_, clear_board) = trace(name, c), trace(name, CLEAR[0])
    length = 1.0 + math.hypot(1.0, LAMP_OFFSET)
    naive_attenuation = -math.log(board[0] / clear_board[0]) / length + CLEAR[0]
    assert abs(naive_attenuation - c) > limit_of_c(c)


@pytest.mark.slow
@pytest.mark.parametrize("c", [0.25, 1.0, 2.0])
def test_the_naive_reading_of_an_led_is_too_low(c: float) -> None:
    """The narrowest disc keeps a fifth of the light that sea water scatters."""
    readings, reference = make_noisy_readings("FF", c, 0)
    estimate = estimate_water(readings, reference)
    assert c - estimate.naive_attenuation > limit_of_c(c)


@pytest.mark.slow
@pytest.mark.parametrize("name", PHASES)
@pytest.mark.parametrize("c", [0.5, 1.0, 2.0])
def test_a_board_at_four_ranges_needs_no_reference_water(name: str, c: float) -> None:
    readings = []
    for distance in (0.5, 0.75, 1.0, 1.5):
        _, board = trace(name, c, distance)
        readings += make_readings([1.0] * 6, board, None, None, distance)[6:]
    estimate = estimate_water(readings, WaterNumbers(0.04, 0.02, 1.0))
    assert estimate.water.beam_attenuation == pytest.approx(c, abs=limit_of_c(c))
    assert estimate.gains["board"] == pytest.approx((WHITE - BLACK) / math.pi, rel=0.05)


def make_exact_readings(water: WaterNumbers, reference: WaterNumbers) -> list[Reading]:
    """Make readings with the forward model itself."""
    readings = make_readings([1.0] * 6, [1.0] * 3, [1.0] * 6, [1.0] * 3)
    model = ForwardModel.from_readings(readings)
    same_shape = WaterNumbers(reference.absorption, reference.scattering, water.shape)
    losses = model.compute_losses(water) - model.compute_losses(same_shape)
    return [
        replace(reading, signal=math.exp(-loss))
        for reading, loss in zip(readings, losses, strict=True)
    ]


@pytest.mark.parametrize("shape", [0.2, 0.7, 1.0])
def test_exact_signals_give_the_water_up_to_the_prior(shape: float) -> None:
    water, reference = WaterNumbers(0.15, 0.85, shape), WaterNumbers(0.04, 0.02, 1.0)
    estimate = estimate_water(make_exact_readings(water, reference), reference)
    assert estimate.water.absorption == pytest.approx(0.15, abs=0.004)
    assert estimate.water.scattering == pytest.approx(0.85, abs=0.01)
    assert estimate.water.shape == pytest.approx(shape, abs=0.06)
    assert estimate.degrees_of_freedom == 7


def test_stray_light_gives_a_large_chi_squared() -> None:
    water, reference = WaterNumbers(0.15, 0.85, 0.7), WaterNumbers(0.04, 0.02, 1.0)
    readings = make_exact_readings(water, reference)
    readings[2] = replace(readings[2], signal=readings[2].signal * 1.3)
    assert estimate_water(readings, reference).reduced_chi_squared > 3.0


def test_a_worse_reference_and_worse_ranges_widen_the_interval() -> None:
    water, reference = WaterNumbers(0.15, 0.85, 0.7), WaterNumbers(0.04, 0.02, 1.0)
    readings = make_exact_readings(water, reference)
    deviations = [
        estimate_water(readings, reference, accuracy).standard_deviations["beam_attenuation"]
        for accuracy in (Accuracy(), Accuracy(reference=0.05), Accuracy(distance=0.02))
    ]
    assert deviations[1] > 1.5 * deviations[0]
    assert deviations[2] > 1.2 * deviations[0]


@pytest.mark.parametrize(
    ("readings", "message"),
    [
        (make_readings([1.0] * 6, [1.0] * 3, None, None)[:2], "has 2 readings"),
        (make_readings([1.0] * 6, [1.0] * 3, None, None), "no reference water"),
        (make_readings([0.0] * 6, [1.0] * 3, [1.0] * 6, [1.0] * 3), "not positive"),
        ([], "no reading"),
    ],
)
def test_readings_that_do_not_determine_a_water_are_refused(
    readings: list[Reading], message: str
) -> None:
    with pytest.raises(BadSetting, match=message):
        estimate_water(readings, WaterNumbers(0.04, 0.02, 1.0))


@pytest.mark.filterwarnings("error")
def test_leds_at_one_range_start_a_fit_without_a_line_through_them() -> None:
    """A board at three ranges is sufficient: the LEDs beside it have one range."""
    leds = [
        LedReading(
            channel="red", source="led", distance=1.0, half_angle=half_angle, signal=1.0,
            reference=None, noise=0.003,
        )
        for half_angle in HALF_ANGLES
    ]  # fmt: skip
    boards = [
        BoardReading(
            channel="red", source="board", distance=distance, side=0.15, signal=1.0,
            reference=None, noise=0.003, lamp_distance=distance, lamp_half_angle=LAMP_HALF_ANGLE,
            incidence=1.0,
        )
        for distance in (0.5, 1.0, 1.5, 2.0)
    ]  # fmt: skip
    readings: list[Reading] = [*leds, *boards]
    truth = WaterNumbers(0.3, 0.7, 0.7)
    losses = ForwardModel.from_readings(readings).compute_losses(truth)
    exact_readings = [
        replace(reading, signal=reading.geometry * math.exp(-loss))
        for reading, loss in zip(readings, losses, strict=True)
    ]
    estimate = estimate_water(exact_readings, WaterNumbers(0.05, 0.01, 0.7), Accuracy())
    assert estimate.water.beam_attenuation == pytest.approx(1.0, abs=0.05)

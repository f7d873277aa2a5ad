"""Quantities with intervals, backscatter, quality gates and water files of a calibration."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.calibration.test_estimate import make_exact_readings
from uwsim.calibration import Accuracy, Measurements, WaterNumbers, WaterReadings, calibrate
from uwsim.calibration.forward_model import ForwardModel, make_phase_function
from uwsim.calibration.measurements import OpenWaterReading
from uwsim.calibration.quantities import View
from uwsim.calibration.readings import BoardReading
from uwsim.errors import BadSetting, SeveralErrors
from uwsim.optics import Lamp, Medium, compute_lamp_veil, compute_modulation_transfer

REFERENCE = WaterNumbers(0.04, 0.02, 1.0)
WATER = WaterNumbers(0.15, 0.85, 0.7)
LAMP_POSITION = (0.15, 0.0, 0.0)


def make_water(name: str, water: WaterNumbers, **fields: object) -> WaterReadings:
    readings = tuple(make_exact_readings(water, REFERENCE))
    return replace(WaterReadings(name=name, readings=readings), **fields)


def make_measurements(*waters: WaterReadings) -> Measurements:
    return Measurements(references={"red": REFERENCE}, waters=waters, accuracy=Accuracy())


def test_quantities_are_those_of_the_water_within_their_intervals() -> None:
    calibration = calibrate(make_measurements(make_water("tank", WATER)), View(distance=2.0))
    [channel] = calibration.waters[0].channels
    quantities = {quantity.name: quantity for quantity in channel.quantities}
    medium = Medium(absorption=(0.15,), scattering=(0.85,), phase_function=make_phase_function(0.7))
    transfer = compute_modulation_transfer(medium, 10.0, 2.0)[0]
    for name, value in (
        ("beam attenuation c", 1.0),
        ("attenuation length 1/c", 1.0),
        ("contrast of 10 cycles/rad at 2 m", transfer),
        ("UWSim fog, sharpest detail at 2 m", math.sqrt(1.0 / 2.0)),
        ("diffuse attenuation Kd", math.sqrt(0.15**2 + 0.256 * 0.15 * 0.85)),
        ("visual range of a black target", 4.8),
    ):
        assert quantities[name].value == pytest.approx(value, rel=0.02), name
        assert quantities[name].low < value < quantities[name].high, name
    half_width = 0.5 * (
        quantities["beam attenuation c"].high - quantities["beam attenuation c"].low
    )
    deviation = channel.estimate.standard_deviations["beam_attenuation"]
    assert half_width == pytest.approx(1.96 * deviation, rel=0.1)


def test_the_same_seed_gives_the_same_intervals() -> None:
    measurements = make_measurements(make_water("tank", WATER))
    first, second, other = (calibrate(measurements, seed=seed) for seed in (1, 1, 2))
    quantities = [c.waters[0].channels[0].quantities for c in (first, second, other)]
    assert quantities[0] == quantities[1]
    assert quantities[0] != quantities[2]


def test_the_veil_of_open_water_gives_the_backscatter() -> None:
    """A water that scatters 1.3 times the fitted phase function backwards."""
    phase = make_phase_function(0.7)
    medium = Medium(absorption=(0.15,), scattering=(0.85,), phase_function=phase)
    lamp = Lamp(
        position=LAMP_POSITION, direction=(0.0, 0.0, 1.0), intensity=(1.0,),
        half_angle=math.radians(30.0),
    )  # fmt: skip
    axis = np.array([0.0, 0.0, 1.0])
    veil = 1.3 * float(compute_lamp_veil(medium, lamp, (0.0, 0.0, 0.0), axis, math.inf)[0])
    water = make_water("tank", WATER)
    board = max(
        (r for r in water.readings if isinstance(r, BoardReading)), key=lambda entry: entry.side
    )
    clear = WaterNumbers(REFERENCE.absorption, REFERENCE.scattering, 0.7)
    loss = float(ForwardModel.from_readings([board]).compute_losses(clear)[0])
    reading = OpenWaterReading(
        channel="red",
        ratio=veil * math.pi * math.exp(loss),
        lamp_position=LAMP_POSITION,
        lamp_half_angle=math.radians(30.0),
    )
    calibration = calibrate(make_measurements(replace(water, open_water=(reading,))))
    backscatter = calibration.waters[0].channels[0].backscatter
    assert backscatter is not None
    expected = 1.3 * 0.85 * float(phase.compute_density(math.radians(170.0)))
    assert backscatter.value == pytest.approx(expected, rel=0.03)


def verdicts(*waters: WaterReadings) -> dict[str, list[bool | None]]:
    gates: dict[str, list[bool | None]] = {}
    for gate in calibrate(make_measurements(*waters)).gates:
        gates.setdefault(gate.name, []).append(gate.is_passed)
    return gates


def test_doubled_dye_that_follows_beers_law_passes_and_settled_dye_does_not() -> None:
    single = make_water("one", WaterNumbers(0.09, 0.42, 0.7), dose=1.0)
    double = make_water("two", WaterNumbers(0.14, 0.82, 0.7), dose=2.0)
    settled = make_water("settled", WaterNumbers(0.14, 0.70, 0.7), dose=2.0)
    assert verdicts(single, double)["dilution"] == [True, True]
    gates = verdicts(single, double, settled)
    assert gates["repeat"] == [False]
    assert False in gates["dilution"]
    assert verdicts(single)["repeat"] == [None]


def test_stray_light_and_an_extreme_range_fail_their_gates() -> None:
    water = make_water("tank", WATER)
    readings = [replace(reading) for reading in water.readings]
    readings[2] = replace(readings[2], signal=readings[2].signal * 1.4)
    assert verdicts(replace(water, readings=tuple(readings)))["fit"] == [False]
    assert verdicts(make_water("clear", WaterNumbers(0.05, 0.06, 0.7)))["range"] == [False]


def test_the_water_file_has_the_coefficients_and_their_deviations() -> None:
    calibration = calibrate(make_measurements(make_water("tank", WATER)))
    file = calibration.waters[0].make_water_file("a test")
    assert file.medium.n_channels == 3
    assert file.medium.scattering == (pytest.approx(0.85, abs=0.01),) * 3
    assert len(file.uncertainties["beam_attenuation"]) == 3


def test_all_waters_without_usable_readings_are_reported_at_once() -> None:
    empty = WaterReadings(name="empty")
    few = replace(make_water("few", WATER), readings=make_water("few", WATER).readings[:2])
    with pytest.raises(SeveralErrors) as error:
        calibrate(make_measurements(empty, few))
    assert "'empty' has no reading" in str(error.value)
    assert "Water 'few': Channel 'red' has 2 readings" in str(error.value)
    with pytest.raises(BadSetting):
        calibrate(make_measurements(empty))

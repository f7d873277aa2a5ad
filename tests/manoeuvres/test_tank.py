"""The towing tank: what it measures is what the hydrodynamics file says."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

from uwsim.assets.bundled import bundled_files
from uwsim.manoeuvres.experiment import Experiment, make_experiment, trim_vehicle
from uwsim.manoeuvres.rail import Rail
from uwsim.manoeuvres.tank import COMMANDS, pull_bollard, release, tow
from uwsim.scene.reader import read_scene


@cache
def experiment(name: str) -> Experiment:
    return make_experiment(read_scene(bundled_files("scenes")[name]))


@pytest.mark.parametrize(
    ("axis", "linear", "quadratic", "mass"),
    [
        (0, 13.7, 141.0, 13.5 + 6.36),
        (1, 0.0, 217.0, 13.5 + 7.12),
        (2, 33.0, 190.0, 13.5 + 18.68),
        (5, 0.0, 1.5, 0.37 + 0.222),
    ],
)
def test_tow_and_coast_down_find_drag_and_added_mass_of_the_bluerov2(
    axis: int, linear: float, quadratic: float, mass: float
) -> None:
    result = tow(experiment("bluerov2-scene"), axis)
    assert result.resistance.linear == pytest.approx(linear, rel=1e-3, abs=1e-3)
    assert result.resistance.quadratic == pytest.approx(quadratic, rel=1e-3)
    assert result.mass == pytest.approx(mass, rel=2e-3)


def test_a_tow_of_the_remus_measures_its_fins_as_plates_across_the_flow() -> None:
    """Two rudders of 66.5 cm2 add 1.2 rho S / 2 each to the 1310 kg/m of the hull."""
    result = tow(experiment("remus-scene"), 1)
    plates = 2.0 * 0.5 * 1030.0 * 0.00665 * 1.2
    assert result.resistance.quadratic == pytest.approx(1310.0 + plates, rel=1e-4)


def test_a_coasting_vehicle_slows_down_as_the_closed_form() -> None:
    """1 / v = 1 / v0 + d t / m for quadratic drag."""
    rail = Rail(experiment("remus-scene").model, 0)
    times = np.arange(0.0, 20.0, 0.5)
    speeds = rail.coast(1.5, times)
    expected = 1.0 / (1.0 / 1.5 + 1.62 / (30.479 + 0.93) * times)
    assert speeds == pytest.approx(expected, rel=1e-3)


def test_the_bollard_pull_is_the_thrust_curve() -> None:
    commands, pulls = pull_bollard(experiment("bluerov2-scene"))
    assert tuple(commands) == COMMANDS
    x = np.abs(commands)
    curve = 8.9 * x + 176.0 * x**3 - 404.1 * x**5 + 389.9 * x**7 - 140.3 * x**9
    expected = np.sign(commands) * curve * 4.0 * math.sqrt(0.5)
    assert pulls == pytest.approx(expected, rel=1e-3, abs=1e-3)


@pytest.mark.parametrize(
    ("axis", "inertia", "linear", "quadratic"),
    [(3, 0.26 + 0.189, 0.0, 1.19), (4, 0.23 + 0.135, 0.8, 0.47)],
)
def test_free_decays_have_period_and_damping_of_the_closed_form(
    axis: int, inertia: float, linear: float, quadratic: float
) -> None:
    """K = rho g V z_B; the vehicle's centre of mass is its origin, so nothing couples."""
    record = release(trim_vehicle(experiment("bluerov2-scene")), axis)
    stiffness = 13.5 * 9.81 * 0.01
    period = 2.0 * math.pi * math.sqrt(inertia / stiffness)
    assert record.file_period == pytest.approx(period, rel=1e-9)
    decay = record.decay
    assert decay is not None
    assert decay.period == pytest.approx(period, rel=5e-3)
    omega, amplitude = 2.0 * math.pi / period, 0.05
    ratio = linear / inertia / (2.0 * omega) + 4.0 * quadratic / inertia * amplitude / (
        3.0 * math.pi
    )
    assert decay.damping_ratio(amplitude) == pytest.approx(ratio, rel=0.02)


@pytest.mark.parametrize("axis", [3, 4])
def test_the_remus_swings_with_the_period_of_its_coupled_closed_form(axis: int) -> None:
    record = release(trim_vehicle(experiment("remus-scene")), axis)
    assert record.decay is not None
    assert record.file_period is not None
    assert record.decay.period == pytest.approx(record.file_period, rel=5e-3)


def test_the_speed_of_a_decay_that_nothing_opposes_is_zero() -> None:
    rail = Rail(experiment("bluerov2-scene").model, 0)
    rail.advance(1.0)
    assert rail.speed == 0.0

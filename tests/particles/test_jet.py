"""The jet of a thruster against its momentum and published numbers."""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.particles.jet import Jet
from uwsim.particles.sediment import SedimentSpec
from uwsim.particles.terminal_speed import WATER_DENSITY

JET = Jet(thrust=50.0, diameter=0.18)


def test_the_momentum_of_the_jet_is_the_thrust() -> None:
    for distance in (1.0, 3.0):
        radii = np.linspace(0.0, 2.0 * distance, 4001)
        speeds = np.array([JET.compute_speed(distance, radius) for radius in radii])
        momentum = np.trapezoid(WATER_DENSITY * speeds**2 * 2.0 * math.pi * radii, radii)
        assert momentum == pytest.approx(JET.thrust, rel=0.03)


def test_the_first_speed_is_that_of_momentum_theory() -> None:
    expected = 1.60 * math.sqrt(50.0 / WATER_DENSITY) / 0.18
    assert JET.initial_speed == pytest.approx(expected, rel=0.003)


def test_a_level_jet_is_fastest_along_the_floor_as_published() -> None:
    # PIANC report 180 (2015): 0.3 V0 D0 / h
    distance, speed = JET.find_floor_contact(1.5, 0.0)
    assert speed == pytest.approx(0.306 * JET.initial_speed * JET.initial_diameter / 1.5, rel=0.01)
    assert distance == pytest.approx(5.55 * 1.5, rel=0.01)


@pytest.mark.parametrize("rise", [-1.0, -0.6, 0.0, 0.3])
def test_no_other_place_on_the_floor_is_faster(rise: float) -> None:
    height = 0.8
    _, speed = JET.find_floor_contact(height, rise)
    distances = np.linspace(0.4, 40.0, 20000)
    speeds = [JET.compute_speed(x, height + rise * x) for x in distances]
    assert max(speeds) == pytest.approx(speed, rel=1e-3)


def test_a_weak_flow_erodes_nothing() -> None:
    spec = SedimentSpec(critical_stress=0.1, erosion_rate=1e-3)
    critical_speed = math.sqrt(0.1 / (0.5 * 0.01 * WATER_DENSITY))
    assert spec.compute_erosion(0.99 * critical_speed) == 0.0
    assert spec.compute_erosion(2.0 * critical_speed) == pytest.approx(3e-3)

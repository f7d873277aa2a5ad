"""What waves do to bodies and sensors of a scene."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from tests.waves.buoy import ADDED_MASS, DAMPING, DENSITY, RADIUS, open_buoy
from uwsim.errors import UwsimError
from uwsim.simulation import Simulation

G = 9.81
WAVE = "<u:regularWave><u:height>{}</u:height><u:period>{}</u:period></u:regularWave>"
SEA = (
    "<u:jonswap><u:significantHeight>0.4</u:significantHeight><u:peakPeriod>4</u:peakPeriod>"
    "<u:spreading>10</u:spreading></u:jonswap>"
)


def height_of(simulation: Simulation) -> float:
    return float(simulation.world.bodies.find("buoy").world_from_body.position[2])


def response(simulation: Simulation, period: float, n_periods: int) -> complex:
    """Return the amplitude of the heave after the transient, by least squares [m].

    Its phase is that of the waves at the mean place of the buoy.
    """
    heights, places, step = [], [], 0.02
    simulation.advance(10 * period)
    n = round(n_periods * period / step)
    start = simulation.time
    for _ in range(n):
        simulation.advance(step)
        heights.append(height_of(simulation))
        places.append(simulation.world.bodies.find("buoy").world_from_body.position[0])
    phase = 2.0 * math.pi / period * (start + step * np.arange(1, n + 1))
    basis = np.stack([np.cos(phase), np.sin(phase), np.ones(n)], axis=1)
    cosine, sine, _ = np.linalg.lstsq(basis, np.array(heights), rcond=None)[0]
    k = (2.0 * math.pi / period) ** 2 / G
    heave: complex = complex(cosine, -sine) * np.exp(1j * k * np.mean(places))
    return heave


@pytest.mark.slow
@pytest.mark.parametrize("period", [3.0, 4.0, 7.0])
def test_a_floating_cylinder_heaves_by_its_response_amplitude_operator(
    tmp_path: Path, period: float
) -> None:
    """(rho g A e^-kT - w^2 A33 e^-kT/2 + i w B e^-kT/2) / (rho g A - w^2 (m + A33) + i w B)."""
    height, draught = 0.1, 1.2
    simulation = open_buoy(tmp_path, WAVE.format(height, period), draught=draught)
    omega = 2.0 * math.pi / period
    k, area = omega**2 / G, math.pi * RADIUS**2
    middle = math.exp(-0.5 * k * draught)  # of the hull, where the water acts
    force = DENSITY * G * area * math.exp(-k * draught)
    force += (-(omega**2) * ADDED_MASS + 1j * omega * DAMPING) * middle
    stiffness = DENSITY * G * area - omega**2 * (DENSITY * area * draught + ADDED_MASS)
    expected = force / (stiffness + 1j * omega * DAMPING)
    heave = response(simulation, period, 6) / (0.5 * height)
    assert abs(heave) == pytest.approx(abs(expected), rel=0.05)
    assert abs(heave - expected) < 0.08 * abs(expected)  # the phase, too


def test_a_buoy_rides_long_waves(tmp_path: Path) -> None:
    simulation = open_buoy(tmp_path, WAVE.format(1.0, 14.0))
    simulation.advance(84.0)  # the crest of the start has died out
    for _ in range(10):
        simulation.advance(1.4)
        water = simulation.world.water
        assert water.waves is not None
        position = simulation.world.bodies.find("buoy").world_from_body.position
        elevation = water.waves.elevation(position[None], simulation.time)[0]
        assert position[2] + 0.2 == pytest.approx(elevation, abs=0.01)


def test_a_level_surface_leaves_a_buoy_at_rest(tmp_path: Path) -> None:
    simulation = open_buoy(tmp_path, WAVE.format(0.0, 5.0))
    simulation.advance(5.0)
    assert height_of(simulation) == pytest.approx(-0.2, abs=1e-9)


def test_steps_one_by_one_give_the_same_bytes_as_many_at_once(tmp_path: Path) -> None:
    first, second = (open_buoy(tmp_path, SEA) for _ in range(2))
    for simulation in (first, second):
        simulation.set_current((0.1, 0.0, 0.0))
    first.advance(2.0)
    for _ in range(1000):
        second.advance(0.002)
    poses = [run.world.bodies.find("buoy").world_from_body for run in (first, second)]
    assert poses[0].position.tobytes() == poses[1].position.tobytes()
    assert poses[0].rotation.tobytes() == poses[1].rotation.tobytes()


def test_a_restored_sea_goes_on_with_its_height(tmp_path: Path) -> None:
    simulation = open_buoy(tmp_path, SEA)
    simulation.world.water.set_wave_height(0.8)
    simulation.advance(1.0)
    saved = simulation.save()
    simulation.advance(1.0)
    end = height_of(simulation)
    simulation.world.water.set_wave_height(None)
    simulation.restore(saved)
    simulation.advance(1.0)
    assert height_of(simulation) == end


def test_the_height_of_a_level_surface_cannot_be_set(tmp_path: Path) -> None:
    simulation = open_buoy(tmp_path, "")
    with pytest.raises(UwsimError, match=r"no waves whose height could change; expected <u:waves>"):
        simulation.world.water.set_wave_height(1.0)

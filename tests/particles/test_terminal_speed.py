"""Terminal speeds of spheres and bubbles against published numbers."""

from __future__ import annotations

import pytest

from uwsim.particles import compute_bubble_speed, compute_sphere_speed

FRESH_WATER = {"water_density": 998.2, "viscosity": 1.004e-6}
"""Fresh water at 20 degrees Celsius [kg/m3], [m2/s]."""


@pytest.mark.parametrize(
    ("diameter", "density", "speed"),
    [
        # N. Mordant and J.-F. Pinton, Eur. Phys. J. B 18, 343 (2000), measured
        (0.5e-3, 2560.0, 0.074),
        (0.8e-3, 7710.0, 0.316),
    ],
)
def test_spheres_settle_at_the_measured_speed(
    diameter: float, density: float, speed: float
) -> None:
    assert compute_sphere_speed(diameter, density, **FRESH_WATER) == pytest.approx(-speed, rel=0.04)


def test_a_tiny_sphere_follows_stokes() -> None:
    diameter, density = 20e-6, 1050.0
    stokes = 9.81 * diameter**2 * (density - 998.2) / (18.0 * 998.2 * 1.004e-6)
    assert compute_sphere_speed(diameter, density, **FRESH_WATER) == pytest.approx(
        -stokes, rel=0.005
    )


@pytest.mark.parametrize(
    ("diameter", "speed"),
    [
        # R. Clift, J. R. Grace and M. E. Weber (1978), fig. 7.3, contaminated water, read to 10 %
        (0.5e-3, 0.05),
        (1.0e-3, 0.11),
        (2.0e-3, 0.19),
        (5.0e-3, 0.23),
        (1.0e-2, 0.25),
    ],
)
def test_bubbles_rise_at_the_speed_of_clift(diameter: float, speed: float) -> None:
    assert compute_bubble_speed(diameter) == pytest.approx(speed, rel=0.12)


def test_a_bubble_rises_and_a_stone_sinks() -> None:
    assert compute_bubble_speed(0.002) > 0.0 > compute_sphere_speed(0.002, 2650.0)

"""Calibrations of pictures that are drawn from the path tracer, with the noise of a camera."""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.special import j0

from tests.calibration.tank import (
    BOARD_LIGHT,
    CAMERA,
    LED_LIGHT,
    check_limits,
    estimate_noisy_waters,
)
from tests.calibration.test_estimate import ALBEDO, CLEAR, PHASES
from tests.calibration.traced_signals import (
    LAMP_OFFSET,
    FloatArray,
    Water,
    compute_irradiance,
    trace_lamp_irradiance,
    trace_led_signals,
)
from tests.optics.path_tracer import tabulate, trace_spread
from uwsim.base.numerics.jit import njit
from uwsim.calibration.example.synthetic_pictures import LAYOUT, draw_board, draw_led

N_PATHS = 100_000
ANGLES = np.radians(np.geomspace(0.02, 40.0, 70))


@cache
def draw(name: str, c: float) -> dict[str, FloatArray]:
    """Draw LED and board through a water at 1 m."""
    water = Water(PHASES[name], c, CLEAR[1] if c == CLEAR[0] else ALBEDO * c)
    tables = tabulate(water.phase)
    shares = trace_led_signals(water, 1.0, N_PATHS, 1, ANGLES) - math.exp(-c)
    table = np.append(0.0, ANGLES), np.append(0.0, shares)

    led = draw_led(CAMERA, math.exp(-c), lambda angles: np.interp(angles, *table))
    weights, radii = trace_spread(tables, c, water.albedo, N_PATHS, 2)
    rings = np.append(0.0, np.geomspace(1e-5, 30.0, 1200))
    sums, _ = np.histogram(radii, rings, weights=weights)
    places = 0.5 * (rings[1:] + rings[:-1])
    irradiance = trace_lamp_irradiance(tables, water, 1.0, 4 * N_PATHS, 3)

    def compute_transfer(frequencies: FloatArray) -> FloatArray:
        values = j0(2.0 * math.pi * frequencies[:, None] * places) @ sums
        return math.exp(-c) + values / N_PATHS

    board = draw_board(
        CAMERA,
        LAYOUT,
        1.0,
        compute_transfer,
        lambda x, y: _light_board(np.hypot(x - LAMP_OFFSET, y).ravel(), c, irradiance).reshape(
            x.shape
        ),
    )
    return {"led": LED_LIGHT * led, "board": BOARD_LIGHT * math.pi * board}


@njit
def _light_board(radii: FloatArray, attenuation: float, irradiance: FloatArray) -> FloatArray:
    light = np.zeros(len(radii))
    for i in range(len(radii)):
        light[i] = compute_irradiance(attenuation, 1.0, radii[i], irradiance)
    return light


@pytest.mark.slow
@pytest.mark.parametrize("name", PHASES)
@pytest.mark.parametrize("c", [0.25, 1.0, 2.0])
def test_the_mean_of_twenty_calibrations_of_traced_pictures_is_the_water(
    name: str, c: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    light = {"clear": draw(name, CLEAR[0]), "dyed": draw(name, c)}
    check_limits(estimate_noisy_waters(light, tmp_path, monkeypatch), c)

"""Calibrations of pictures that the renderer takes through physical water.

The renderer blurs by Gaussians, and knows nothing of the forward model of a calibration. An
LED is a bright plate of 3 mm in a dim isotropic field, whose picture without the plate is
subtracted. The reference water is the red channel of the same water, the dyed one the green.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from tests.calibration.tank import BOARD_LIGHT, CAMERA, check_limits, estimate_noisy_waters
from tests.calibration.test_estimate import ALBEDO, CLEAR, PHASES
from tests.calibration.traced_signals import BLACK, LAMP_OFFSET, WHITE, FloatArray
from tests.rendering.models import placed, plate
from tests.rendering.physical.photographs import (
    camera_of,
    lamp_beside_camera,
    photograph,
    show_plane,
)
from uwsim.calibration.example.synthetic_pictures import LAYOUT
from uwsim.optics import Medium
from uwsim.rendering.physical.physical_water import Daylight, PhysicalWater
from uwsim.rendering.renderer import Renderer

DISTANCE = 1.0
FIELD = 1e-3
"""The radiance of the isotropic field that lights the LED's plate."""
EXPOSURES = (0.03, 1.0, 20.0)
"""The exposures of an LED, whose linear light has 16 bit."""
LED_SCALE = 25.0
"""The factor from the radiance of the plate to the light of a camera."""
STORED_WHITE = 9.0
"""The stored colour of the plate, which has no limit."""


def draw_led(renderer: Renderer, medium: Medium) -> FloatArray:
    """Draw the LED without the field around it, (rows, columns, channels)."""
    light = np.zeros((CAMERA.rows, CAMERA.columns, 3))
    camera = camera_of(CAMERA.focal_length, CAMERA.columns, CAMERA.rows)
    for exposure in EXPOSURES:
        water = PhysicalWater(
            medium=medium,
            transfer="linear",
            isotropic_radiance=(FIELD,) * 3,
            exposure=exposure,
        )
        show_plane(renderer, DISTANCE, (0.0, 0.0, 0.0))
        field = photograph(renderer, water, camera)
        led = renderer.add(plate(0.003, 0.003, (STORED_WHITE,) * 3), 2)
        renderer.place(led, placed(z=-DISTANCE + 1e-4))
        image = photograph(renderer, water, camera)
        light = np.where(image * exposure < 0.98, image - field, light)
    return light


def draw_board(renderer: Renderer, medium: Medium) -> FloatArray:
    """Draw the board in the light of a lamp, with its veil."""
    show_plane(renderer, DISTANCE, (encode(0.5 * (WHITE + BLACK)),) * 3)
    number = 2
    for side, (centre_x, centre_y) in zip(LAYOUT.sides, LAYOUT.centres, strict=True):
        for u, v in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)):
            colour = (encode(WHITE if u * v > 0.0 else BLACK),) * 3
            x, y = centre_x + u * side, centre_y + v * side  # right and down
            square = renderer.add(plate(side, side, colour), number)
            renderer.place(square, placed(x=x, y=-y, z=-DISTANCE + 1e-4))
            number += 1
    water = PhysicalWater(
        medium=medium, transfer="linear", daylight=Daylight(irradiance=0.0), exposure=2.5
    )
    camera = camera_of(CAMERA.focal_length, CAMERA.columns, CAMERA.rows)
    return photograph(renderer, water, camera, (lamp_beside_camera(LAMP_OFFSET),))


def encode(light: float) -> float:
    """Return the stored colour of sRGB for a reflectance."""
    return 1.055 * light ** (1.0 / 2.4) - 0.055


@pytest.mark.slow
@pytest.mark.parametrize("name", PHASES)
@pytest.mark.parametrize("c", [0.25, 1.0, 2.0])
def test_the_mean_of_twenty_calibrations_of_rendered_pictures_is_the_water(
    name: str, c: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    medium = Medium.from_beam_attenuation(
        (CLEAR[0], c, c), (CLEAR[1], ALBEDO * c, ALBEDO * c), PHASES[name]
    )
    renderer = Renderer()
    led, board = draw_led(renderer, medium), draw_board(renderer, medium)
    renderer.close()
    light = {
        water: {
            "led": LED_SCALE * led[..., channel],
            "board": BOARD_LIGHT * math.pi * board[..., channel],
        }
        for channel, water in enumerate(("clear", "dyed"))
    }
    check_limits(estimate_noisy_waters(light, tmp_path, monkeypatch), c)

"""Calibrations of pictures that are drawn from the path tracer, with the noise of a camera."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.special import j0

from tests.calibration.test_estimate import (
    ALBEDO,
    CLEAR,
    N_SEEDS,
    PHASES,
    limit_of_b,
    limit_of_c,
)
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
from uwsim.calibration import calibrate
from uwsim.calibration.example.synthetic_pictures import (
    LAYOUT,
    SyntheticCamera,
    draw_board,
    draw_led,
)
from uwsim.calibration.measurements import make_measurements
from uwsim.calibration.pictures import picture_readings
from uwsim.calibration.pictures.frames import FrameMean
from uwsim.calibration.setup import SetupSpec, read_setup

CAMERA = SyntheticCamera(rows=360, columns=470)
"""Pixels of 1 mrad, 10 000 electrons, 3 electrons of read noise."""
N_FRAMES = 16
N_PATHS = 100_000
LED_EXPOSURES = (0.25, 4.0)
LED_LIGHT = 20.0
BOARD_LIGHT = 1.6
BOARD_EXPOSURE = 0.5
ANGLES = np.radians(np.geomspace(0.02, 40.0, 70))


def write_setup(path: Path) -> Path:
    """Write a set-up whose files are names of pictures: ``water/source/exposure``."""

    def picture(water: str, source: str, exposures: tuple[float, ...]) -> str:
        parts = "".join(
            f"<exposure><time>{time}</time><frames>{water}/{source}/{time}</frames>"
            f"<dark>dark/{source}/{time}</dark></exposure>"
            for time in exposures
        )
        return f"<picture><source>{source}</source>{parts}</picture>"

    pictures = {
        water: picture(water, "led", LED_EXPOSURES) + picture(water, "board", (BOARD_EXPOSURE,))
        for water in ("clear", "dyed")
    }
    absorption = CLEAR[0] - CLEAR[1]
    squares = "".join(f"<square>{side}</square>" for side in LAYOUT.sides)
    path.write_text(
        f"<calibration><camera><focalLength>{CAMERA.focal_length}</focalLength></camera>"
        f"<channel><name>red</name><referenceAbsorption>{absorption}</referenceAbsorption>"
        f"<referenceScattering>{CLEAR[1]}</referenceScattering></channel>"
        f"<led><name>led</name></led><board><name>board</name>{squares}</board>"
        f"<reference>{pictures['clear']}</reference>"
        f"<water><name>dyed</name>{pictures['dyed']}</water></calibration>"
    )
    return path


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


class Tank:
    """The pictures of a trial: means of 16 frames, with noise, drift and an error of black."""

    def __init__(self, name: str, c: float, seed: int) -> None:
        self.light = {"clear": draw(name, CLEAR[0]), "dyed": draw(name, c)}
        self.generator = np.random.default_rng(seed)
        self.drifts = {
            (water, source): 1.0 + 0.01 * self.generator.standard_normal()
            for water in self.light
            for source in ("led", "board")
        }

    def average_frames(self, paths: list[Path]) -> FrameMean:
        [path] = paths
        water, source, exposure = path.parts
        well, generator = CAMERA.full_well, self.generator
        shape = (CAMERA.rows, CAMERA.columns)
        electrons = np.zeros(shape)
        if water != "dark":
            light = self.light[water][source] * self.drifts[water, source]
            electrons = np.maximum(light, 0.0) * float(exposure) * well
        black_error = 0.0 if water == "dark" else CAMERA.black_drift * generator.standard_normal()
        variances = (electrons + CAMERA.read_noise**2) / N_FRAMES
        noise = np.sqrt(variances) * generator.standard_normal(shape)
        values = (electrons + noise + black_error) / well + CAMERA.black_level
        scale = CAMERA.full_scale
        numbers = np.minimum(values, 1.0)[..., None] * scale
        return FrameMean(numbers, variances[..., None] / well**2 * scale**2, numbers)


@pytest.fixture(scope="module")
def setup(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SetupSpec]:
    path = write_setup(tmp_path_factory.mktemp("setup") / "setup.xml")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(picture_readings, "list_files", lambda pattern, folder: [Path(pattern)])
        yield read_setup(path, needs_pictures=False)


@pytest.mark.slow
@pytest.mark.parametrize("name", PHASES)
@pytest.mark.parametrize("c", [0.25, 1.0, 2.0])
def test_the_mean_of_twenty_calibrations_of_pictures_is_the_water(
    name: str, c: float, setup: SetupSpec, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The limits are those of the issue: 0.03 1/m or 4 % of c and 5 % of b."""
    estimates = []
    for seed in range(N_SEEDS):
        tank = Tank(name, c, seed)
        monkeypatch.setattr(picture_readings, "average_frames", tank.average_frames)
        [water] = picture_readings.read_pictures(setup, Path())
        assert water.remarks == ()
        [result] = calibrate(make_measurements(setup, [water])).waters[0].channels
        estimates.append(result.estimate)
    mean_c = np.mean([estimate.water.beam_attenuation for estimate in estimates])
    mean_b = np.mean([estimate.water.scattering for estimate in estimates])
    assert mean_c == pytest.approx(c, abs=limit_of_c(c))
    assert mean_b == pytest.approx(ALBEDO * c, abs=limit_of_b(ALBEDO * c))
    # The board alone, as if all scattered light were lost.
    [naive_attenuation] = {
        reading.side: -math.log(reading.signal / reading.reference) / reading.path_length
        for reading in estimates[0].readings
        if getattr(reading, "side", 0.0) == 0.15
    }.values()
    assert abs(naive_attenuation + CLEAR[0] - c) > limit_of_c(c)

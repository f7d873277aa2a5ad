"""Pictures of a tank with the noise of a camera, without files: what tests of pictures share."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from tests.calibration.test_estimate import ALBEDO, CLEAR, N_SEEDS, limit_of_b, limit_of_c
from tests.calibration.traced_signals import FloatArray
from uwsim.calibration.estimate import Estimate, estimate_water
from uwsim.calibration.example.synthetic_pictures import LAYOUT, SyntheticCamera
from uwsim.calibration.measurements import make_measurements
from uwsim.calibration.pictures import picture_readings
from uwsim.calibration.pictures.frames import FrameMean
from uwsim.calibration.setup import read_setup

CAMERA = SyntheticCamera(rows=360, columns=470)
"""Pixels of 1 mrad, 10 000 electrons, 3 electrons of read noise, linear numbers of 12 bit."""
N_FRAMES = 16
LED_EXPOSURES = (0.25, 4.0)
LED_LIGHT = 20.0
BOARD_LIGHT = 1.6
BOARD_EXPOSURE = 0.5


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
        f"<calibration><camera><focalLength>{CAMERA.focal_length}</focalLength>"
        f"<fullScale>{CAMERA.full_scale}</fullScale></camera>"
        f"<channel><name>red</name><referenceAbsorption>{absorption}</referenceAbsorption>"
        f"<referenceScattering>{CLEAR[1]}</referenceScattering></channel>"
        f"<led><name>led</name></led><board><name>board</name>{squares}</board>"
        f"<reference>{pictures['clear']}</reference>"
        f"<water><name>dyed</name>{pictures['dyed']}</water></calibration>"
    )
    return path


class Tank:
    """The pictures of a trial: means of 16 frames, with noise, drift and an error of black."""

    def __init__(self, light: dict[str, dict[str, FloatArray]], seed: int) -> None:
        self.light = light
        self.generator = np.random.default_rng(seed)
        self.drifts = {
            (water, source): 1.0 + 0.01 * self.generator.standard_normal()
            for water in self.light
            for source in ("led", "board")
        }

    def average_frames(self, paths: list[Path]) -> FrameMean:
        [path] = paths
        water, source, exposure = path.parts
        light = np.zeros((CAMERA.rows, CAMERA.columns))
        if water != "dark":
            light = self.light[water][source] * self.drifts[water, source]
        frames = np.stack(CAMERA.expose(light, float(exposure), N_FRAMES, self.generator))[
            ..., None
        ]
        variances = frames.var(axis=0, ddof=1) / N_FRAMES
        return FrameMean(frames.mean(axis=0), variances, frames.max(axis=0))


def estimate_noisy_waters(
    light: dict[str, dict[str, FloatArray]], folder: Path, monkeypatch: pytest.MonkeyPatch
) -> list[Estimate]:
    """Return the estimates of twenty trials with pictures of this light."""
    monkeypatch.setattr(picture_readings, "list_files", lambda pattern, folder: [Path(pattern)])
    setup = read_setup(write_setup(folder / "setup.xml"), needs_pictures=False)
    estimates = []
    for seed in range(N_SEEDS):
        tank = Tank(light, seed)
        monkeypatch.setattr(picture_readings, "average_frames", tank.average_frames)
        [water] = picture_readings.read_pictures(setup, Path())
        assert water.remarks == ()
        measurements = make_measurements(setup, [water])
        estimates.append(
            estimate_water(water.readings, measurements.references["red"], measurements.accuracy)
        )
    return estimates


def check_limits(estimates: list[Estimate], c: float) -> None:
    """Check the limits of the issue: 0.03 1/m or 4 % of c, 0.03 1/m or 5 % of b; and naive c."""
    mean_c = np.mean([estimate.water.beam_attenuation for estimate in estimates])
    mean_b = np.mean([estimate.water.scattering for estimate in estimates])
    assert mean_c == pytest.approx(c, abs=limit_of_c(c))
    assert mean_b == pytest.approx(ALBEDO * c, abs=limit_of_b(ALBEDO * c))
    # The board alone, as if all scattered light were lost.
    [naive_attenuation] = [
        -math.log(reading.signal / (reading.reference or 1.0)) / reading.path_length + CLEAR[0]
        for reading in estimates[0].readings
        if getattr(reading, "side", 0.0) == 0.15
    ]
    assert abs(naive_attenuation - c) > limit_of_c(c)

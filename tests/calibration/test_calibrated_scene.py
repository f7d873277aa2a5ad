"""A calibrated water in a scene."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.calibration.test_calibrate import WATER, make_measurements, make_water
from uwsim.calibration import calibrate
from uwsim.optics import PhaseMixture, write_water
from uwsim.scene.physical_water import PhysicalWaterSpec


def test_a_scene_that_names_the_water_file_has_its_coefficients(tmp_path: Path) -> None:
    calibration = calibrate(make_measurements(make_water("tank", WATER)))
    path = tmp_path / "water.json"
    path.write_text(write_water(calibration.waters[0].make_water_file("a test")))
    spec = PhysicalWaterSpec(law="physical", file="water.json")
    medium = spec.read_medium(lambda name: tmp_path / name)
    assert medium.scattering == (pytest.approx(WATER.scattering, abs=0.01),) * 3
    assert isinstance(medium.phase_function, PhaseMixture)

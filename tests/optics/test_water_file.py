"""Water files: what is written is read, and every error is reported with its line."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest

from uwsim.errors import FileError
from uwsim.optics import (
    FournierForand,
    HenyeyGreenstein,
    Medium,
    PhaseFunction,
    PhaseMixture,
    PhaseTable,
    WaterFile,
    read_water,
    write_water,
)

ANGLES = (0.001, 0.01, 0.1, 1.0, math.pi)
TABLE, _ = PhaseTable.from_scattering_function(ANGLES, (100.0, 30.0, 4.0, 0.1, 0.02))
MIXTURE = PhaseMixture((FournierForand(), HenyeyGreenstein(0.9)), (0.7, 0.3))


@pytest.mark.parametrize(
    "phase", [FournierForand(1.12, 3.7), HenyeyGreenstein(0.95), TABLE, MIXTURE], ids=str
)
def test_a_written_water_is_read_again(phase: PhaseFunction, tmp_path: Path) -> None:
    water = WaterFile(
        name="tank",
        medium=Medium(absorption=(0.3, 0.1), scattering=(0.5, 0.7), phase_function=phase),
        source="a test",
        uncertainties={"scattering": (0.01, 0.02)},
    )
    path = tmp_path / "water.json"
    path.write_text(write_water(water))
    assert read_water(path) == water


def test_a_file_reports_all_of_its_errors_with_their_lines(tmp_path: Path) -> None:
    path = tmp_path / "water.json"
    path.write_text(
        '{"uwsim_water": 2,\n"absorbtion": [1],\n"scattering": [0.1, "x"],\n'
        '"phase_function": {"type": "FournierForand", "refractive_index": 1.1,\n"slop": 3}}\n'
    )
    with pytest.raises(FileError) as error:
        read_water(path)
    text = str(error.value)
    assert "water.json:1: uwsim_water is 2; expected 1" in text
    assert "water.json:2: 'absorbtion' is not a key" in text
    assert "Did you mean 'absorption'?" in text
    assert "water.json:3: scattering has an entry that is no finite number" in text
    assert "water.json:5: 'slop' is not a key of FournierForand" in text
    assert "absorption is missing" in text
    assert "slope is None" in text


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[]", "not a JSON object"),
        ("{", "not JSON"),
        ('{"uwsim_water": 1, "absorption": [1], "scattering": [1, 2], "phase_function": '
         '{"type": "HenyeyGreenstein", "asymmetry": 0.9}}', "one of each for every channel"),
        ('{"uwsim_water": 1, "absorption": [1], "scattering": [1], "phase_function": '
         '{"type": "HenyeyGreenstein", "asymmetry": 2}}', "expected 0 to 0.999"),
        ('{"uwsim_water": 1, "absorption": [1], "scattering": [1], "phase_function": '
         '{"type": "Petzold"}}', "no phase function is called 'Petzold'"),
        ('{"uwsim_water": 1, "absorption": [1], "scattering": [1], "phase_function": '
         '{"type": "PhaseMixture", "parts": 3, "weights": [1]}}', "parts is not a list"),
    ],
)  # fmt: skip
def test_each_mistake_is_named(text: str, message: str, tmp_path: Path) -> None:
    path = tmp_path / "water.json"
    path.write_text(text)
    with pytest.raises(FileError, match=message):
        read_water(path)


def test_a_missing_file_is_an_error_of_the_file(tmp_path: Path) -> None:
    with pytest.raises(FileError, match=r"none\.json: cannot be read"):
        read_water(tmp_path / "none.json")


def test_a_mixture_is_normalised_and_linear_in_its_parts() -> None:
    angles = np.geomspace(1e-3, 3.0, 20)
    first, second = FournierForand(), HenyeyGreenstein(0.9)
    for name in ("compute_density", "compute_cumulative", "compute_encircled_energy"):
        expected = 0.7 * getattr(first, name)(angles) + 0.3 * getattr(second, name)(angles)
        np.testing.assert_allclose(getattr(MIXTURE, name)(angles), expected, rtol=1e-9)
    expected = 0.7 * first.backscatter_ratio + 0.3 * second.backscatter_ratio
    assert MIXTURE.backscatter_ratio == pytest.approx(expected)
    assert PhaseMixture((first,), (2.0,)).compute_cumulative(math.pi) == pytest.approx(1.0)


SPECTRUM = """{{"uwsim_water": 1, "name": "lake",
"wavelengths": {wavelengths},
"absorption": [0.1, 0.12, 0.4], "scattering": [0.5, 0.45, 0.4],
"phase_function": {{"type": "HenyeyGreenstein", "asymmetry": 0.9}}{end}}}
"""


def test_a_spectrum_is_reduced_to_three_channels(tmp_path: Path) -> None:
    path = tmp_path / "lake.json"
    path.write_text(SPECTRUM.format(wavelengths=[440, 550, 660], end=""))
    medium = read_water(path).medium
    assert medium.n_channels == 3
    assert medium.phase_function == HenyeyGreenstein(0.9)
    assert medium.absorption[0] > medium.absorption[1] > 0.1


def test_an_invalid_spectrum_is_reported_with_its_lines(tmp_path: Path) -> None:
    path = tmp_path / "lake.json"
    end = ',\n"molecular_scattering": [0, 0, 0]'
    path.write_text(SPECTRUM.format(wavelengths=[440, 550], end=end))
    with pytest.raises(FileError) as error:
        read_water(path)
    text = str(error.value)
    assert "lake.json:2: The spectrum has 2 wavelengths; expected 3 to 1000" in text
    assert "lake.json:5: molecular_scattering is that of pure water" in text


def test_the_example_of_the_documentation_is_a_water_of_three_channels(tmp_path: Path) -> None:
    page = (Path(__file__).parents[2] / "docs" / "physical-water.md").read_text()
    (example,) = re.findall(r"```json\n(.*?)```", page, re.S)
    path = tmp_path / "water.json"
    path.write_text(example)
    water = read_water(path)
    assert water.name == "station 4"
    red, green, blue = water.medium.absorption
    assert red > green
    assert red > blue
    assert water.medium.phase_function == FournierForand(1.10, 3.5835)

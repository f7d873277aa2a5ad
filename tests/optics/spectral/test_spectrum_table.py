"""Tables of spectra in files."""

from __future__ import annotations

from pathlib import Path

import pytest

from uwsim.errors import FileError
from uwsim.optics.spectral import read_spectrum_table
from uwsim.optics.spectral.spectrum_table import MAX_BYTES


def write(folder: Path, text: str) -> Path:
    """Write a table."""
    path = folder / "ac-s.csv"
    path.write_text(text)
    return path


def test_a_table_is_read_by_the_names_of_its_columns(tmp_path: Path) -> None:
    path = write(
        tmp_path,
        "# station 4\nbeam_attenuation, wavelength ,absorption\n\n1.02,412,0.18\n0.94,440,0.13\n",
    )
    assert read_spectrum_table(path) == {
        "wavelength": (412.0, 440.0),
        "absorption": (0.18, 0.13),
        "beam_attenuation": (1.02, 0.94),
    }


@pytest.mark.parametrize(
    ("text", "messages"),
    [
        ("", [":1: is empty"]),
        (
            "wavelength;absorption;scattering\n450;0,1;1\n",
            ["separated by semicolons; expected"],
        ),
        ("wavelength\tabsorption\tscattering\n", [":1: the columns are separated by tabs"]),
        ("wavelength,absorbtion,scattering\n", [":1: no column is called 'absorbtion'."]),
        ("wavelength,absorption\n450,1\n", [":1: the columns are wavelength, absorption; expec"]),
        ("absorption,scattering,absorption\n", [":1: a column occurs twice"]),
        (
            "wavelength,absorption,scattering\n450,1\n550,a,nan\n",
            [":2: has 2 cells; expected 3", ":3: absorption is 'a'", ":3: scattering is 'nan'"],
        ),
        (
            "wavelength,absorption,scattering\n" + "450,1,1\n" * 1001,
            [":1: has 1001 wavelengths; expected at most 1000"],
        ),
    ],
)
def test_every_error_of_a_table_has_its_line(
    tmp_path: Path, text: str, messages: list[str]
) -> None:
    with pytest.raises(FileError) as caught:
        read_spectrum_table(write(tmp_path, text))
    for message in messages:
        assert message in str(caught.value)


def test_a_table_that_is_too_large_is_named_once(tmp_path: Path) -> None:
    path = write(tmp_path, "#" * (MAX_BYTES + 1))
    with pytest.raises(FileError) as caught:
        read_spectrum_table(path)
    assert str(caught.value) == f"{path}: is larger than 1 MiB"


def test_a_missing_table_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="cannot be read"):
        read_spectrum_table(tmp_path / "missing.csv")

"""docs/your-own-vehicle.md does what it says: its files are written, its program run."""

from __future__ import annotations

import re
import runpy
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.support.opened import open_scene
from uwsim.checks import check_file
from uwsim.errors import SceneError
from uwsim.scene.hydrodynamics.spec import (
    BodyHydrodynamics,
    ThrusterSpec,
    VehicleHydrodynamics,
)
from uwsim.scene.reader import read_scene
from uwsim.schema import fields_of

PAGE = Path(__file__).parents[2] / "docs" / "your-own-vehicle.md"


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", PAGE.read_text(), re.MULTILINE | re.DOTALL)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name, text in zip(
        ("my_rov.urdf", "my_rov.xml", "my_scene.xml"), blocks("xml"), strict=True
    ):
        (tmp_path / name).write_text(text)
    return tmp_path


@pytest.fixture
def said_by(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Callable[[str], str]:
    """Run a program in the folder, as ``python program.py`` would; return what it prints."""

    def run(program: str) -> str:
        (folder / "program.py").write_text(program)
        monkeypatch.chdir(folder)
        runpy.run_path("program.py", run_name="__main__")
        return capsys.readouterr().out

    return run


def test_a_newcomers_vehicle_swims_as_the_page_shows(said_by: Callable[[str], str]) -> None:
    assert said_by("".join(blocks("python")[:2])) in blocks("text")


def test_it_swims_in_a_scene_as_the_page_shows(said_by: Callable[[str], str]) -> None:
    assert said_by(blocks("python")[2]) in blocks("text")


def test_a_topic_that_leads_nowhere_is_reported_as_the_page_shows(
    said_by: Callable[[str], str],
) -> None:
    said = said_by(blocks("python")[2].replace('publisher("/twist"', 'publisher("/twst"'))
    assert said.splitlines(keepends=True)[0] in blocks("text")


@pytest.mark.parametrize("where", ["start(self, node)", "look(self, message)"])
def test_what_the_program_of_the_page_raises_is_seen(
    where: str, said_by: Callable[[str], str]
) -> None:
    program = blocks("python")[2].replace(f"def {where}:", f"def {where}:\n        1 / 0")
    with pytest.raises(ZeroDivisionError):
        said_by(program)


def test_the_page_names_every_element() -> None:
    text = PAGE.read_text()
    for element in (BodyHydrodynamics, ThrusterSpec, VehicleHydrodynamics):
        for field in fields_of(element):
            assert (
                f"`{field.label}`" in text
                or f"<{field.label}" in text
                or (f'{field.label}="..."' in text)
            ), field.label


def test_a_vehicle_without_any_mass_is_an_error_of_its_scene(folder: Path) -> None:
    side_file = folder / "my_rov.xml"
    side_file.write_text(side_file.read_text().replace("<mass>20</mass>", ""))
    said = [str(diagnostic) for diagnostic in check_file(folder / "my_scene.xml")]
    assert len(said) == 1
    assert "my_scene.xml:10: the vehicle 'my_rov' has no mass" in said[0]


@pytest.mark.parametrize(
    ("volume", "severity"),
    [("1e9", "error"), ("20.1", "error"), ("0.2", "warning"), ("0.0001", "warning")],
)
def test_a_vehicle_far_from_floating_is_reported(volume: str, severity: str, folder: Path) -> None:
    side_file = folder / "my_rov.xml"
    side_file.write_text(side_file.read_text().replace("0.0201", volume))
    (diagnostic,) = check_file(folder / "my_scene.xml")
    assert (diagnostic.line, diagnostic.severity) == (10, severity)
    assert f"has 20 kg and displaces {float(volume) * 1000:g} kg of water" in diagnostic.message
    if severity == "warning":
        open_scene(read_scene(folder / "my_scene.xml"), is_blind=True).close()
    else:
        with pytest.raises(SceneError, match="times the mass, as of the lightest foam"):
            open_scene(read_scene(folder / "my_scene.xml"), is_blind=True)

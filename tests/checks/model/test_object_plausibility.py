"""Numbers of objects that cannot be meant are errors or warnings, with their line."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.checks.model.test_plausibility import SCENE, written
from tests.support.opened import open_scene
from uwsim.checks import check_file
from uwsim.errors import Diagnostic, SceneError
from uwsim.scene.reader import read_scene

LINE = 1 + SCENE[: SCENE.index("<mass>1")].count("\n")


def said(physics: str, folder: Path, *, accepts: str = "") -> list[Diagnostic]:
    scene = SCENE.replace("<mass>1</mass>", physics)
    scene = scene.replace("</physics> </object>", f"</physics> {accepts} </object>")
    found = check_file(written(folder, scene=scene))
    return [each for each in found if each.message.startswith("the object 'box'")]


@pytest.mark.parametrize(
    ("physics", "warning", "text"),
    [
        (
            "<mass>1</mass> <u:centreOfMass> <x>100</x> <y>0</y> <z>0</z> </u:centreOfMass>",
            "places",
            "its centre of mass lies 99.",
        ),
        ("<mass>600</mass> <u:volume>1</u:volume>", "buoyancy", "it displaces 1 m3 and the box"),
    ],
)
def test_an_unlikely_object_is_warned_of_until_it_is_accepted(
    physics: str, warning: str, text: str, tmp_path: Path
) -> None:
    (found,) = said(physics, tmp_path)
    assert (found.severity, found.line) == ("warning", LINE)
    assert text in found.message
    assert found.message.endswith(f"<u:accept>{warning}</u:accept>")
    assert said(physics, tmp_path, accepts=f"<u:accept>{warning}</u:accept>") == []


@pytest.mark.parametrize(
    ("physics", "text"),
    [
        ("<mass>6</mass> <u:volume>1000</u:volume>", "expected less than 100 times the mass"),
        ("<mass>1e-13</mass>", "has 1e-13 kg and an inertia of 2.67e-15 kg m2"),
    ],
)
def test_an_object_that_no_simulation_bears_is_an_error_there_and_in_a_run(
    physics: str, text: str, tmp_path: Path
) -> None:
    (found,) = said(physics, tmp_path)
    assert (found.severity, found.line) == ("error", LINE)
    assert text in found.message
    with pytest.raises(SceneError, match="the object 'box' has"):
        open_scene(read_scene(tmp_path / "scene.xml"), is_blind=True)


def test_a_plain_object_is_not_asked_about(tmp_path: Path) -> None:
    within = "<mass>1</mass> <u:centreOfMass> <x>0.1</x> <y>0</y> <z>0</z> </u:centreOfMass>"
    assert said(within, tmp_path) == []
    assert said("<mass>1</mass> <u:volume>0.001</u:volume>", tmp_path) == []

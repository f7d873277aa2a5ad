"""Files that a scene names and that are nowhere are reported where the scene names them."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.opened import open_scene
from uwsim.checks import check_file
from uwsim.scene.reader import read_scene

DOCTYPE = '<!DOCTYPE UWSimScene SYSTEM "UWSimScene.dtd">'
PROJECTOR = """
    <structuredLightProjector> <name>{}</name> <relativeTo>part0</relativeTo> <fov>21</fov>
      <image_name>{}</image_name> </structuredLightProjector>"""


def said(folder: Path, *projectors: str, doctype: str = "") -> list[str]:
    file = folder / "scene.xml"
    file.write_text(
        f"{doctype}<UWSimScene> <vehicle>\n<name>v</name> <file>g500ARM5.urdf</file>"
        f"{''.join(projectors)}</vehicle> </UWSimScene>"
    )
    return [f"{each.severity} {each.line}: {each.message}" for each in check_file(file)]


def test_a_projector_whose_image_is_nowhere_is_reported(tmp_path: Path) -> None:
    lost = PROJECTOR.format("laser", "data/textures/laser_texture.png")
    message = "image 'data/textures/laser_texture.png' is not found: projector 'laser' has no"
    (error,) = said(tmp_path, lost)
    assert error.startswith(f"error 3: {message} effect; searched: ")
    (warning,) = said(tmp_path, lost, doctype=DOCTYPE)
    assert warning.startswith(f"warning 3: {message} effect; searched: ")
    with open_scene(read_scene(tmp_path / "scene.xml"), is_blind=True) as simulation:
        simulation.advance(0.01)  # as the original, without light


@pytest.mark.parametrize("doctype", ["", DOCTYPE])
def test_of_several_projectors_the_last_shines(tmp_path: Path, doctype: str) -> None:
    one, other = (PROJECTOR.format(name, "data/textures/white.png") for name in ("one", "other"))
    assert said(tmp_path, one, doctype=doctype) == []
    assert said(tmp_path, one, other, doctype=doctype) == [
        "warning 3: projector 'one' has no effect: only the last projector shines"
    ]

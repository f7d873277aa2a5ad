"""Values of bubbles and cameras without effect are warned of, with their line."""

from __future__ import annotations

from pathlib import Path

import pytest

from uwsim.checks import check_file

SCENE = """<UWSimScene xmlns:u="urn:uwsim:1"> <oceanState> <u:water law="physical">
<u:type>pool</u:type> <u:particles> <u:bubbles>
{bubbles}
</u:bubbles> </u:particles> </u:water> </oceanState>
<vehicle> <name>rov</name> <file>bluerov2_heavy.urdf</file>
<virtualCamera> <name>camera</name> <relativeTo>base_link</relativeTo>
<position> <x>0.4</x> <y>0</y> <z>0</z> </position>
<orientation> <r>0</r> <p>0</p> <y>0</y> </orientation>
{camera}
</virtualCamera> </vehicle> </UWSimScene>
"""
SOURCE = "<u:source> <x>0</x> <y>0</y> <z>-9</z> </u:source>"


def find_warnings(folder: Path, bubbles: str = "", camera: str = "") -> list[str]:
    """Return the warnings of values without effect."""
    path = folder / "scene.xml"
    path.write_text(SCENE.format(bubbles=bubbles, camera=camera))
    diagnostics = check_file(path)
    assert all(item.severity in ("note", "warning") for item in diagnostics)
    return [f"{item.line} {item.message}" for item in diagnostics if "no effect" in item.message]


@pytest.mark.parametrize(
    ("bubbles", "warning"),
    [
        (SOURCE + "<u:concentration>9</u:concentration>", "3 <u:concentration> has no effect: "),
        (SOURCE + "\n<u:depthScale>2</u:depthScale>", "4 <u:depthScale> has no effect: "),
        ("<u:rate>9</u:rate>", "3 <u:rate> has no effect without <u:source>"),
    ],
)
def test_bubbles_of_a_source_and_of_the_surface_at_once(
    tmp_path: Path, bubbles: str, warning: str
) -> None:
    (found,) = find_warnings(tmp_path, bubbles)
    assert found.startswith(warning)


@pytest.mark.parametrize(
    ("camera", "warning"),
    [
        (
            "<std>0.01</std> <u:response> </u:response>",
            "9 <std> has no effect: <u:response> replaces it; expected its noise in <u:readNoise>",
        ),
        (
            "<u:response> <u:vignetting>cos4</u:vignetting>\n<u:falloff>-0.3 0 0</u:falloff> "
            "</u:response>",
            "9 <u:vignetting> has no effect: <u:falloff> replaces it; expected one of the two",
        ),
    ],
)
def test_values_of_a_camera_that_its_response_replaces(
    tmp_path: Path, camera: str, warning: str
) -> None:
    assert find_warnings(tmp_path, camera=camera) == [warning]


@pytest.mark.parametrize(
    "bubbles", ["", SOURCE + "<u:rate>9</u:rate>", "<u:depthScale>2</u:depthScale>"]
)
@pytest.mark.parametrize(
    "camera", ["<std>0.01</std>", "<u:response> <u:falloff>-0.3 0 0</u:falloff> </u:response>"]
)
def test_values_that_have_an_effect_are_not_warned_of(
    tmp_path: Path, bubbles: str, camera: str
) -> None:
    assert find_warnings(tmp_path, bubbles, camera) == []

"""Water that would turn over, and densities that do not count, are warned of with their line."""

from __future__ import annotations

from pathlib import Path

import pytest

import uwsim
from uwsim.checks import check_file, model_warnings
from uwsim.errors import BadSetting
from uwsim.scene.reader import read_scene
from uwsim.scene.settings import apply_setting


def said(water: str, folder: Path) -> list[str]:
    path = folder / "scene.xml"
    path.write_text(
        f"<UWSimScene xmlns:u='urn:uwsim:1'>\n<oceanState>\n{water}</oceanState></UWSimScene>"
    )
    return [f"{each.line} {each.severity} {each.message}" for each in check_file(path)]


def profile(numbers: str, name: str = "density") -> str:
    return f"<u:profile> <u:depth>0 10 20</u:depth> <u:{name}>{numbers}</u:{name}> </u:profile>"


@pytest.mark.parametrize(
    ("water", "text"),
    [
        (profile("1020 1030 1010"), "3 warning <u:profile> has 1030 kg/m3 at 10 m and 1010 at 20"),
        (profile("5 5 20", "temperature"), "3 warning <u:profile> has 999."),
        (
            "<u:density>1025</u:density>\n<u:temperature>10</u:temperature>",
            "4 warning <u:temperature> affects sound only: <u:density> sets the density",
        ),
    ],
)
def test_doubtful_water_is_warned_of(water: str, text: str, tmp_path: Path) -> None:
    (found,) = said(water, tmp_path)
    assert found.startswith(text)


@pytest.mark.parametrize(
    "water",
    [
        profile("1020 1025 1025"),
        profile("20 10 5", "temperature"),
        "<u:density>1025</u:density>",
        "<u:temperature>10</u:temperature> <u:salinity>35</u:salinity>",
    ],
)
def test_water_that_lies_still_is_not(water: str, tmp_path: Path) -> None:
    assert said(water, tmp_path) == []


FUNCTION = (
    "<u:current>\n<u:pythonFunction> <u:function>my_eddy:eddy</u:function> </u:pythonFunction>"
)


@pytest.mark.parametrize(
    ("vehicle", "n"),
    [("", 0), ("<vehicle> <name>rov</name> <file>bluerov2_heavy.urdf</file> </vehicle>", 1)],
)
def test_a_current_that_python_computes_is_said_to_slow_down_what_floats_in_it(
    vehicle: str, n: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "my_eddy.py").write_text("raise RuntimeError\n")  # which is not run
    monkeypatch.syspath_prepend(tmp_path)
    constant = "<u:constant> <u:velocity> <x>1</x> <y>0</y> <z>0</z> </u:velocity> </u:constant>"
    path = tmp_path / "scene.xml"
    path.write_text(
        f"<UWSimScene xmlns:u='urn:uwsim:1'>\n<oceanState>\n{FUNCTION}\n{constant}\n</u:current>"
        f"</oceanState>{vehicle}</UWSimScene>"
    )
    found = [f"{each.line} {each.severity} {each.message}" for each in check_file(path)]
    slow = [text for text in found if "my_eddy" in text]
    assert len(slow) == n
    assert all(
        text.startswith("4 warning <u:function> is 'my_eddy:eddy': Python calls it in every step")
        for text in slow
    )


PHYSICAL = '<u:water law="physical"> <u:type>pool</u:type> </u:water>\n'


def test_fog_colour_and_attenuation_beside_physical_water_are_warned_of(tmp_path: Path) -> None:
    colour = "<r>0</r> <g>0</g> <b>0</b>"
    fog = f"<fog> <density>0.1</density> <color> {colour} </color> </fog>\n"
    rest = f"<color> {colour} </color>\n<attenuation> {colour} </attenuation>\n"
    assert said(fog + rest, tmp_path) == []
    reason = 'has no effect on images: <u:water law="physical"> replaces it'
    assert said(PHYSICAL + fog + rest, tmp_path) == [
        f"4 warning <fog> {reason}",
        f"5 warning <color> {reason}",
        f"6 warning <attenuation> {reason}",
    ]
    with uwsim.load(tmp_path / "scene.xml") as simulation:
        warnings = model_warnings(simulation.world.model)
    assert [warning.line for warning in warnings] == [4, 5, 6]


def test_a_variation_that_physical_water_replaces_is_warned_of(tmp_path: Path) -> None:
    vary = (
        "<u:vary> <u:uniform> <u:path>oceanState.fog.density</u:path> "
        "<u:low>0.1</u:low> <u:high>0.2</u:high> </u:uniform> </u:vary>"
    )
    path = tmp_path / "scene.xml"
    path.write_text(
        f"<UWSimScene xmlns:u='urn:uwsim:1'>\n<oceanState>{PHYSICAL}</oceanState>\n{vary}"
        "</UWSimScene>"
    )
    (found,) = check_file(path)
    assert (found.severity, found.line) == ("warning", 4)
    assert found.message.startswith("a variation of <fog> has no effect on images")


@pytest.mark.parametrize("name", ["fog.density", "color", "attenuation.r"])
def test_a_setting_that_physical_water_replaces_is_an_error(name: str, tmp_path: Path) -> None:
    said(PHYSICAL, tmp_path)
    scene = read_scene(tmp_path / "scene.xml")
    with pytest.raises(BadSetting, match="has no effect: the scene has physical water"):
        apply_setting(scene, f"oceanState.{name}", "0.5 0.5 0.5")
    said("", tmp_path)
    apply_setting(read_scene(tmp_path / "scene.xml"), "oceanState.fog.density", "0.5")


def test_a_depth_that_is_no_number_is_an_error_where_waves_use_it(tmp_path: Path) -> None:
    waves = (
        "<u:waves> <u:regularWave> <u:height>0.2</u:height> <u:period>3</u:period> "
        "</u:regularWave> </u:waves>"
    )
    found = said("<depth>inf</depth>", tmp_path)
    assert found[0].startswith("3 warning <depth> is 'inf'; expected a number [m]; it affects the")
    assert said(f"<depth>inf</depth> {waves}", tmp_path) == [
        "3 error <depth> is 'inf'; expected a number [m]"
    ]


LARGE_BUBBLES = "<u:particles> <u:bubbles> <u:minDiameter>0.01</u:minDiameter> </u:bubbles>"


@pytest.mark.parametrize(
    ("water", "lines"),
    [
        # a value that cannot be read hides no other error, and adds none that depends on it
        ("<u:exposure>0</u:exposure>\n<u:type>jerlov-1D</u:type>", [(4, "exposure"), (3, "1D")]),
        ("<u:exposure>0</u:exposure>\n<u:type>pool</u:type>", [(4, "exposure")]),
        ("<u:typ>pool</u:typ>\n<u:blur>1</u:blur>", [(4, "<u:typ>")]),
        (
            f"<u:typ>pool</u:typ>\n{LARGE_BUBBLES} </u:particles>\n<u:blur>1</u:blur>",
            [(4, "<u:typ>"), (5, "has diameters")],
        ),
        (
            "<u:type>pool</u:type>\n<u:phaseFunction>\n<u:henyey/>\n</u:phaseFunction>",
            [(6, "<u:henyey>")],
        ),
    ],
)
def test_errors_of_a_water_are_reported_beside_values_that_cannot_be_read(
    water: str, lines: list[tuple[int, str]], tmp_path: Path
) -> None:
    found = said(f'<u:water law="physical">\n{water}\n</u:water>', tmp_path)
    assert len(found) == len(lines)
    for text, (line, part) in zip(found, lines, strict=True):
        assert text.startswith(f"{line} error ")
        assert part in text


def test_the_water_of_a_scene_without_vehicles_is_checked(tmp_path: Path) -> None:
    (found,) = said('<u:water law="physical"> <u:type>jerlov-1D</u:type> </u:water>', tmp_path)
    assert found.startswith("3 error No water is called 'jerlov-1D'. Did you mean 'jerlov-1C'?")

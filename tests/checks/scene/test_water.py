"""Water that would turn over, and densities that do not count, are warned of with their line."""

from __future__ import annotations

from pathlib import Path

import pytest

from uwsim.checks import check_file


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

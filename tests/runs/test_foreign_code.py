"""Python code that files name: `check` never runs it; what does says so, or refuses."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from uwsim.cli import main

MODULE = "water_with_a_trap"
SCENE = f"""<UWSimScene xmlns:u="urn:uwsim:1">
<oceanState><u:current><u:pythonFunction>
<u:function>{MODULE}:eddy</u:function></u:pythonFunction></u:current></oceanState>
<vehicle><name>v</name><file>g500ARM5.urdf</file><virtualCamera><name>c</name>
<relativeTo>part0</relativeTo><resw>16</resw><resh>12</resh></virtualCamera></vehicle>
</UWSimScene>"""
BENCHMARK = """<benchmark xmlns:u="urn:uwsim:1" u:scene="scene.xml"{}>
<measures><time><name>t</name><startOn><type>onInit</type></startOn>
<stopOn><type>never</type></stopOn></time></measures>
<startOn><type>onInit</type></startOn><stopOn><type>never</type></stopOn>
<function>t</function><sceneUpdater><none/></sceneUpdater></benchmark>"""
LOOKING = ["--scene", "visibility-scene", "--over", "fog", "--until", "t"]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Lay out a scene and benchmarks whose code leaves a mark when it runs."""
    mark = str(tmp_path / "ran")
    code = f"""open({mark!r}, "w").close()
def eddy(point, time, vehicle):
    return 0, 0, 0
class Tracker:
    def start(self, node): ...
"""
    (tmp_path / f"{MODULE}.py").write_text(code)
    (tmp_path / "scene.xml").write_text(SCENE)
    (tmp_path / "still.xml").write_text(SCENE.replace("u:pythonFunction", "u:none"))
    (tmp_path / "benchmark.xml").write_text(BENCHMARK.format(""))
    tracked = BENCHMARK.format(f' u:algorithm="{MODULE}:Tracker"')
    (tmp_path / "tracked.xml").write_text(tracked)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.chdir(tmp_path)
    yield tmp_path
    sys.modules.pop(MODULE, None)


@pytest.mark.parametrize(
    "words", [["check", "scene.xml"], ["check", "benchmark.xml"], ["info", "scene.xml"]]
)
def test_what_only_looks_runs_no_code(
    words: list[str], folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    status = main(words)
    assert status == 0, capsys.readouterr()
    assert MODULE not in sys.modules
    assert not (folder / "ran").exists()


def test_check_says_that_a_module_is_not_there(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / f"{MODULE}.py").unlink()
    assert main(["check", "benchmark.xml"]) == 2
    assert f"there is no module '{MODULE}' on Python's path" in capsys.readouterr().out


def test_render_says_which_code_runs(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["render", "scene.xml", "-o", "view.png"]) == 0
    assert capsys.readouterr().err == (
        f"uwsim: {folder}/scene.xml runs Python code: {MODULE}:eddy in {folder}/{MODULE}.py "
        "(--no-code refuses it)\n"
    ).replace(f"{folder}/scene.xml", "scene.xml")
    assert (folder / "ran").exists()


@pytest.mark.parametrize(
    ("words", "code"),
    [
        (["render", "scene.xml", "-o", "view.png"], "eddy"),
        (["bench", "benchmark.xml", "--algorithm", "frozen"], "eddy"),
        (["bench", "tracked.xml", "--scene", "visibility-scene"], "Tracker"),
        (["envelope", "tracked.xml", *LOOKING], "Tracker"),
    ],
)  # fmt: skip
def test_no_code_refuses_files_that_name_code(
    words: list[str], code: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*words, "--no-code"]) == 2
    said = capsys.readouterr().err
    assert f"names the Python code '{MODULE}:{code}', which --no-code refuses." in said
    assert not (folder / "ran").exists()


def test_an_algorithm_that_a_benchmark_names_is_reported(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["bench", "tracked.xml", "--scene", "visibility-scene", "--level", "nothing=1"]
    assert main(words) == 2
    said = capsys.readouterr().err
    assert f"tracked.xml runs Python code: {MODULE}:Tracker in {folder}/{MODULE}.py" in said


def test_an_algorithm_that_the_user_types_is_the_users(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["bench", "benchmark.xml", "--scene", "visibility-scene", "--level", "nothing=1"]
    assert main([*words, "--algorithm", f"{MODULE}:Tracker", "--no-code"]) == 2
    said = capsys.readouterr().err
    assert "Python code" not in said

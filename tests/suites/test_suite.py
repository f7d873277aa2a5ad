"""A suite file gives tasks, tracks and seeds; all its errors come at once."""

from __future__ import annotations

from pathlib import Path

import pytest

from uwsim.algorithms import ALGORITHMS
from uwsim.assets.bundled import bundled_files
from uwsim.benchmark.reader import read_benchmark
from uwsim.benchmark.updaters import levels
from uwsim.cli import main
from uwsim.errors import AssetNotFound, BadSetting, SeveralErrors, UnknownName
from uwsim.runs.planning.plan import chosen_levels
from uwsim.suites.entry import check_settings, choose_algorithms, read_levels
from uwsim.suites.suite import Suite, SuiteError, find_suite, read_suite

SUITE = """<suite>
  <name>small</name>
  <split> <name>validation</name> <count>4</count> </split>
  <track> <name>a</name> <source>virtualCamera</source> </track>
  <track> <name>c</name> </track>
  <task>
    <name>station-v1</name> <benchmark>station-keeping</benchmark>
    <level>current=0.2</level> <failure>missed</failure>
    <baseline>position-p</baseline> <hash>sha256:HASH</hash>
  </task>
  <task>
    <name>circle-v2</name> <benchmark>circle</benchmark> <baseline>position-pi</baseline>
  </task>
</suite>
""".replace("HASH", "0" * 64)


def write(folder: Path, text: str = SUITE) -> Path:
    path = folder / "small.xml"
    path.write_text(text)
    return path


@pytest.fixture
def suite(tmp_path: Path) -> Suite:
    return read_suite(write(tmp_path))


def test_a_task_is_found_with_and_without_its_version(suite: Suite) -> None:
    assert suite.task("station").benchmark == suite.task("station-v1").benchmark
    with pytest.raises(UnknownName, match="circle-v2"):
        suite.task("circle-v1")


def test_a_track_without_sources_permits_all(suite: Suite) -> None:
    assert suite.track("c").rule is None
    rule = suite.track("A").rule
    assert rule is not None
    assert rule.sources == ("virtualCamera",)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("station-v1", "station", "station-v1"),
        ("station-v1", "Station-v1", "small letters"),
        ("virtualCamera", "virtualCamra", "virtualCamera"),
        ("position-p", "position-q", "position-p"),
        ("station-keeping", "station-keepin", "station-keeping"),
        ("circle-v2", "station-v1", "twice"),
        ("<count>4</count>", "<count>0</count>", "count"),
        ("<name>validation</name>", "<name>test</name>", "date"),
        ("<count>4", "<first>2147483645</first><count>4", "ends with the seed 2147483648"),
        ("<failure>missed", "<failure>mised", "no status 'mised'.*'missed'"),
        ("<failure>missed", "<failure>missed</failure> <failure>missed", "'missed' is given twice"),
        ("current=0.2", "curent=0.2", "'curent' is not swept by station-keeping.*'current'"),
        ("current=0.2", "current=0.21", "the nearest is current=0.2"),
        ("current=0.2", "current=1e999", "expected NAME=VALUE"),
        ("current=0.2", "current=e", "expected NAME=VALUE"),
        ("sha256:0", "sha256:", "64 digits"),
        ("<baseline>position-pi</baseline>", "", "has no <baseline>"),
        ("<baseline>position-p</baseline>", "<baseline>pi</baseline>" * 2, "'pi' is given twice"),
        ("circle-v2", "station-v2", "several versions"),
    ],
)
def test_an_error_names_the_line_and_what_is_expected(
    tmp_path: Path, old: str, new: str, message: str
) -> None:
    text = SUITE.replace(old, new)
    with pytest.raises(SuiteError, match=message) as error:
        read_suite(write(tmp_path, text))
    assert f"small.xml:{text[: text.index(new)].count(chr(10)) + 1}" in str(error.value) or (
        "small.xml:" in str(error.value)
    )


def test_all_errors_come_at_once(tmp_path: Path) -> None:
    text = SUITE.replace("virtualCamera", "camera").replace("position-p", "nobody")
    with pytest.raises(SuiteError) as error:
        read_suite(write(tmp_path, text))
    assert len(str(error.value).splitlines()) == 3


def test_check_knows_suite_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = write(tmp_path)
    assert main(["check", str(path)]) == 0
    assert "no errors" in capsys.readouterr().out
    write(tmp_path, SUITE.replace("missed", "mised"))
    assert main(["check", str(path)]) == 2
    assert "small.xml:6: <failure>" in capsys.readouterr().out


def test_a_suite_that_does_not_exist_has_an_error_with_the_nearest_name() -> None:
    with pytest.raises(AssetNotFound, match="Did you mean 'intervention'"):
        find_suite("interventon")


@pytest.mark.parametrize("name", bundled_files("suites"))
def test_a_bundled_suite_is_valid(name: str) -> None:
    spec = read_suite(find_suite(name)).spec
    assert spec.name == name
    assert [track.name for track in spec.tracks] == ["a", "b", "c"]
    assert set(spec.tracks[0].sources) < set(spec.tracks[1].sources)
    names = {name for task in spec.tasks for name in (*task.baselines, task.control)}
    assert names - {None} <= set(ALGORITHMS)
    assert all(
        len(task.baselines) >= 2 and task.control and task.description for task in spec.tasks
    )


@pytest.mark.parametrize("name", bundled_files("suites"))
def test_the_levels_of_a_task_are_those_of_its_benchmark(name: str) -> None:
    for task in read_suite(find_suite(name)).spec.tasks:
        spec = read_benchmark(bundled_files("benchmarks")[task.benchmark])
        assert chosen_levels(levels(spec.scene_updater), read_levels(task))


def test_an_algorithm_is_for_all_tasks_or_for_one(suite: Suite) -> None:
    assert choose_algorithms(suite, ["pi", "circle=p"], []) == {
        "station-v1": "pi",
        "circle-v2": "p",
    }
    assert choose_algorithms(suite, ["station=pi"], []) == {"station-v1": "pi"}
    assert choose_algorithms(suite, ["a/b=c.py:P"], ["circle"]) == {"circle-v2": "a/b=c.py:P"}


@pytest.mark.parametrize(
    ("words", "tasks", "message"),
    [
        (["pi"], ["stat"], "station-v1"),
        (["pi", "p"], [], "one algorithm"),
        (["station=pi"], ["circle"], "circle-v2 has no algorithm"),
    ],
)
def test_a_wrong_choice_has_an_error(
    suite: Suite, words: list[str], tasks: list[str], message: str
) -> None:
    with pytest.raises((UnknownName, BadSetting, SeveralErrors), match=message):
        choose_algorithms(suite, words, tasks)


def test_a_setting_of_the_scene_is_refused() -> None:
    check_settings(["algorithm.kp=1"])
    with pytest.raises(BadSetting, match="the task itself is fixed"):
        check_settings(["oceanState.fog.density=0"])

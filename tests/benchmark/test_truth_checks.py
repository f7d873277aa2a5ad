"""A recorded truth against the measures that read it, and against its images."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.bags import IMAGE, INFO, sample_pixels, write_bag
from uwsim.cli import main

BENCHMARK = f"""<benchmark xmlns:u="urn:uwsim:1" u:scene="visibility-scene.xml">
  <measures>
    <euclideanNorm u:value="mean"> <name>corners</name>
      <groundTruth type="topic">
        <topic>/truth/corners</topic>
        <components>COMPONENTS</components>
      </groundTruth>
      <target>estimate</target>
    </euclideanNorm>
  </measures>
  <startOn><type>onInit</type></startOn> <stopOn><type>never</type></stopOn>
  <function>corners</function>
  <sceneUpdater>
    <bagFogUpdater>
      <initialValue>0</initialValue> <finalValue>0.5</finalValue> <step>0.5</step>
      <interval>1</interval>
      <bag>dive.bag</bag> <imageTopic>{IMAGE}</imageTopic> <infoTopic>{INFO}</infoTopic>
      <imageDepth>2</imageDepth>
      <u:truth> <u:file>corners.csv</u:file> <u:topic>truth/corners</u:topic> </u:truth>
    </bagFogUpdater>
  </sceneUpdater>
</benchmark>
"""
ALL = "time,u,v\n0,1,10\n0.25,6,60\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    times = (0.0, 0.1, 0.25)
    write_bag(tmp_path, "ros1", [(time, sample_pixels(i)) for i, time in enumerate(times)])
    return tmp_path


def check(folder: Path, csv: str, components: str = "u v") -> tuple[int, Path]:
    (folder / "corners.csv").write_text(csv)
    path = folder / "benchmark.xml"
    path.write_text(BENCHMARK.replace("COMPONENTS", components))
    return main(["check", str(path)]), path


def test_a_truth_of_all_images_has_no_remark(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert check(folder, ALL)[0] == 0
    captured = capsys.readouterr()
    assert "warning" not in captured.out + captured.err


@pytest.mark.parametrize(
    ("csv", "span"),
    [
        ("time,u,v\n0,1,10\n0.15,4,40\n", "0 s to 0.15 s"),
        ("time,u,v\n0.05,1,10\n0.3,4,40\n", "0.05 s to 0.3 s"),
    ],
)
def test_a_truth_of_a_part_is_a_warning(
    folder: Path, capsys: pytest.CaptureFixture[str], csv: str, span: str
) -> None:
    assert check(folder, csv)[0] == 0
    captured = capsys.readouterr()
    said = captured.out + captured.err
    assert f":19: warning: the truth is from {span}, the recording from" in said


@pytest.mark.parametrize(
    ("csv", "components", "message"),
    [
        (ALL, "u", ":6: <components> names 1 of the numbers on '/truth/corners'; corners.csv "),
        ("time,u\n0,1\n0.25,2\n", "u v", "publishes 1: u"),
        ("time,u,v\n1.7e9,1,10\n1.7e9,6,60\n", "u v", "does not increase"),
        (
            "time,u,v\n1.7e9,1,10\n1.8e9,6,60\n",
            "u v",
            ":19: corners.csv: its times, 1.7e+09 s to 1.8e+09 s, are outside the recording",
        ),
    ],
)
def test_a_truth_that_cannot_be_scored_is_an_error_of_check_and_of_bench(
    folder: Path, capsys: pytest.CaptureFixture[str], csv: str, components: str, message: str
) -> None:
    code, path = check(folder, csv, components)
    assert code == 2
    captured = capsys.readouterr()
    assert message in captured.out + captured.err
    out = folder / "a.result"
    assert main(["bench", str(path), "--algorithm", "frozen", "--out", str(out)]) == 2
    captured = capsys.readouterr()
    assert message in captured.err
    assert not out.exists()

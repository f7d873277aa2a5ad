"""``scripted``: what original benchmarks wait for is done, level after level."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from uwsim.algorithms.scripted import ScriptedPilot, parse_twist
from uwsim.assets.bundled import bundled_files
from uwsim.benchmark.reader import read_benchmark
from uwsim.errors import BadSetting, NeverStarted
from uwsim.runs.planning.plan import AlgorithmUnderTest, Plan
from uwsim.runs.trial.level_row import LevelRow
from uwsim.runs.trial.trial import execute
from uwsim.scene.reader import read_scene
from uwsim.topics.ros_odom_to_pat import ROSOdomToPATSpec
from uwsim.topics.ros_twist_to_pat import ROSTwistToPATSpec

DISTANCE = """<distance> <name>way</name> <target>girona500</target>
  <startOn> {gate} </startOn> <stopOn> <type>never</type> </stopOn> </distance>"""
FILE = """<benchmark> <measures> {measure} </measures>
  <startOn> <type>service</type> <target>startBench</target> </startOn>
  <stopOn> {stop} </stopOn>
  <function>way</function>
  <sceneUpdater> {updater} </sceneUpdater> </benchmark>"""
REPEAT = "<repeat> <iterations>3</iterations> <interval>2</interval> </repeat>"
ON_INIT = "<type>onInit</type>"
STOP = "<type>service</type> <target>stopBench</target>"
DRIVE = {"twist_topic": "/twist", "twist": "0.5 0 0 0 0 0"}


def rows(
    tmp_path: Path,
    *,
    gate: str = ON_INIT,
    stop: str = STOP,
    updater: str = "<none/>",
    **given: object,
) -> list[LevelRow]:
    file = tmp_path / "benchmark.xml"
    file.write_text(FILE.format(measure=DISTANCE.format(gate=gate), stop=stop, updater=updater))
    scene = read_scene(bundled_files("scenes")["visibility-scene"])
    twist = ROSTwistToPATSpec(topic="/twist", vehicle_name="girona500")
    odometry = ROSOdomToPATSpec(topic="/odom", vehicle_name="girona500")
    plan = Plan(
        benchmark=read_benchmark(file),
        scene=replace(scene, ros_interfaces=(twist, odometry)),
        algorithm=AlgorithmUnderTest(
            cls=ScriptedPilot,
            name="scripted",
            parameters=given,  # type: ignore[arg-type]
        ),
        is_blind=True,
    )
    return [
        row for trial in plan.trials() for row in execute(plan, trial) if isinstance(row, LevelRow)
    ]


@pytest.mark.parametrize(("drive", "topic"), [("twist_topic", "/twist"), ("odom_topic", "/odom")])
def test_a_task_lasts_from_its_start_to_its_stop(tmp_path: Path, drive: str, topic: str) -> None:
    [row] = rows(tmp_path, stop_after=1.0, **{drive: topic}, twist=DRIVE["twist"])
    assert (row.status, row.duration) == ("ok", 1.0)
    assert row.total == pytest.approx(0.45)  # nine jumps of 0.05 m


def test_it_waits_before_it_starts(tmp_path: Path) -> None:
    [row] = rows(tmp_path, start_after=0.4, stop_after=1.0)
    assert row.duration == pytest.approx(0.6)


def test_every_level_is_started_and_stopped(tmp_path: Path) -> None:
    played = rows(tmp_path, updater=REPEAT, stop_after=1.0, **DRIVE)
    assert [row.status for row in played] == ["ok"] * 3
    assert [row.duration for row in played] == pytest.approx([1.0] * 3, abs=0.01)


def test_a_measure_that_waits_for_a_topic_begins_in_every_level(tmp_path: Path) -> None:
    gate = "<type>topic</type> <target>/go</target>"
    never = "<type>never</type>"
    played = rows(tmp_path, gate=gate, stop=never, updater=REPEAT, start_topics="/go", **DRIVE)
    assert all(row.total is not None and row.total > 0.8 for row in played)


def test_without_its_call_nothing_starts(tmp_path: Path) -> None:
    with pytest.raises(NeverStarted, match="startBench"):
        rows(tmp_path, start="somebodyElse")


@pytest.mark.parametrize("text", ["", "1 2 3", "0 0 0 0 0 nan", "a b c d e f"])
def test_a_twist_is_six_numbers(text: str) -> None:
    with pytest.raises(BadSetting, match="expected six numbers"):
        parse_twist(text)

"""Replays and films of levels that set a number of the scene (u:settingUpdater)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.support.packs import unpack
from tests.support.short_benchmark import run
from uwsim.viewer.film.film import FilmSpec, TrialSequenceFilm
from uwsim.viewer.recorded import RecordedTrial
from uwsim.viewer.replay import Replay

pytestmark = pytest.mark.slow
SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <object> <name>terrain</name> <file>objects/box.osg</file>
    <position> <x>0</x> <y>0</y> <z>-2</z> </position>
    <scaleFactor> <x>40</x> <y>40</y> <z>1</z> </scaleFactor>
  </object>
  <object> <name>cable</name> <file>objects/box.osg</file>
    <position> <x>0</x> <y>0</y> <z>0</z> </position>
    <scaleFactor> <x>0.1</x> <y>0.6</y> <z>0.6</z> </scaleFactor>
    <u:onFloor> <u:clearance>0.05</u:clearance> </u:onFloor>
    <u:course> <u:points> -4 0 0  4 0 0 </u:points> <u:bendRadius>1</u:bendRadius>
      <u:buriedStretches>1</u:buriedStretches> </u:course>
  </object>
</UWSimScene>
"""
BENCHMARK = """<benchmark xmlns:u="urn:uwsim:1" u:scene="scene.xml" u:mode="independent"
    u:algorithm="nothing" u:prelude="false">
  <measures> <time> <name>time</name> <startOn> <type>onInit</type> </startOn>
    <stopOn> <type>never</type> </stopOn> </time> </measures>
  <startOn> <type>onInit</type> </startOn> <stopOn> <type>never</type> </stopOn>
  <function>time</function>
  <sceneUpdater> <u:settingUpdater u:column="buried"> <path>object[cable].course.buriedShare</path>
    <initialValue>0</initialValue> <finalValue>0.8</finalValue> <step>0.8</step>
    <interval>0.1</interval> </u:settingUpdater> </sceneUpdater>
</benchmark>
"""


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A result with two levels: a cable on the floor, and one that is buried by 80 %."""
    folder = tmp_path_factory.mktemp("levels")
    (folder / "scene.xml").write_text(SCENE)
    (folder / "benchmark.xml").write_text(BENCHMARK)
    run(folder / "benchmark.xml", folder / "result")
    return folder / "result"


def test_a_recorded_trial_has_the_scene_of_its_level(result: Path) -> None:
    trials = [RecordedTrial.open(result, index) for index in (0, 1)]
    courses = [trial.scene.objects[1].course for trial in trials]
    assert [course and course.buried_share for course in courses] == [0.0, 0.8]
    assert trials[1].level_settings == (("object[cable].course.buriedShare", 0.8),)


def test_a_replay_has_the_meshes_of_each_level(result: Path) -> None:
    head, _ = unpack(Replay(result).pack())
    whole = next(body["visuals"] for body in head["bodies"] if body["name"] == "cable")
    first, second = head["trials"]
    assert first["visuals"] == {}
    assert list(second["visuals"]) == ["cable"]  # the terrain is that of the first level
    meshes = [visuals[0]["mesh"] for visuals in (whole, second["visuals"]["cable"])]
    assert meshes[0] != meshes[1]
    buried, one = _replay_of(result, 1), _replay_of(result, 0)
    assert len(head["meshes"]) == len(one["meshes"]) + 1
    assert buried["trials"][0]["visuals"] == {}


def test_a_film_of_all_levels_draws_the_scene_of_each(result: Path) -> None:
    trials = [RecordedTrial.open(result, index) for index in (0, 1)]
    spec = FilmSpec(size=(160, 160), rate=10.0, view="fixed", has_curves=False)
    film = TrialSequenceFilm(trials, spec)
    images = [film.draw(index).copy() for index in (0, film.n_frames - 1, 0)]
    film.close()
    only_second = TrialSequenceFilm(trials[1:], spec)
    last_image = only_second.draw(only_second.n_frames - 1)
    only_second.close()
    assert (images[0] != images[1]).any(axis=-1).mean() > 0.01
    np.testing.assert_array_equal(images[0], images[2])
    np.testing.assert_array_equal(images[1], last_image)


def _replay_of(result: Path, trial: int) -> dict[str, Any]:
    head, _ = unpack(Replay(result, (trial,)).pack())
    return head

"""BenchmarkInfo and BenchmarkResults, as an observer of the run hears them."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest

from tests.support.short_trial import make_plan, rows_of
from uwsim.bus import Node
from uwsim.messages import Float32MultiArray, String
from uwsim.runs.trial import trial
from uwsim.simulation import Simulation

NESTED = """<repeat> <iterations>2</iterations> <interval>9</interval> <sceneUpdater>
<sceneFogUpdater>
  <initialValue>0</initialValue> <finalValue>0.5</finalValue> <step>0.5</step>
  <interval>1</interval>
</sceneFogUpdater> </sceneUpdater> </repeat>"""
TIME_AND_WAY = """<distance> <name>way</name> <target>girona500</target> </distance>
<positionError> <name>place</name> <target>girona500</target>
  <position> <x>2</x> <y>0</y> <z>2</z> </position> </positionError>"""


class Listens(Simulation):
    """A simulation with an observer, who writes down when it hears what."""

    info: ClassVar[list[tuple[float, str]]]
    results: ClassVar[list[tuple[float, np.ndarray]]]

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        Listens.info, Listens.results = [], []
        self.bus.subscribe(
            "/BenchmarkInfo", String, lambda said: self.info.append((self.time, said.data))
        )
        self.bus.subscribe(
            "BenchmarkResults",
            Float32MultiArray,
            lambda said: self.results.append((self.time, said.data.copy())),
        )


@pytest.fixture
def observed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(trial, "Simulation", Listens)


class Deaf:
    """Subscribes to nothing."""

    def start(self, node: Node) -> None:
        pass


class Spies:
    """An algorithm that wants to hear how good it is, or to say so itself."""

    wants = "hear"

    def start(self, node: Node) -> None:
        if self.wants == "hear":
            node.subscribe("/BenchmarkResults", Float32MultiArray, print)
        else:
            node.publisher("BenchmarkResults", Float32MultiArray)


@pytest.mark.parametrize("wants", ["hear", "say"])
def test_results_are_kept_from_the_algorithm_under_test(
    tmp_path: Path, wants: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Spies, "wants", wants)
    function = '<function publishResult="true">t</function>'
    row = rows_of(make_plan(tmp_path, Spies, NESTED, function=function))[0]
    assert row.status == "algorithm error"
    assert "BenchmarkResults' is for observers of the run" in row.missing_reasons["total"]


@pytest.mark.usefixtures("observed")
def test_info_comes_ten_times_a_second_and_names_the_outermost_updater_that_stepped(
    tmp_path: Path,
) -> None:
    rows_of(make_plan(tmp_path, Deaf, NESTED))
    assert [time for time, _ in Listens.info] == pytest.approx([0.1 * i for i in range(41)])
    said = {round(time, 3): text for time, text in Listens.info if text}
    assert said == {1.1: "Updated scene 2", 2.1: "Updated scene 1", 3.1: "Updated scene 2"}
    assert Listens.results == []


@pytest.mark.usefixtures("observed")
def test_an_independent_level_hears_of_its_own_scene_once(tmp_path: Path) -> None:
    plan = make_plan(tmp_path, Deaf, NESTED, mode="independent")
    for one, expected in zip(
        plan.trials(), ([], ["Updated scene 2"], ["Updated scene 1"], ["Updated scene 1"]),
        strict=True,
    ):  # fmt: skip
        list(trial.execute(plan, one))
        assert [text for _, text in Listens.info if text] == expected


@pytest.mark.usefixtures("observed")
def test_results_are_levels_time_details_and_total(tmp_path: Path) -> None:
    function = '<function publishResult="true">way+place</function>'
    plan = make_plan(tmp_path, Deaf, NESTED, measures=TIME_AND_WAY, function=function)
    rows_of(plan)
    entries = [entry for _, entry in Listens.results if len(entry)]
    assert {len(entry) for entry in entries} == {2 + 1 + 1 + 8 + 1}
    times = np.array([entry[2] for entry in entries])
    assert np.diff(times) == pytest.approx(0.1, abs=0.003)  # publishRate is 0.1 s unless given
    last = entries[-1]
    assert last[:2] == pytest.approx([1.0, 0.5])
    assert last[3] == pytest.approx(0.0)  # way
    error = math.hypot(0.515, 0.0)  # the vehicle stands at (2, 0, 2.515)
    assert last[4] == pytest.approx(error)
    assert last[5:8] == pytest.approx([0.0, 0.0, 0.515], abs=1e-6)
    assert np.linalg.norm(last[8:12]) == pytest.approx(1.0)
    assert last[12] == pytest.approx(error)


@pytest.mark.usefixtures("observed")
def test_publish_rate_is_the_shortest_time_between_entries_and_empty_messages_fill_it(
    tmp_path: Path,
) -> None:
    function = '<function publishResult="true" publishRate="0.5">t</function>'
    rows_of(make_plan(tmp_path, Deaf, NESTED, function=function))
    filled = [time for time, entry in Listens.results if len(entry)]
    assert len(Listens.results) == 41
    assert np.diff(filled) == pytest.approx(0.5, abs=0.11)
    assert len(filled) == 8
    assert {len(entry) for _, entry in Listens.results} == {0, 5}


@pytest.mark.usefixtures("observed")
def test_entries_that_come_quicker_than_messages_share_one(tmp_path: Path) -> None:
    function = '<function publishResult="true" publishRate="0.02">t</function>'
    rows_of(make_plan(tmp_path, Deaf, NESTED, function=function))
    sizes = [len(entry) for _, entry in Listens.results[1:]]
    assert set(sizes) == {25}  # five entries of level, level, time, t, total
    entry = Listens.results[1][1].reshape(5, 5)
    assert np.diff(entry[:, 2]) == pytest.approx(0.02)


@pytest.mark.usefixtures("observed")
def test_without_a_value_there_is_no_entry(tmp_path: Path) -> None:
    waiting = """<euclideanNorm> <name>off</name>
      <groundTruth type="constant"> <value>1</value> </groundTruth>
      <target>nothing</target> </euclideanNorm>"""
    function = '<function publishResult="true">1</function>'
    rows_of(make_plan(tmp_path, Deaf, NESTED, measures=waiting, function=function))
    assert {len(entry) for _, entry in Listens.results} == {0}
    undefined = '<function publishResult="true">ln(t-t)</function>'
    rows_of(make_plan(tmp_path, Deaf, NESTED, function=undefined))
    assert {len(entry) for _, entry in Listens.results} == {0}


def test_listening_changes_nothing_in_the_result(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    function = '<function publishResult="true">way+place</function>'
    plan = make_plan(tmp_path, Deaf, NESTED, measures=TIME_AND_WAY, function=function)
    rows = rows_of(plan)
    monkeypatch.setattr(trial, "Simulation", Listens)
    assert rows_of(plan) == rows
    assert any(len(entry) for _, entry in Listens.results)


def test_nothing_is_computed_for_topics_that_nobody_reads(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from uwsim.runs.trial import live_topics

    monkeypatch.setattr(live_topics, "details", None)
    function = '<function publishResult="true">t</function>'
    assert len(rows_of(make_plan(tmp_path, Deaf, NESTED, function=function))) == 4


class RemembersFog(Simulation):
    """A simulation that notes the fog of its first image."""

    first: ClassVar[list[float]] = []

    def advance(self, seconds: float | None = None) -> None:
        if seconds == 0.0:  # the samples of step 0
            self.first.append(self.world.scenery.state.water.fog)
        super().advance(seconds)


@pytest.mark.parametrize(("prelude", "expected"), [(True, 0.0), (False, 0.5)])
def test_an_independent_level_without_prelude_has_its_fog_from_the_first_image_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, prelude: bool, expected: float
) -> None:
    monkeypatch.setattr(trial, "Simulation", RemembersFog)
    monkeypatch.setattr(RemembersFog, "first", [])
    plan = make_plan(tmp_path, Deaf, NESTED, mode="independent")
    plan = replace(plan, benchmark=replace(plan.benchmark, prelude=prelude))
    second = plan.trials()[1]
    assert dict(second.levels[0].values)["fog"] == 0.5
    [row, *_] = trial.execute(plan, second)
    assert RemembersFog.first == [expected]
    assert row.status == "ok"

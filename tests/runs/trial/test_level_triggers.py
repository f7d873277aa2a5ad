"""The benchmark's startOn and stopOn, which begin and end levels."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.short_trial import NEVER_TRIGGER, make_plan, rows_of
from uwsim.base.compatibility import COMPATIBILITY
from uwsim.bus import Node
from uwsim.errors import NeverStarted
from uwsim.messages import Bool, Empty, Image, String

REPEAT = "<repeat> <iterations>3</iterations> <interval>1</interval> </repeat>"
FOG = """<sceneFogUpdater>
  <initialValue>0</initialValue> <finalValue>0.2</finalValue> <step>0.1</step>
  <interval>1</interval>
</sceneFogUpdater>"""
START = "<type>service</type> <target>startBench</target>"
STOP = "<type>service</type> <target>stopBench</target>"
READY = "<type>topic</type> <target>ready</target>"
DONE = "<type>topic</type> <target>done</target>"


class Idle:
    """Does nothing at all."""

    def start(self, node: Node) -> None:
        pass


class Timetable:
    """Does something at each of a few times."""

    DO: dict[float, object]

    def start(self, node: Node) -> None:
        self.node = node
        self.done: set[float] = set()
        self.ready = node.publisher("ready", Bool)
        self.stop = node.publisher("done", Bool)
        node.create_timer(0.01, self.look)

    def look(self) -> None:
        for time, what in self.DO.items():
            if self.node.now > time - 1e-6 and time not in self.done:
                self.done.add(time)
                if isinstance(what, str):
                    self.node.call(what, Empty())
                elif isinstance(what, bool):
                    self.ready(Bool(data=what))
                else:
                    self.stop(Bool(data=True))


def timetable(**do: object) -> type[Timetable]:
    times = {float(key.strip("_").replace("_", ".")): what for key, what in do.items()}
    return type("Made", (Timetable,), {"DO": times})


def test_a_service_stops_one_level_and_no_more(tmp_path: Path) -> None:
    algorithm = timetable(_0_3="stopBench", _1_5="stopBench")
    rows = rows_of(make_plan(tmp_path, algorithm, REPEAT, stop=STOP))
    assert [row.duration for row in rows] == pytest.approx([0.3, 1.0, 0.2], abs=0.003)
    assert [row.status for row in rows] == ["ok"] * 3


def test_a_topic_stops_one_level_and_no_more(tmp_path: Path) -> None:
    rows = rows_of(make_plan(tmp_path, timetable(_0_3=None), REPEAT, stop=DONE))
    assert [row.duration for row in rows] == pytest.approx([0.3, 1.0, 1.0], abs=0.003)


def test_a_task_without_an_interval_ends_with_its_stop(tmp_path: Path) -> None:
    plan = make_plan(
        tmp_path, timetable(_0_1="startBench", _0_6="stopBench"), "<none/>", start=START, stop=STOP
    )
    (row,) = rows_of(plan)
    assert (row.status, row.duration) == ("ok", pytest.approx(0.5, abs=0.003))


def test_a_start_by_service_holds_for_all_levels(tmp_path: Path) -> None:
    rows = rows_of(make_plan(tmp_path, timetable(_0_2="startBench"), REPEAT, start=START))
    assert [row.duration for row in rows] == pytest.approx([1.0, 1.0, 1.0])
    assert [row.ended_at for row in rows] == pytest.approx([1.2, 2.2, 3.2], abs=0.003)


def test_a_start_by_topic_that_goes_off_ends_the_level_and_the_next_one_waits(
    tmp_path: Path,
) -> None:
    algorithm = timetable(_0_2=True, _0_7=False, _2=True)
    rows = rows_of(make_plan(tmp_path, algorithm, REPEAT, start=READY))
    assert [row.duration for row in rows] == pytest.approx([0.5, 1.0, 1.0], abs=0.003)
    assert [row.ended_at for row in rows] == pytest.approx([0.7, 3.0, 4.0], abs=0.003)


def test_a_level_that_waits_is_played_from_its_beginning(tmp_path: Path) -> None:
    moved = "<distance> <name>way</name> <target>girona500</target> </distance>"
    current = """<currentForceUpdater>
      <initialValue>0.1</initialValue> <finalValue>0.15</finalValue>
      <sphericalDirection> <theta>1.57</theta> <phi>0</phi> </sphericalDirection>
      <forceVariation>0</forceVariation> <forcePeriod>4</forcePeriod>
      <directionVariation> <theta>0</theta> <phi>0</phi> </directionVariation>
      <directionPeriod> <theta>4</theta> <phi>30</phi> </directionPeriod>
      <random>0</random> <step>0.1</step> <interval>4</interval> <target>girona500</target>
      <sceneUpdater> <repeat> <iterations>2</iterations> <interval>4</interval> </repeat>
      </sceneUpdater> </currentForceUpdater>"""
    (first, _) = rows_of(
        make_plan(
            tmp_path,
            timetable(_0_5=True, _4=False, _5=True),
            current,
            start=READY,
            measures=moved,
            function="<function>way</function>",
        )
    )
    assert first.measures["way"][0] == pytest.approx(0.35, abs=0.01)  # from 0.5 s to 4 s


def test_nobody_waits_forever_for_a_start_that_does_not_come_back(tmp_path: Path) -> None:
    plan = make_plan(tmp_path, timetable(_0_2=True, _0_7=False), FOG, start=READY)
    message = (
        r"Level fog=0.1 never began: its startOn \(topic 'ready'\) did not go on within 2 s of "
        "simulation time"
    )
    with pytest.raises(NeverStarted, match=message):
        rows_of(plan)


def test_a_stop_can_be_called_before_and_between_levels(tmp_path: Path) -> None:
    algorithm = timetable(_0_1="stopBench", _0_2="startBench", _0_7="stopBench")
    rows = rows_of(make_plan(tmp_path, algorithm, REPEAT, start=START, stop=STOP))
    assert [row.duration for row in rows] == pytest.approx([0.5, 1.0, 1.0], abs=0.003)
    assert [row.status for row in rows] == ["ok"] * 3


def test_the_originals_stop_that_is_never_reset_comes_back_by_name(tmp_path: Path) -> None:
    assert "stop-once" in COMPATIBILITY
    plan = make_plan(
        tmp_path,
        timetable(_0_3="stopBench"),
        FOG,
        stop=STOP,
        compatibility=frozenset({"stop-once"}),
    )
    message = (
        r"Level fog=0.1 never began: its stopOn \(service 'stopBench'\) did not go off within 2 s"
    )
    with pytest.raises(NeverStarted, match=message):
        rows_of(plan)


def test_where_the_stop_is_never_reset_a_topic_may_take_it_back(tmp_path: Path) -> None:
    plan = make_plan(
        tmp_path,
        timetable(_0_3=True, _2=False),
        REPEAT,
        stop=READY,
        compatibility=frozenset({"stop-once"}),
    )
    rows = rows_of(plan)
    assert [row.duration for row in rows] == pytest.approx([0.3, 1.0, 1.0], abs=0.003)
    assert rows[1].ended_at == pytest.approx(3.0, abs=0.003)


def test_any_message_starts_a_benchmark_that_waits_for_a_topic(tmp_path: Path) -> None:
    class Speaks(Idle):
        def start(self, node: Node) -> None:
            say = node.publisher("go", String)
            node.create_timer(0.4, lambda: say(String(data="now")))

    plan = make_plan(tmp_path, Speaks, REPEAT, start="<type>topic</type> <target>go</target>")
    assert len(rows_of(plan)) == 3


def test_a_benchmark_that_cannot_begin_says_which_trigger_it_waits_for(tmp_path: Path) -> None:
    with pytest.raises(NeverStarted, match=r"The benchmark never started: its startOn \(never\)"):
        rows_of(make_plan(tmp_path, Idle, REPEAT, start=NEVER_TRIGGER))


def test_a_benchmark_that_cannot_begin_says_what_the_algorithm_waits_for(tmp_path: Path) -> None:
    class Waits(Idle):
        def start(self, node: Node) -> None:
            node.publisher("estimate", String)
            node.subscribe("/front/image", Image, lambda _: None)

    said = r"see to it\? \w+: it subscribes to '/front/image', but it has no publisher\.$"
    with pytest.raises(NeverStarted, match=said):
        rows_of(make_plan(tmp_path, Waits, REPEAT, start=NEVER_TRIGGER))

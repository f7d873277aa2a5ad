"""The status of a row: the first that applies."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tests.support.short_trial import DATA, make_plan, rows_of
from uwsim.base.inbox import Inbox
from uwsim.bus import Node
from uwsim.messages import Float64MultiArray, MultiArrayLayout, String
from uwsim.runs.trial.status import StatusMonitor
from uwsim.scene.object import PhysicsSpec
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec
from uwsim.topics.thruster_commands import ROSThrustersToPATSpec

REPEAT = "<repeat> <iterations>2</iterations> <interval>3</interval> </repeat>"
HITS = "<collision {} > <name>hits</name> <target>blackbox</target> </collision>"


class Idle:
    """Does nothing at all."""

    def start(self, node: Node) -> None:
        pass


def a_box_falls_on_a_slab() -> SceneSpec:
    """A drop of 0.35 m between faces: 1.2 s."""
    scene = read_scene(DATA / "scenes" / "currents-scene.xml").nominal_scene
    black = replace(scene.objects[1], is_solid=None)
    flat = replace(black, orientation=(0.0, 0.0, 0.0))
    box = replace(flat, position=(7.0, 1.5, 3.5), physics=PhysicsSpec(mass=20.0))
    slab = replace(
        flat,
        name="slab",
        position=(7.0, 1.5, 4.0),
        scale_factor=(4.0, 4.0, 1.0),
        physics=PhysicsSpec(mass=0.0),
    )
    vehicle = replace(scene.vehicles[0], parts=())
    return replace(scene, vehicles=(vehicle,), objects=(box, slab), ros_interfaces=())


def test_a_benchmark_that_stops_on_contact_has_the_status_collision(tmp_path: Path) -> None:
    measures = HITS.format('u:stopOnContact="true"') + "<time> <name>t</name> </time>"
    plan = make_plan(
        tmp_path,
        Idle,
        REPEAT,
        measures=measures,
        function="<function>hits</function>",
        scene=a_box_falls_on_a_slab(),
    )
    first, second = rows_of(plan)
    assert first.status == second.status == "collision"
    assert 0.3 < first.duration < 2.0
    assert second.duration == pytest.approx(0.002)  # it lies there still
    assert first.measures["t"][0] == pytest.approx(first.duration)
    assert first.measures["hits"][0] is not None
    assert first.total is None
    assert first.missing_reasons["total"].startswith("'blackbox' touched 'slab' at ")


def test_without_the_wish_a_contact_costs_only_its_score(tmp_path: Path) -> None:
    plan = make_plan(
        tmp_path,
        Idle,
        REPEAT,
        measures=HITS.format(""),
        function="<function>hits</function>",
        scene=a_box_falls_on_a_slab(),
    )
    rows = rows_of(plan)
    assert [row.status for row in rows] == ["ok", "ok"]
    assert [row.duration for row in rows] == pytest.approx([3.0, 3.0])
    assert rows[0].details["hits.contact_share"][0] > 0.2


def measure(silence: float) -> SimpleNamespace:
    return SimpleNamespace(
        measure=SimpleNamespace(longest_silence=silence, missing_reason="quiet", task_status=None)
    )


@pytest.mark.parametrize(
    ("said", "error", "overran", "ended", "silence", "status"),
    [
        ("failed: a", None, 600.0, "hit", 2.0, "algorithm error"),
        ("", "Oops: x", 600.0, "hit", 2.0, "algorithm error"),
        ("lost: b", None, 600.0, "hit", 2.0, "timeout"),
        ("", None, None, "hit", 2.0, "timeout"),
        ("lost: b", None, None, "hit", 2.0, "collision"),
        ("lost: b", None, None, None, 2.0, "lost"),
        ("tracking", None, None, None, 0.5, "ok"),
    ],
)
def test_the_first_status_that_applies_counts(
    said: str, error: str | None, overran: float | None, ended: str | None, silence: float,
    status: str,
) -> None:  # fmt: skip
    inbox: Inbox[String] = Inbox()
    node = SimpleNamespace(name="esm", error=error, failure_verb="raised")
    monitor = StatusMonitor(node, inbox)  # type: ignore[arg-type]
    if said:
        inbox.receive(String(data=said), 0)
    monitor.read_reports(1.0)
    found = monitor.status([measure(silence)], cutoff=overran, ending=ended)  # type: ignore[list-item]
    assert found[0] == status
    assert (found[1] is None) is (status == "ok")


class Drives:
    """Commands the thrusters once a second."""

    data: Any = (0.0, 0.0, 0.0)

    def start(self, node: Node) -> None:
        say = node.publisher("/thrusters", Float64MultiArray)
        layout = MultiArrayLayout(dim=[], data_offset=0)
        node.create_timer(1.0, lambda: say(Float64MultiArray(layout=layout, data=self.data)))


class DrivesWithWords(Drives):
    data = ("full", "ahead")


class DrivesAtOnce(Drives):
    def start(self, node: Node) -> None:
        node.publisher("/thrusters", Float64MultiArray)(String(data="go"))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("algorithm", "said"),
    [
        (Drives, "for the thrusters of 'girona500' has 3 values; expected 5: surge_port, surge_"),
        (DrivesWithWords, "data is ('full', 'ahead'), expected an array of numbers."),
        (DrivesAtOnce, "carries std_msgs/msg/Float64MultiArray, not std_msgs/msg/String."),
    ],
)
def test_a_message_that_no_thruster_takes_is_the_algorithms_error(
    algorithm: type[Drives], said: str, tmp_path: Path
) -> None:
    scene = read_scene(DATA / "scenes" / "currents-scene.xml").nominal_scene
    interface = ROSThrustersToPATSpec(topic="/thrusters", vehicle_name="girona500")
    vehicle = replace(scene.vehicles[0], parts=())
    scene = replace(scene, vehicles=(vehicle,), objects=(), ros_interfaces=(interface,))
    plan = make_plan(tmp_path, algorithm, REPEAT.replace("3<", "1.2<"), scene=scene)
    rows = rows_of(plan)
    assert [row.status for row in rows] == ["algorithm error"] * 2
    assert said in rows[0].missing_reasons["total"]
    assert "test_status.py" in rows[0].missing_reasons["total"]
    assert [row.measures["t"][0] for row in rows] == pytest.approx([1.2, 1.2])

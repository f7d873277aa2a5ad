"""u:grasp: success, failures, slip, impulses and phases, of a world that moves as told."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.support.fakes import FakeBody, FakeWorld
from uwsim import check
from uwsim.assets.bundled import benchmark_file
from uwsim.benchmark.measures.grasp import Grasp, GraspSpec
from uwsim.bus import OBSERVER
from uwsim.messages import String

SPEC = GraspSpec(
    name="success",
    target="blackbox",
    vehicle="girona500",
    jaw="girona500/end_effector",
    lift=0.5,
    hold=2.0,
    topic="graspPhase",
    phases="search grasp lift",
)
WEIGHT = np.array([0.0, 0.0, 52.0])


class Tank:
    """A box, a vehicle and its jaw; 10 steps a second."""

    def __init__(self) -> None:
        self.box, self.jaw, self.base = FakeBody(), FakeBody((0.0, 0.0, 0.2)), FakeBody()
        bodies = {"blackbox": self.box, "girona500": self.base}
        self.world = FakeWorld({**bodies, "girona500/end_effector": self.jaw}, timestep=0.1)
        self.say = self.world.bus.publisher("graspPhase", String)
        self.lie()
        self.measure: Grasp = SPEC.bind(self.world)
        self.measure.start()

    def lie(self) -> None:
        self.world.forces_by_body["blackbox"] = {"terrain": WEIGHT}

    def carry(self, height: float, slipped: float = 0.0) -> None:
        """Hold the box so high above where it lay, so far below its place in the jaw [m]."""
        self.box.move(0.0, 0.0, height)
        self.jaw.move(0.0, 0.0, height + 0.2 + slipped)
        self.world.forces_by_body["blackbox"] = {"girona500": WEIGHT}

    def fall(self) -> None:
        self.box.move(0.0, 0.0, 0.0)
        self.lie()

    def wait(self, seconds: float) -> None:
        for _ in range(round(seconds / self.world.timestep)):
            self.world.advance()
            self.measure.update()

    @property
    def status(self) -> str:
        verdict = self.measure.task_status
        assert verdict is not None
        return verdict[0]


def test_a_box_that_was_lifted_and_held_is_a_success_and_ends_the_level() -> None:
    tank = Tank()
    tank.wait(1.0)
    tank.carry(0.3)
    tank.wait(2.0)
    tank.carry(0.55)
    tank.wait(1.9)
    assert tank.measure.ends_level is None
    tank.wait(0.3)
    assert tank.measure.ends_level is not None
    assert (tank.measure.value, tank.status) == (1.0, "ok")
    details = tank.measure.details
    assert details["time_raised"] == pytest.approx(1.1)
    assert details["time_lifted"] == pytest.approx(3.1)
    assert details["held"] == pytest.approx(2.0)
    assert details["height"] == pytest.approx(0.55)


def test_slip_is_the_motion_in_the_jaw_during_the_hold() -> None:
    tank = Tank()
    tank.carry(0.2, slipped=0.004)
    tank.wait(1.5)
    tank.carry(0.5, slipped=0.006)
    tank.wait(1.0)
    tank.carry(0.5, slipped=0.009)
    tank.wait(2.0)
    assert tank.status == "ok"
    assert tank.measure.details["slip"] == pytest.approx(0.003)
    assert tank.measure.details["slip_raising"] == pytest.approx(0.002)


def test_a_hold_that_is_too_short_is_no_success() -> None:
    tank = Tank()
    tank.carry(0.6)
    tank.wait(1.0)
    assert (tank.measure.value, tank.status) == (0.0, "dropped")


def test_a_box_that_falls_was_dropped() -> None:
    tank = Tank()
    tank.carry(0.3)
    tank.wait(1.0)
    tank.fall()
    tank.wait(0.4)
    assert tank.measure.ends_level is None
    tank.wait(0.4)
    assert "on its way up" in str(tank.measure.ends_level)
    assert (tank.measure.value, tank.status) == (0.0, "dropped")


def test_a_box_that_was_hardly_lifted_may_be_tried_again_and_was_missed() -> None:
    tank = Tank()
    tank.carry(0.05)
    tank.wait(1.0)
    tank.fall()
    tank.wait(2.0)
    assert tank.measure.ends_level is None
    assert tank.status == "missed"


def test_a_box_that_is_pushed_along_the_ground_is_not_carried() -> None:
    tank = Tank()
    tank.box.move(0.0, 0.0, 0.6)
    tank.world.forces_by_body["blackbox"] = {"girona500": WEIGHT, "terrain": WEIGHT}
    tank.wait(5.0)
    assert (tank.measure.value, tank.status) == (0.0, "missed")


def test_a_hit_is_a_collision_by_its_impulse_and_ends_the_level() -> None:
    tank = Tank()
    tank.world.forces_by_body["girona500"] = {"terrain": np.array([0.0, 0.0, 300.0])}
    tank.wait(0.1)
    assert tank.measure.ends_level is None  # 30 N s in one step of 0.1 s
    tank.world.forces_by_body["girona500"] = {"terrain": np.array([0.0, 0.0, 500.0])}
    tank.wait(0.1)
    assert "girona500" in str(tank.measure.ends_level)
    assert tank.status == "collision"
    assert tank.measure.details["collisions"] == 1.0
    assert tank.measure.details["impulse_on_ground"] == pytest.approx(50.0)


@pytest.mark.parametrize(
    ("said", "status"),
    [
        ((), "timeout"),
        (("search",), "not found"),
        (("search", "aborted: not found in 3 laps"), "not found"),
        (("search", "aborted: nothing seen"), "not found"),
        (("search", "grasp: again", "aborted: the tracker lost it"), "lost target"),
        (("search", "grasp"), "timeout"),
    ],
)
def test_what_was_never_touched_is_judged_by_the_phases(said: tuple[str, ...], status: str) -> None:
    tank = Tank()
    for message in said:
        tank.say(String(data=message))
        tank.wait(0.5)
    assert tank.status == status
    assert (tank.measure.ends_level is not None) == any("aborted" in each for each in said)
    assert tank.measure.value == 0.0


def test_the_time_of_each_phase_and_the_farthest() -> None:
    tank = Tank()
    for message, seconds in (("search", 1.0), ("grasp", 2.0), ("resting", 1.0), ("search", 0.5)):
        tank.say(String(data=message))
        tank.wait(seconds)
    details = tank.measure.details
    assert details["phase"] == 2.0
    assert details["time.search"] == pytest.approx(1.5, abs=0.11)
    assert details["time.grasp"] == pytest.approx(3.0, abs=0.11)
    assert details["time.lift"] == 0.0


def test_the_excursion_is_counted_from_the_first_touch_until_it_is_off_the_ground() -> None:
    tank = Tank()
    tank.base.move(5.0, 0.0, 0.0)
    tank.wait(0.5)
    tank.world.forces_by_body["blackbox"] = {"girona500": WEIGHT, "terrain": WEIGHT}
    tank.wait(0.1)
    tank.base.move(5.03, 0.0, 0.04)
    tank.wait(0.1)
    tank.carry(0.3)
    tank.base.move(9.0, 0.0, 0.0)
    tank.wait(1.0)
    assert tank.measure.details["excursion"] == pytest.approx(0.05)


def test_missing_details_say_why() -> None:
    tank = Tank()
    tank.wait(1.0)
    details, reasons = tank.measure.details, tank.measure.reasons
    assert {name for name, value in details.items() if value is None} == set(reasons)


@pytest.mark.parametrize(
    ("spec", "expected"),
    [
        ({"topic": None}, "need a <topic>"),
        ({"phases": "a b a"}, "twice"),
    ],
)
def test_phases_that_cannot_be_are_errors(spec: dict[str, str | None], expected: str) -> None:
    given = {"name": "g", "target": "a", "vehicle": "b", "jaw": "c", "topic": "t", "phases": "a"}
    [error] = list(GraspSpec(**{**given, **spec}).errors())  # type: ignore[arg-type]
    assert expected in error


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"ground": "blackbox"}, "three different things"),
        ({"vehicle": "terrain"}, "three different things"),
        ({"target": "girona500"}, "three different things"),
        ({"jaw": "blackbox"}, "<jaw> is 'blackbox'; expected a frame of 'girona500'"),
    ],
)
def test_what_lifts_and_what_is_lifted_and_what_it_lies_on_differ(
    changes: dict[str, str], said: str
) -> None:
    assert not SPEC.errors()
    [error] = replace(SPEC, **changes).errors()
    assert said in error


def test_every_wrong_name_of_a_grasp_is_reported_with_its_line(tmp_path: Path) -> None:
    right = benchmark_file("grasp").read_text(encoding="utf-8")
    wrong = right.replace("<target>blackbox<", "<target>blackbx<", 1).replace(
        "<phases>", "<ground>terrrain</ground><phases>"
    )
    file = tmp_path / "wrong.xml"
    file.write_text(wrong, encoding="utf-8")
    said = [str(one) for one in check(file)]
    assert len(said) == 2
    for name, nearest in (("blackbx", "blackbox"), ("terrrain", "terrain")):
        line = 1 + wrong[: wrong.index(f">{name}<")].count("\n")
        assert any(f":{line}:" in one and f"'{nearest}'" in one for one in said)


def test_who_reads_the_truth_is_marked() -> None:
    tank = Tank()
    measure = replace(SPEC, truth="/truth/odometry /tf").bind(tank.world)
    measure.start()
    tank.world.bus.subscribe("/tf", String, lambda message: None, owner=OBSERVER)  # a recorder
    assert measure.notes == ()
    tank.world.bus.inbox("/truth/odometry", String)
    [note] = measure.notes
    assert "reads the truth (/truth/odometry)" in note
    assert tank.measure.notes == ()  # no topics are named

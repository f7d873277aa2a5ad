"""Old public names work, and warn with the new name (docs/python.md, "Stability")."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import uwsim
from tests.results.test_result import make
from tests.support.compared_results import entries, make_result
from tests.support.fakes import FakeWorld
from uwsim.algorithms import grasp
from uwsim.algorithms.grasp.perception import grasp_point_of
from uwsim.analysis.comparison import Comparison, compare, shared_column
from uwsim.base.deprecation import deprecated_name, renamed_parameters
from uwsim.benchmark.measures.distance import Distance
from uwsim.benchmark.measures.time import Time
from uwsim.messages import CameraInfo
from uwsim.results.result import RefusedMessages
from uwsim.runs.own_process.child import ChildNode
from uwsim.schema import element

PAGE = (Path(__file__).parent.parent / "docs" / "python.md").read_text()


class Vehicle:
    """A class with an old method, an old property and an old parameter."""

    def pose(self) -> int:
        return 3

    @deprecated_name("pose")
    def place(self) -> int:
        return self.pose()

    @property
    @deprecated_name("pose")
    def site(self) -> int:
        return self.pose()

    @renamed_parameters(of="frame")
    def distance(self, frame: str = "L") -> str:
        return frame


def warned(call: Callable[[], Any], old_name: str, new_name: str) -> Any:
    """Return the value of a call that warns of an old name, at the line of its caller."""
    text = re.escape(f"{old_name!r} is deprecated since uwsim 0.2.0; use {new_name!r}.")
    with pytest.warns(DeprecationWarning, match=text) as warnings:
        value = call()
    assert [warning.filename for warning in warnings] == [__file__]
    return value


def test_a_deprecated_method_returns_what_the_new_one_returns() -> None:
    assert warned(Vehicle().place, "place", "pose") == 3
    assert Vehicle.place.__name__ == "place"


def test_a_deprecated_property_returns_what_the_new_name_returns() -> None:
    assert warned(lambda: Vehicle().site, "site", "pose") == 3


def test_a_renamed_parameter_accepts_its_old_keyword() -> None:
    vehicle: Any = Vehicle()
    assert warned(lambda: vehicle.distance(of="W"), "of", "frame") == "W"
    assert vehicle.distance(frame="W") == vehicle.distance("W") == "W"
    assert list(inspect.signature(vehicle.distance).parameters) == ["frame"]


def test_both_keywords_of_a_renamed_parameter_are_refused() -> None:
    vehicle: Any = Vehicle()
    with pytest.raises(TypeError, match="of"):
        vehicle.distance(of="W", frame="L")


class Recorder:
    """An algorithm that uses its node by old names."""

    def __init__(self) -> None:
        self.times: list[float] = []

    def start(self, node: Any) -> None:
        assert warned(lambda: node.random, "random", "rng") is node.rng
        warned(
            lambda: node.every(0.1, lambda: self.times.append(node.now)), "every", "create_timer"
        )


def test_old_names_of_a_simulation_and_a_node_work() -> None:
    with uwsim.load("currents-scene") as loaded:
        simulation: Any = loaded
        times: list[float] = []
        warned(
            lambda: simulation.watch(look=lambda: times.append(simulation.time)), "look", "callback"
        )
        recorder = Recorder()
        node: Any = simulation.attach(recorder)
        assert warned(node.unconnected, "unconnected", "describe_unconnected_topics") == []
        topic = "uwsim/camera1_info"
        loaded.latest_message(topic)
        loaded.advance(0.25)
        assert recorder.times == pytest.approx([0.0, 0.1, 0.2])
        assert times[-1] == loaded.time
        message = warned(lambda: simulation.latest(topic), "latest", "latest_message")
        assert isinstance(message, CameraInfo)
        pose = warned(lambda: simulation.pose("girona500", of="W"), "of", "frame")
        assert (pose.matrix == loaded.pose("girona500", "W").matrix).all()
        warned(lambda: simulation.set_pose("girona500", pose, of="W"), "of", "frame")
        boxes = warned(lambda: simulation.boxes(of="W"), "of", "frame")
        assert boxes.keys() == loaded.boxes().keys()


def test_old_names_of_the_node_of_an_algorithm_in_its_own_process_work() -> None:
    requests: list[tuple[object, ...]] = []
    Recorder().start(ChildNode(lambda *request: requests.append(request)))
    assert requests == [("create_timer", 0.1, 0)]


def test_old_names_of_a_result_work() -> None:
    entry = RefusedMessages(row=0, sender="node", topic_or_service="/cmd", n=2)
    result = make(refused_messages=(entry,))
    missing = warned(lambda: result.missing, "missing", "missing_values")
    assert missing == result.missing_values
    assert warned(lambda: missing[0].why, "why", "reason") == missing[0].reason
    assert warned(lambda: result.refused, "refused", "refused_messages") == (entry,)
    assert warned(lambda: entry.by, "by", "sender") == "node"
    assert warned(lambda: entry.what, "what", "topic_or_service") == "/cmd"
    columns = warned(lambda: result.of_kind("score"), "of_kind", "columns_of_kind")
    assert columns == result.columns_of_kind("score")
    reason = warned(lambda: result.why(1, "total"), "why", "reason")
    assert reason == result.reason(1, "total")
    run: Any = replace(result.run, trial_counts=(1, 3))
    assert warned(lambda: run.units, "units", "trial_counts") == (1, 3)


def test_the_old_name_of_the_trials_of_a_replay_works() -> None:
    replay = object.__new__(uwsim.Replay)
    replay.trials_without_motion = (2,)
    assert warned(lambda: replay.unseen, "unseen", "trials_without_motion") == (2,)


def test_the_old_name_of_the_reason_of_a_measure_without_value_works() -> None:
    def define() -> type[Distance]:
        class Odometer(Distance):
            why = "the odometer is broken"

        return Odometer

    assert warned(define, "why", "missing_reason").missing_reason == "the odometer is broken"


def test_a_measure_that_stops_by_the_old_name_is_stopped() -> None:
    def define() -> type[Time]:
        class Stopwatch(Time):
            def went_off(self) -> None:
                calls.append("before")
                warned(super().went_off, "went_off", "stop")
                calls.append("after")

        return Stopwatch

    calls: list[str] = []
    world = FakeWorld(timestep=0.5)
    measure = warned(define, "went_off", "stop")(world)
    measure.start()
    world.advance()
    measure.stop()
    assert calls == ["before", "after"]
    assert measure.value == 0.5


def test_a_bundled_measure_can_be_stopped_by_the_old_name() -> None:
    world = FakeWorld(timestep=0.5)
    measure: Any = Time(world)
    measure.start()
    world.advance()
    warned(measure.went_off, "went_off", "stop")
    assert measure.value == 0.5


def test_the_old_name_of_the_phase_of_a_measure_works() -> None:
    def define() -> type[Distance]:
        class Journey(Distance):
            @property
            def moment(self) -> str | None:
                return f"{warned(lambda: super(Journey, self).moment, 'moment', 'current_phase')}"

        return Journey

    journey = object.__new__(warned(define, "moment", "current_phase"))
    assert journey.current_phase == "None"
    measure: Any = object.__new__(Distance)
    assert warned(lambda: measure.moment, "moment", "current_phase") is None


@pytest.mark.parametrize(
    ("old_name", "new_name"),
    [("Motion", "TrackingState"), ("Station", "StationController"), ("Target", "TargetEstimate")],
)
def test_the_old_names_of_the_parts_of_the_grasp_work(old_name: str, new_name: str) -> None:
    new_class = getattr(grasp, new_name)
    assert warned(lambda: getattr(grasp, old_name), old_name, new_name) is new_class


def test_a_model_and_a_view_of_the_grasp_with_old_names_work() -> None:
    class Sphere:
        def grip(self, pose: grasp.BoxPose) -> np.ndarray:
            return pose.position

        def closing_heading(self, pose: grasp.BoxPose) -> float:
            return 0.0

    model: Any = Sphere()
    pose = grasp.BoxPose(position=np.array([1.0, 2.0, 3.0]), heading=0.0)
    grasp_point = warned(lambda: grasp_point_of(model), "grip", "grasp_point")
    assert grasp_point(pose).tolist() == [1.0, 2.0, 3.0]
    assert grasp_point_of(grasp.BoxSpec())(pose)[2] < 3.0
    pinhole = grasp.Pinhole(fx=1.0, fy=1.0, cx=0.0, cy=0.0, width=2, height=2)
    navigation_from_camera = uwsim.Pose(np.zeros(3), np.eye(3))
    view = grasp.View(
        pinhole=pinhole, navigation_from_camera=navigation_from_camera, seabed_depth=4.0
    )
    assert warned(lambda: view.bottom, "bottom", "seabed_depth") == 4.0


@pytest.mark.parametrize(
    ("old_name", "new_name"), [("above", "exclusive_minimum"), ("below", "exclusive_maximum")]
)
def test_the_old_names_of_the_limits_of_an_element_work(old_name: str, new_name: str) -> None:
    field = warned(lambda: element(default=0.5, **{old_name: 1.0}), old_name, new_name)
    assert field.metadata["xml"].limits == {new_name: 1.0}


def test_old_names_of_a_comparison_work() -> None:
    results = entries(make_result("a", {0.0: [1.0, 2.0]}), make_result("b", {0.0: [1.5, 2.0]}))
    comparison = compare(results, shared_column(results, None))
    (pair,) = warned(lambda: comparison.versus, "versus", "pairs")
    assert pair is comparison.pairs[0]
    sweep = warned(lambda: pair.overall, "overall", "sweep")
    assert sweep is pair.sweep
    assert warned(lambda: comparison.forced, "forced", "experiment_differences") == ()
    assert warned(lambda: comparison.fewest, "fewest", "min_level_repeats") == 6
    assert warned(lambda: comparison.fewest_for_sweep, "fewest_for_sweep", "min_sweep_repeats") == 6
    n_needed = warned(lambda: sweep.value.needed, "needed", "repeats_needed")
    assert n_needed == sweep.value.repeats_needed
    assert warned(lambda: sweep.value.fewest, "fewest", "repeats_to_test") == 6


def test_the_page_lists_each_deprecated_name_with_the_new_one() -> None:
    for cls in (uwsim.Simulation, uwsim.Result, uwsim.Replay, Comparison):
        for name, member in vars(cls).items():
            function = member.fget if isinstance(member, property) else member
            if "call_old_name" in getattr(getattr(function, "__code__", None), "co_name", ""):
                assert re.search(rf"`{name}` -> `\w+`", PAGE), name

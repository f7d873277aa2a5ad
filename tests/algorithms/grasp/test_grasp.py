"""The algorithm as a whole: what it refuses, what it says, and one box that it fetches."""

from pathlib import Path

import pytest

from tests.algorithms.fake_node import FakeNode
from tests.support.opened import open_scene
from uwsim.algorithms import ALGORITHMS, check_parameters
from uwsim.algorithms.grasp import Grasp
from uwsim.algorithms.grasp.phases import PHASES
from uwsim.errors import BadSetting
from uwsim.messages import String
from uwsim.scene.reader import read_scene

SCENES = Path(__file__).parents[3] / "src" / "uwsim" / "data" / "scenes"


def play(name: str, seed: int, limit: float) -> tuple[list[str], list[str], float]:
    """Phases and statuses it published, and how far the box was lifted [m]."""
    said: dict[str, list[str]] = {"phase": [], "algorithmStatus": []}
    with open_scene(
        read_scene(SCENES / "grasp-scene.xml"), seed=seed, timestep=0.005
    ) as simulation:
        for topic, texts in said.items():
            simulation.bus.subscribe(topic, String, lambda m, texts=texts: texts.append(m.data))
        simulation.attach(ALGORITHMS[name]())
        simulation.advance(0.0)
        lay, raised = float(simulation.pose("blackbox").position[2]), 0.0
        while simulation.time < limit and "hold" not in said["phase"]:
            simulation.advance(0.5)
            raised = max(raised, lay - float(simulation.pose("blackbox").position[2]))
    return said["phase"], said["algorithmStatus"], raised


@pytest.mark.slow
def test_it_finds_a_box_takes_it_by_its_handle_and_lifts_it() -> None:
    phases, statuses, raised = play("grasp", seed=1, limit=100.0)
    order = ["search", "detect", "station", "pregrasp", "align", "descend", "close", "lift", "hold"]
    assert list(dict.fromkeys(phases)) == order  # each may be tried again
    assert statuses[-1] == "tracking"
    assert raised > 0.5


@pytest.mark.slow
def test_a_control_lifts_nothing() -> None:
    phases, _, raised = play("grasp-blind-close", seed=1, limit=45.0)
    assert phases == ["search"]
    assert raised < 0.1


@pytest.mark.parametrize("name", ["camera_place", "camera_rpy", "dvl_place"])
def test_places_are_three_numbers(name: str) -> None:
    with pytest.raises(BadSetting, match=f"{name}.*three numbers"):
        check_parameters(Grasp, {name: "1 2"})
    check_parameters(Grasp, {name: "1, 2, 3"})


def test_a_variant_without_a_parameter_refuses_it() -> None:
    with pytest.raises(BadSetting, match="no parameter 'odometry_topic'"):
        check_parameters(Grasp, {"odometry_topic": "/truth"})


def test_every_phase_is_followed_by_phases_that_there_are() -> None:
    assert {phase.timeout_phase for phase in PHASES.values()} <= set(PHASES)
    assert [phase.name for phase in PHASES.values()] == list(PHASES)


class Timed(FakeNode):
    def create_timer(self, period_s: float, callback: object) -> None:
        self.period = period_s


def test_parts_are_those_of_a_derived_class() -> None:
    class Own(Grasp):
        def detector(self) -> "Own":
            return self

        def detect(self, image: object, view: object) -> list[object]:
            return []

    node, own = Timed(parameters={"kp": 0.5}), Own()
    own.start(node)
    assert own.parameters["kp"] == 0.5
    assert own.task.perception._detector is own
    assert {"/girona500/camera", "/girona500/imu", "/girona500/dvl"} <= set(node.readers)

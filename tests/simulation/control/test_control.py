"""The services of simulation_interfaces, called on the bus."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.support.opened import open_scene
from uwsim import messages
from uwsim.bus import Bus
from uwsim.messages.simulation_control import (
    DeleteEntity,
    EntityFilters,
    EntityState,
    GetEntities,
    GetEntityState,
    GetSimulationState,
    GetSimulatorFeatures,
    ResetSimulation,
    Resource,
    Result,
    SetEntityState,
    SetSimulationState,
    SetSimulationStateResponse,
    SimulationState,
    SimulatorFeatures,
    SpawnEntity,
    SpawnEntityResponse,
    StepSimulation,
)
from uwsim.scene.reader import read_scene
from uwsim.simulation.control import Quit, SimulationControl

SCENE = """<UWSimScene>
  <vehicle>
    <name>rov</name> <file>bluerov2_heavy.urdf</file>
    <position> <x>0</x> <y>0</y> <z>2</z> </position>
  </vehicle>
  <rosInterfaces>
    <ROSTwistToPAT> <topic>/twist</topic> <vehicleName>rov</vehicleName> </ROSTwistToPAT>
  </rosInterfaces>
</UWSimScene>
"""


class Controlled:
    """A simulation, and calls that come while it is paused."""

    def __init__(self, scene: Path) -> None:
        self.simulation = open_scene(read_scene(scene))
        self.later: deque[Callable[[], None]] = deque()
        self.control = SimulationControl(self.simulation, self.exchange)
        self.control.begin()
        self.simulation.watch(self.control.hold)

    def exchange(self) -> None:
        """Make the next call; in a pause there must be one, or it never ends."""
        assert self.later, "the simulation stays paused"
        self.later.popleft()()

    @property
    def bus(self) -> Bus:
        """The bus."""
        return self.simulation.bus

    def set_state(self, state: int) -> int:
        """Ask for a state; the code of the answer."""
        request = SetSimulationState(state=SimulationState(state))
        answer = self.bus.services.call("set_simulation_state", request)
        assert isinstance(answer, SetSimulationStateResponse)
        return answer.result.result


@pytest.fixture
def controlled(tmp_path: Path) -> Iterator[Controlled]:
    path = tmp_path / "scene.xml"
    path.write_text(SCENE)
    found = Controlled(path)
    with found.simulation:
        yield found


def test_it_says_what_it_can_do(controlled: Controlled) -> None:
    answer = controlled.bus.services.call("get_simulator_features", GetSimulatorFeatures())
    assert SimulatorFeatures.STEP_SIMULATION_MULTIPLE in answer.features.features
    assert "marker" in answer.features.custom_info


def test_a_paused_simulation_takes_the_steps_asked_for_and_no_more(controlled: Controlled) -> None:
    steps: list[int] = []
    answers: list[Result] = []

    def step() -> None:
        before = controlled.simulation.step
        answers.append(
            controlled.bus.services.call("step_simulation", StepSimulation(steps=5)).result
        )
        steps.append(controlled.simulation.step - before)

    controlled.later.extend([step, step, lambda: steps.append(controlled.set_state(1))])
    assert controlled.set_state(SimulationState.PAUSED) == Result.OK
    controlled.simulation.advance()
    assert steps == [5, 5, Result.OK]
    assert [each.result for each in answers] == [Result.OK, Result.OK]
    assert controlled.simulation.step == 11


def test_steps_are_refused_while_it_plays(controlled: Controlled) -> None:
    answer = controlled.bus.services.call("step_simulation", StepSimulation(steps=1))
    assert answer.result.result == Result.INCORRECT_STATE
    assert controlled.simulation.step == 0


def test_a_reset_goes_back_to_the_beginning(controlled: Controlled) -> None:
    controlled.simulation.advance(0.1)
    pose = messages.Pose(position=messages.Point(x=1.0))
    request = SetEntityState(entity="rov", state=EntityState(pose=pose), set_pose=True)
    controlled.bus.services.call("set_entity_state", request)
    assert controlled.simulation.pose("rov").position[0] == 1.0
    answer = controlled.bus.services.call("reset_simulation", ResetSimulation())
    assert answer.result.result == Result.OK
    assert controlled.simulation.time == 0.0
    assert controlled.simulation.pose("rov").position[0] == 0.0
    answer = controlled.bus.services.call("reset_simulation", ResetSimulation(scope=1))
    assert answer.result.result == Result.FEATURE_UNSUPPORTED


def test_states_are_reported_and_a_repeated_wish_is_told(controlled: Controlled) -> None:
    answer = controlled.bus.services.call("get_simulation_state", GetSimulationState())
    assert answer.state.state == SimulationState.PLAYING
    assert controlled.set_state(1) == SetSimulationStateResponse.ALREADY_IN_TARGET_STATE
    assert controlled.set_state(7) == Result.OPERATION_FAILED
    controlled.simulation.advance(0.1)
    assert controlled.set_state(SimulationState.STOPPED) == Result.OK
    assert controlled.simulation.time == 0.0


def test_quitting_ends_the_loop(controlled: Controlled) -> None:
    controlled.set_state(SimulationState.QUITTING)
    with pytest.raises(Quit):
        controlled.simulation.advance()


def test_entities_are_listed_placed_and_spawned(controlled: Controlled) -> None:
    def names(filter: str = "") -> list[str]:
        request = GetEntities(filters=EntityFilters(filter=filter))
        found: list[str] = controlled.bus.services.call("get_entities", request).entities
        return found

    assert names() == ["rov"]
    pose = messages.Pose(position=messages.Point(1.0, 2.0, 3.0))
    request = SetEntityState(entity="rov", state=EntityState(pose=pose), set_pose=True)
    assert controlled.bus.services.call("set_entity_state", request).result.result == Result.OK
    state = controlled.bus.services.call("get_entity_state", GetEntityState(entity="rov")).state
    assert state.pose.position == messages.Point(1.0, 2.0, 3.0)

    spawn = SpawnEntity(name="buoy", entity_resource=Resource(uri="objects/sphere.osg"))
    assert controlled.bus.services.call("spawn_entity", spawn).entity_name == "buoy"
    again = controlled.bus.services.call("spawn_entity", spawn)
    assert again.result.result == SpawnEntityResponse.NAME_NOT_UNIQUE
    assert names() == ["rov", "buoy"]
    assert names("^b") == ["buoy"]
    assert (
        controlled.bus.services.call("delete_entity", DeleteEntity(entity="buoy")).result.result
        == 1
    )
    assert names() == ["rov"]


@pytest.mark.parametrize(
    ("service", "request_", "code"),
    [
        ("get_entity_state", GetEntityState(entity="rob"), Result.NOT_FOUND),
        ("delete_entity", DeleteEntity(entity="rov"), Result.FEATURE_UNSUPPORTED),
        *(
            ("get_entities", GetEntities(filters=EntityFilters(filter=f)), Result.OPERATION_FAILED)
            for f in ("(", "a{1,99999999999}")
        ),
        (
            "set_entity_state",
            SetEntityState(
                entity="rov",
                set_pose=True,
                state=EntityState(pose=messages.Pose(position=messages.Point(x=float("nan")))),
            ),
            Result.OPERATION_FAILED,
        ),
        (
            "set_entity_state",
            SetEntityState(
                entity="rov",
                set_pose=True,
                state=EntityState(pose=messages.Pose(position=messages.Point(x=1e300))),
            ),
            Result.OPERATION_FAILED,
        ),
        ("spawn_entity", SpawnEntity(name="a b"), SpawnEntityResponse.NO_RESOURCE),
        (
            "spawn_entity",
            SpawnEntity(name="a", entity_resource=Resource(uri="package://gone/a.dae")),
            SpawnEntityResponse.MISSING_ASSETS,
        ),
    ],
)
def test_what_cannot_be_done_has_a_code(
    controlled: Controlled, service: str, request_: object, code: int
) -> None:
    answer = controlled.bus.services.call(service, request_)
    assert answer.result.result == code
    assert answer.result.error_message


@pytest.mark.parametrize("filter", ["(a+)+$", "a?" * 30 + "a" * 30, "a*a*a*a*a*b", "(a|a){40}b"])
def test_an_expression_that_may_take_for_ever_is_refused(
    controlled: Controlled, filter: str
) -> None:
    spawn = SpawnEntity(name="a" * 60 + ".", entity_resource=Resource(uri="objects/sphere.osg"))
    assert controlled.bus.services.call("spawn_entity", spawn).result.result == Result.OK
    request = GetEntities(filters=EntityFilters(filter=filter))
    answer = controlled.bus.services.call("get_entities", request)
    assert answer.result.result == Result.OPERATION_FAILED
    assert "repetitions" in answer.result.error_message
    usual = GetEntities(filters=EntityFilters(filter="^(rov|a+)[._].*|x?$"))
    assert controlled.bus.services.call("get_entities", usual).result.result == Result.OK

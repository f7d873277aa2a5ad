"""What pilots can move: the first vehicle that can be steered, and the axes that it has."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

import uwsim
from tests.support.opened import open_scene
from tests.viewer.live.desk import Desk
from uwsim.algorithms.pilot import AXES, TWIST_AXES, Pilot
from uwsim.runs.trial.pilot_inputs import PilotInputs
from uwsim.runs.trial.pilot_topics import pilot_topics
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation
from uwsim.viewer.live.mapping import PilotMapping
from uwsim.viewer.live.pilot_targets import find_pilot_targets
from uwsim.viewer.live.session import LiveSession

SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <vehicle> <name>one</name> <file>rexrov.urdf</file>
    <position> <x>0</x> <y>0</y> <z>-5</z> </position> <u:dynamics>rexrov</u:dynamics> </vehicle>
  <vehicle> <name>two</name> <file>rexrov.urdf</file>
    <position> <x>4</x> <y>0</y> <z>-5</z> </position> <u:dynamics>rexrov</u:dynamics> </vehicle>
  INTERFACES
</UWSimScene>"""
TWIST = """<rosInterfaces> <ROSTwistToPAT> <topic>/twist</topic>
  <vehicleName>two</vehicleName> </ROSTwistToPAT> </rosInterfaces>"""
Opened = Callable[[str], Simulation]


@pytest.fixture
def opened(tmp_path: Path) -> Opened:
    """Opens a scene of two vehicles with these interfaces."""

    def open_two(interfaces: str) -> Simulation:
        path = tmp_path / "two.xml"
        path.write_text(SCENE.replace("INTERFACES", interfaces))
        return open_scene(read_scene(path), is_blind=True)

    return open_two


def test_the_second_vehicle_is_piloted_where_the_first_cannot_be_steered(opened: Opened) -> None:
    with opened(TWIST) as simulation:
        piloted = find_pilot_targets(simulation.world, pilot_topics(simulation))
        assert (piloted.vehicle, piloted.reason) == (1, "")
        held = tuple(float(axis == "surge") for axis in AXES)
        PilotInputs(simulation, lambda: held)
        simulation.attach(Pilot(), parameters={**pilot_topics(simulation), "start": ""})
        before = {name: simulation.pose(name, "W").position for name in ("one", "two")}
        simulation.advance(2.0)
        way = {name: simulation.pose(name, "W").position - before[name] for name in before}
        assert way["two"][0] > 0.2
        assert abs(way["one"][0]) < 0.01


def test_a_scene_without_interfaces_says_what_it_lacks_once(
    opened: Opened, capsys: pytest.CaptureFixture[str]
) -> None:
    with opened("") as simulation:
        parameters = pilot_topics(simulation)
        piloted = find_pilot_targets(simulation.world, parameters)
        assert piloted.axes == frozenset()
        assert piloted.keys(PilotMapping()) == {}
        assert piloted.sticks(PilotMapping()) == ["", "", "", ""]
        session = LiveSession(Desk(), mapping=PilotMapping())  # type: ignore[arg-type]
        for _ in range(2):  # trials
            session.open(simulation, "scene", parameters)
            session.close()
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("uwsim: warning: No vehicle can be steered: ")
    assert "<ROSTwistToPAT>" in line
    assert "<u:ROSThrustersToPAT>" in line


@pytest.mark.parametrize(
    ("scene", "axes"),
    [
        ("currents-scene", set(TWIST_AXES)),
        ("remus-scene", {"thruster1"}),
        ("grasp-scene", {*TWIST_AXES, "jaw", *(f"joint{k}" for k in range(1, 5))}),
    ],
)
def test_axes_are_those_that_the_vehicle_has(scene: str, axes: set[str]) -> None:
    with uwsim.load(scene) as simulation:
        piloted = find_pilot_targets(simulation.world, pilot_topics(simulation))
        joints = [
            name
            for vehicle in simulation.world.vehicles.names[:1]
            for name in simulation.world.vehicles.find(vehicle).joint_names
        ]
        thrusters = list(
            simulation.world.vehicles.find(simulation.world.vehicles.names[0]).thrusters
        )
    named = {axis: name for axis, name in piloted.names.items() if axis[:5] != "thrus"}
    wanted = dict(zip(("joint1", "joint2", "joint3", "joint4", "jaw"), joints, strict=False))
    assert named == (wanted if "joint1" in axes else {})
    assert all(name in thrusters for axis, name in piloted.names.items() if axis[:5] == "thrus")
    assert ("thruster1" in piloted.names) is ("thruster1" in piloted.axes)
    assert {axis for axis in piloted.axes if scene != "grasp-scene" or axis[:5] != "thrus"} == axes


def test_whoever_waits_for_a_page_says_so_once_and_not_at_once(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    now, told = [0.0], list[str]()

    class Late(Desk):
        url = "http://127.0.0.1:1/?token=x"

        @property
        def n_viewers(self) -> int:  # type: ignore[override]
            now[0] += 0.5
            return int(now[0] > 5.0)

    monkeypatch.setattr("uwsim.viewer.live.session.MAX_SLEEP", 0.0)
    session = LiveSession(
        Late(),  # type: ignore[arg-type]
        mapping=PilotMapping(),
        waits_for_page=True,
        wall=lambda: now[0],
        report=lambda text: told.append(f"{now[0]:g}: {text}"),
    )
    with uwsim.load("currents-scene") as simulation:
        session.open(simulation, "scene")
        session.close()
        session.open(simulation, "scene")  # of another trial: somebody looks
        session.close()
    assert told == ["1: waiting for a page: open http://127.0.0.1:1/?token=x"]

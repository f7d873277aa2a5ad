"""Vehicles whose z axis points up are piloted like those whose z axis points down."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from tests.support.documented import write_files
from tests.support.opened import open_scene
from tests.support.short_benchmark import bench_of, fingerprint, run
from uwsim.algorithms.pilot import AXES, Pilot
from uwsim.base.geometry import Array
from uwsim.runs.executors.executor import SerialExecutor, run_all
from uwsim.runs.trial.pilot_inputs import PilotInputs
from uwsim.runs.trial.pilot_topics import pilot_topics
from uwsim.scene.reader import read_scene
from uwsim.viewer.live.mapping import PilotMapping
from uwsim.viewer.live.server import LiveServer
from uwsim.viewer.live.session import LiveSession

PAGE = Path(__file__).parents[3] / "docs" / "first-benchmark.md"
SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <vehicle> <name>rov</name> <file>SET.urdf</file>
    <position> <x>0</x> <y>0</y> <z>-5</z> </position>
    <orientation> <r>TURN</r> <p>0</p> <y>0</y> </orientation>
    <u:dynamics>SET</u:dynamics> </vehicle>
  <rosInterfaces>
    <ROSTwistToPAT> <topic>/twist</topic> <vehicleName>rov</vehicleName> </ROSTwistToPAT>
  </rosInterfaces>
</UWSimScene>"""
WAYS = {
    "surge": (1.0, 0.0, 0.0),
    "heave": (0.0, 0.0, 1.0),
    "sway": (0.0, -1.0, 0.0),  # x is ahead, z up: starboard is -y
}
"""Axis of the pilot -> where the vehicle goes, in W."""


@pytest.fixture(params=["scout", "rexrov", "bluerov2_heavy"])
def scene(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """A scene whose vehicle heads along x; z of the last one points down."""
    if request.param == "scout":
        write_files(PAGE.read_text(), tmp_path)
        return tmp_path / "wreck.xml"
    path = tmp_path / "scene.xml"
    turn = "M_PI" if request.param == "bluerov2_heavy" else "0"
    path.write_text(SCENE.replace("SET", request.param).replace("TURN", turn))
    return path


def moved(scene: Path, axis: str) -> tuple[Array, Array]:
    """Hold an axis for 2 s; returns the way, and where x of the vehicle points then, in W."""
    with open_scene(read_scene(scene), is_blind=True) as simulation:
        held = tuple(float(each == axis) for each in AXES)
        PilotInputs(simulation, lambda: held)
        simulation.attach(Pilot(), parameters={**pilot_topics(simulation), "start": ""})
        name = simulation.world.vehicles.names[0]
        before = simulation.pose(name, "W").position
        simulation.advance(2.0)
        after = simulation.pose(name, "W")
    return after.position - before, after.rotation[:, 0]


@pytest.mark.parametrize("axis", WAYS)
def test_a_vehicle_goes_where_its_pilot_pushes_whichever_way_its_z_axis_points(
    scene: Path, axis: str
) -> None:
    way, _ = moved(scene, axis)
    assert way @ np.array(WAYS[axis]) > 0.9 * float(np.linalg.norm(way)) > 0.2


def test_a_vehicle_turns_to_starboard_whichever_way_its_z_axis_points(scene: Path) -> None:
    _, ahead = moved(scene, "yaw")
    assert ahead[1] < -0.2


@pytest.mark.slow
def test_a_pilots_benchmark_of_a_vehicle_with_z_up_is_sent_again_with_the_same_bytes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("uwsim.viewer.live.server.CLOSE_TIMEOUT", 0.2)  # [s]
    write_files(PAGE.read_text(), tmp_path)
    benchmark = tmp_path / "hover.xml"
    text = re.sub("<interval>.*</interval>", "<interval>0.5</interval>", benchmark.read_text())
    benchmark.write_text(text)
    levels, out = ["current=0.1"], tmp_path / "flown"
    server = LiveServer(lambda: "")
    session = LiveSession(server, real_time_factor=0.0, mapping=PilotMapping())
    up = tuple(float(axis == "heave") for axis in AXES)
    session.pilot = lambda: up  # type: ignore[method-assign]
    try:
        flown = bench_of(benchmark, out, algorithm="pilot", levels=levels)
        run_all([flown], SerialExecutor(session))
    finally:
        server.close()
    run(benchmark, tmp_path / "again", algorithm=f"scripted:{out}", levels=levels)
    assert fingerprint(tmp_path / "again") == fingerprint(out)

"""A vehicle of a scene with fins: commanded by a topic, placed with its fins at rest."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim.assets.bundled import bundled_files
from uwsim.checks import check_file
from uwsim.errors import BadMessage
from uwsim.messages import Float64MultiArray, MultiArrayLayout
from uwsim.scene.hydrodynamics.vehicle_sets import vehicle_sets
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation


def remus(path: Path | None = None) -> Simulation:
    scene = replace(read_scene(path or bundled_files("scenes")["remus-scene"]), vary=())
    vehicle = replace(scene.vehicles[0], parts=())
    commands = tuple(each for each in scene.ros_interfaces if not hasattr(each, "camera_name"))
    made = open_scene(replace(scene, vehicles=(vehicle,), objects=(), ros_interfaces=commands))
    made.advance(0.0)
    return made


@pytest.fixture
def simulation() -> Simulation:
    return remus()


def changed(folder: Path, *changes: tuple[str, str]) -> Path:
    """Write the bundled scene, for a hydrodynamics file with other lines, and return it."""
    text = vehicle_sets()["remus100"].read_text().replace('name="remus100"', 'name="own"')
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    (folder / "own.xml").write_text(text)
    scene = bundled_files("scenes")["remus-scene"].read_text()
    (folder / "scene.xml").write_text(scene.replace(">remus100<", ">own<"))
    return folder / "scene.xml"


def say(simulation: Simulation, topic: str, *values: float) -> None:
    layout = MultiArrayLayout(dim=[], data_offset=0)
    message = Float64MultiArray(layout=layout, data=np.array(values))
    simulation.bus.publisher(topic, Float64MultiArray)(message)


def yaw_rate(simulation: Simulation) -> float:
    return float(simulation.world.vehicles.find("remus").velocity[5])


def advance(simulation: Simulation, seconds: float) -> None:
    for _ in range(round(seconds / simulation.timestep)):
        simulation.advance()


def test_rudders_turn_a_vehicle_that_moves(simulation: Simulation) -> None:
    say(simulation, "/remus/propeller", 1.0)
    say(simulation, "/remus/fins", -0.1, -0.1, -0.03, -0.03)
    advance(simulation, 20.0)
    assert yaw_rate(simulation) > 0.1


def test_a_vehicle_that_is_placed_begins_with_its_fins_at_rest(simulation: Simulation) -> None:
    say(simulation, "/remus/fins", -0.2, -0.2, 0.0, 0.0)
    advance(simulation, 0.1)
    simulation.world.vehicles.find("remus").reset_pose(None)
    other = remus()
    for each in (simulation, other):
        say(each, "/remus/propeller", 1.0)
        advance(each, 2.0)
    one, two = (each.world.vehicles.find("remus").velocity for each in (simulation, other))
    assert one == pytest.approx(two, abs=1e-9)


def test_a_message_with_another_number_of_angles_is_refused(simulation: Simulation) -> None:
    with pytest.raises(BadMessage, match="expected 4: upper_rudder, lower_rudder, port_plane"):
        say(simulation, "/remus/fins", 0.1)


def test_the_thrust_that_is_reported_is_that_at_speed(tmp_path: Path) -> None:
    advance_line = "<advance>0 0.45 4 0</advance> <radius>0.06985</radius>"
    simulation = remus(changed(tmp_path, ("<radius>0.06985</radius>", advance_line)))
    vehicle, actuators = (
        simulation.world.vehicles.find("remus"),
        simulation.world.vehicles.actuators("remus"),
    )
    assert actuators is not None
    say(simulation, "/remus/propeller", 1.0)
    advance(simulation, 5.0)
    diameter, surge = 2.0 * 0.06985, float(vehicle.velocity[0])
    tip = math.sqrt(3.86 / (1030.0 * 0.45)) / diameter
    assert surge > 0.4
    expected = 3.86 * (1.0 - surge / tip / 4.0)
    assert actuators.thrusts()[0] == pytest.approx(expected, rel=2e-3)


def test_check_warns_about_a_fin_far_off_the_hull(tmp_path: Path) -> None:
    where = "<position> <x>-0.638</x> <y>0</y> <z>-0.11</z> </position>"
    scene = changed(tmp_path, (where, where.replace("-0.638", "-6.38")))
    said = [one.message for one in check_file(scene)]
    assert any("far from its hull" in one and "fin 'upper_rudder' 5" in one for one in said)

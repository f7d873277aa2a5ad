"""A vehicle of a scene with fins: commanded by a topic, placed with its fins at rest."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from uwsim.assets.bundled import bundled
from uwsim.errors import BadMessage
from uwsim.messages import Float64MultiArray, MultiArrayLayout
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation


def remus() -> Simulation:
    scene = replace(read_scene(bundled("scenes")["remus-scene"]), vary=())
    vehicle = replace(scene.vehicles[0], parts=())
    commands = tuple(each for each in scene.ros_interfaces if not hasattr(each, "camera_name"))
    made = Simulation(replace(scene, vehicles=(vehicle,), objects=(), ros_interfaces=commands))
    made.start()
    return made


@pytest.fixture
def simulation() -> Simulation:
    return remus()


def say(simulation: Simulation, topic: str, *values: float) -> None:
    layout = MultiArrayLayout(dim=[], data_offset=0)
    message = Float64MultiArray(layout=layout, data=np.array(values))
    simulation.bus.publisher(topic, Float64MultiArray)(message)


def yaw_rate(simulation: Simulation) -> float:
    return float(simulation.world.vehicle("remus").velocity[5])


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
    simulation.world.vehicle("remus").put_back()
    other = remus()
    for each in (simulation, other):
        say(each, "/remus/propeller", 1.0)
        advance(each, 2.0)
    one, two = (each.world.vehicle("remus").velocity for each in (simulation, other))
    assert one == pytest.approx(two, abs=1e-9)


def test_a_message_with_another_number_of_angles_is_refused(simulation: Simulation) -> None:
    with pytest.raises(BadMessage, match="expected 4: upper_rudder, lower_rudder, port_plane"):
        say(simulation, "/remus/fins", 0.1)

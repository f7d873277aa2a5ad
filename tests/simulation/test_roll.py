"""A controller behind a camera that tilts with the hull does not rock the vehicle."""

import numpy as np
import pytest

from tests.simulation.girona500 import SCENE, vector
from tests.support.opened import open_scene
from uwsim.messages import Twist, TwistStamped, header
from uwsim.scene.reader import read_scene

DISTANCE = 2.2  # what the controller takes for that of the box [m]


def rolls(kp: float, seconds: float) -> np.ndarray:
    """Roll every 0.1 s [deg] of a vehicle that keeps over the box, from a start 0.3 m beside it."""
    simulation = open_scene(read_scene(SCENE).nominal_scene)
    camera = simulation.world.sensors.camera("bowtech1")
    box = simulation.world.bodies.find("blackbox").world_from_body.position + np.array(
        [0.0, 0.3, 0.0]
    )
    say = simulation.bus.publisher("/dataNavigator", TwistStamped)
    found = []

    def steer() -> None:
        right, up, back = camera.world_from_camera.inverse().transform(box[None])[0]
        surge, sway = kp * DISTANCE * np.array([up, right]) / -back
        twist = Twist(linear=vector(surge, sway, 0.0), angular=vector(0.0, 0.0, 0.0))
        say(TwistStamped(header=header(simulation.time), twist=twist))
        base = simulation.world.model.scene.world_from_localized.inverse() @ (
            simulation.world.bodies.find("girona500").world_from_body
        )
        found.append(np.degrees(np.arctan2(base.rotation[2, 1], base.rotation[2, 2])))

    simulation.world.schedule.create_timer(10.0, steer)
    simulation.advance(0.0)
    for _ in range(round(seconds / simulation.timestep)):
        simulation.advance()
    return np.array(found)


def test_the_roll_over_the_black_box_dies_out() -> None:
    roll = rolls(0.4, 30.0)
    assert np.ptp(roll[:50]) > 0.3
    assert np.ptp(roll[-50:]) < 0.01
    assert roll[-1] == pytest.approx(0.0, abs=0.3)


def test_it_dies_out_with_half_the_gain_more_as_well() -> None:
    roll = rolls(0.6, 40.0)
    assert np.ptp(roll[-50:]) < 0.1 * np.ptp(roll[:50])

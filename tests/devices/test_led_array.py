"""Signal lamps shine for the time that they are told to, in their colour, on what is around."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.simulation.small_robots import scene_of, shape, write_robot
from tests.support.opened import open_scene
from uwsim.devices.led_array import LedArraySpec
from uwsim.messages import Duration, LedLight
from uwsim.scene.sim_params import SimParamsSpec
from uwsim.scene.vehicle import VehicleSpec
from uwsim.sensors.virtual_camera import VirtualCameraSpec
from uwsim.simulation import Simulation

LEDS = LedArraySpec(name="leds", relative_to="base_link", position=(0.5, 0.0, 0.0), space=0.4)
EYE = VirtualCameraSpec(
    name="eye", relative_to="base_link", position=(-1.0, 0.0, 0.3), orientation=(1.5708, 0, -1.5708)
)


def night(folder: Path) -> Simulation:
    """A camera that looks at a wall 1 m ahead of two lamps, in the dark."""
    wall = shape(size=(0.1, 4.0, 4.0), xyz="1.55 0 0")
    robot = write_robot(folder, f'<link name="base_link">{wall}</link>')
    vehicle = VehicleSpec(name="rov", file=str(robot), parts=(EYE, LEDS))
    return open_scene(scene_of(vehicle, sim_params=SimParamsSpec(light_rate=0.0)))


def channels(simulation: Simulation) -> list[float]:
    colour = simulation.image("eye").colour
    assert colour is not None
    peaks: list[float] = colour.reshape(-1, 3).max(axis=0).tolist()
    return peaks


def test_a_lamp_shines_until_its_time_is_over(tmp_path: Path) -> None:
    with night(tmp_path) as simulation:
        simulation.advance(0.01)
        assert channels(simulation) == [0, 0, 0]
        simulation.publish("leds/red", LedLight(duration=Duration(sec=0, nanosec=500_000_000)))
        simulation.advance(0.1)
        red, green, blue = channels(simulation)
        assert red > 100
        assert (green, blue) == (0, 0)
        simulation.publish("leds/green", LedLight(duration=Duration(sec=9)))
        simulation.advance(0.5)
        red, green, blue = channels(simulation)
        assert green > 100
        assert (red, blue) == (0, 0)
        simulation.publish("leds/green", LedLight())
        simulation.advance(0.01)
        assert channels(simulation) == [0, 0, 0]


def test_the_red_lamp_is_at_plus_y_and_the_green_one_at_minus_y() -> None:
    assert LEDS.positions["red"] == pytest.approx((0.5, 0.2, 0.0))
    assert LEDS.positions["green"] == pytest.approx((0.5, -0.2, 0.0))


def test_what_shines_is_saved(tmp_path: Path) -> None:
    with night(tmp_path) as first, night(tmp_path) as second:
        first.publish("leds/red", LedLight(duration=Duration(sec=1)))
        first.advance(0.1)
        second.restore(first.save())
        assert channels(second) == channels(first)
        assert np.max(channels(second)) > 100


def test_a_lamp_of_all_directions_lights_what_is_behind_it(tmp_path: Path) -> None:
    wall = shape(size=(0.1, 4.0, 4.0), xyz="1.55 0 0") + shape(size=(0.1, 4.0, 4.0), xyz="-0.5 0 0")
    robot = write_robot(tmp_path, f'<link name="base_link">{wall}</link>')
    eye = VirtualCameraSpec(
        name="eye", relative_to="base_link", position=(1.0, 0, 0), orientation=(1.5708, 0, 1.5708)
    )
    vehicle = VehicleSpec(name="rov", file=str(robot), parts=(eye, LEDS))
    scene = scene_of(vehicle, sim_params=SimParamsSpec(light_rate=0.0))
    with open_scene(scene) as simulation:
        simulation.publish("leds/red", LedLight(duration=Duration(sec=1)))
        simulation.advance(0.1)
        assert channels(simulation)[0] > 60

"""The motors of an autopilot's log, as thrusters of a vehicle."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest

from uwsim.assets.bundled import scene_file
from uwsim.devices.ardupilot import ArduPilotSpec, thrusters_of
from uwsim.errors import BadSetting
from uwsim.logs import CommandSeries, VehicleLog, name_motors
from uwsim.scene.reader import read_scene


def make_log(*names: str) -> VehicleLog:
    values = np.full((2, len(names)), 0.5)
    series = CommandSeries(kind="thrusters", names=names, times=np.array([0.0, 1.0]), values=values)
    return VehicleLog(path="dive.bin", format="bin", sha256="", vehicle="", commands=(series,))


def thrusters_of_bluerov2() -> Mapping[int, tuple[str, float]]:
    vehicle = read_scene(scene_file("bluerov2-scene", ())).vehicles[0]
    return thrusters_of(vehicle.parts_of(ArduPilotSpec))


def test_a_motor_is_the_thruster_of_its_channel() -> None:
    [commands] = name_motors(make_log("motor2", "motor3"), thrusters_of_bluerov2(), "rov").commands
    assert commands.names == ("bow_port", "stern_starboard")
    np.testing.assert_array_equal(commands.values, [[-0.5, 0.5]] * 2)


def test_a_motor_without_a_channel_is_an_error() -> None:
    with pytest.raises(BadSetting, match="Motor 12 of the log has no <channel>"):
        name_motors(make_log("motor1", "motor12"), thrusters_of_bluerov2(), "rov")


def test_names_of_a_mapping_and_vehicles_without_channels_are_kept() -> None:
    named_log = make_log("bow_port")
    assert name_motors(named_log, thrusters_of_bluerov2(), "rov").commands[0].names == ("bow_port",)
    assert name_motors(make_log("motor1"), {}, "rov").commands[0].names == ("motor1",)


def test_names_that_a_vehicle_lacks_count_in_their_order() -> None:
    [commands] = make_log("0", "1").commands
    assert commands.name_in_order(("port", "starboard")).names == ("port", "starboard")
    assert commands.name_in_order(("port",)).names == ("0", "1")
    [commands] = make_log("port", "1").commands
    assert commands.name_in_order(("port", "starboard")).names == ("port", "1")

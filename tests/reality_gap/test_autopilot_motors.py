"""The motors of an autopilot's log, as thrusters of a vehicle."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from uwsim.assets.bundled import scene_file
from uwsim.errors import BadSetting
from uwsim.logs import CommandSeries, VehicleLog
from uwsim.reality_gap.autopilot_motors import name_motors
from uwsim.scene.reader import read_scene


def make_log(*names: str) -> VehicleLog:
    values = np.full((2, len(names)), 0.5)
    series = CommandSeries(kind="thrusters", names=names, times=np.array([0.0, 1.0]), values=values)
    return VehicleLog(path="dive.bin", format="bin", sha256="", vehicle="", commands=(series,))


def test_a_motor_is_the_thruster_of_its_channel() -> None:
    vehicle = read_scene(scene_file("bluerov2-scene", ())).vehicles[0]
    [commands] = name_motors(make_log("motor2", "motor3"), vehicle).commands
    assert commands.names == ("bow_port", "stern_starboard")
    np.testing.assert_array_equal(commands.values, [[-0.5, 0.5]] * 2)


def test_a_motor_without_a_channel_is_an_error() -> None:
    vehicle = read_scene(scene_file("bluerov2-scene", ())).vehicles[0]
    with pytest.raises(BadSetting, match="Motor 12 of the log has no <channel>"):
        name_motors(make_log("motor1", "motor12"), vehicle)


def test_names_of_a_mapping_and_vehicles_without_channels_are_kept() -> None:
    vehicle = read_scene(scene_file("bluerov2-scene", ())).vehicles[0]
    named_log = make_log("bow_port")
    assert name_motors(named_log, vehicle).commands[0].names == ("bow_port",)
    bare_vehicle = replace(vehicle, parts=())
    assert name_motors(make_log("motor1"), bare_vehicle).commands[0].names == ("motor1",)
